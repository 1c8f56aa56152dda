//! The portable engine and ONNX Runtime agree.
//!
//! The tests that need the library run when they are asked for: `-- --include-ignored`.

use std::f32::consts::PI;

use asperity_nn::{
    Bytes, Dim, ElementType, Portable, Session, Tensor,
    build::{Attribute, GraphBuilder, Value},
};
use asperity_onnxruntime::{LoadError, OnnxRuntime};

/// The model on ONNX Runtime.
fn reference(bytes: &[u8]) -> OnnxRuntime {
    OnnxRuntime::from_bytes(bytes)
        .unwrap_or_else(|error| panic!("{error}\n  help: {}", error.remedy()))
}

/// Numbers in −1..1 from a linear congruence.
fn numbers(seed: u32, count: usize) -> Vec<f32> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 23) as f32 - 1.0
    };
    (0..count).map(|_| next()).collect()
}

struct Writer {
    graph: GraphBuilder,
    seed: u32,
}

impl Writer {
    fn linear(&mut self, x: &Value, from: usize, to: usize) -> Value {
        self.seed += 2;
        let scale = 1.0 / (from as f32).sqrt();
        let scaled = |seed, count| {
            numbers(seed, count)
                .into_iter()
                .map(|x| x * scale)
                .collect()
        };
        let weights = Tensor::f32(&[from, to], scaled(self.seed, to * from));
        let weights = self.graph.constant(&format!("w{}", self.seed), weights);
        let bias = Tensor::f32(&[to], scaled(self.seed + 1, to));
        let bias = self.graph.constant(&format!("b{}", self.seed), bias);
        self.graph.gemm(x, &weights, &bias)
    }
}

fn dims(sizes: &[usize]) -> Vec<Dim> {
    let fixed = sizes.iter().map(|&size| Dim::Fixed(size));
    [Dim::named("B")].into_iter().chain(fixed).collect()
}

/// Both engines on the same input; the largest difference.
fn difference(test: &str, bytes: &[u8], x: &Tensor) -> f32 {
    let ours = Portable::from_bytes(bytes).unwrap();
    let theirs = reference(bytes);
    assert_eq!(ours.inputs(), theirs.inputs());
    assert_eq!(ours.outputs(), theirs.outputs());
    let (ours, theirs) = (
        ours.run(&[("x", x)]).unwrap(),
        theirs.run(&[("x", x)]).unwrap(),
    );
    assert_eq!(ours.len(), theirs.len());
    let pairs = ours
        .iter()
        .zip(&theirs)
        .flat_map(|((name, a), (other, b))| {
            assert_eq!((name, a.shape()), (other, b.shape()));
            a.as_f32().unwrap().iter().zip(b.as_f32().unwrap())
        });
    let largest = pairs.fold(0.0_f32, |largest, (a, b)| largest.max((a - b).abs()));
    println!("{test}: largest difference {largest:e}");
    largest
}

/// A small version of the paper's LSF decoder: residual blocks, softmax, and sums scaled to (0, π).
#[test]
#[ignore = "needs ONNX Runtime"]
fn decoder_agrees_within_1e_5() {
    let mut writer = Writer {
        graph: GraphBuilder::new("decoder"),
        seed: 1,
    };
    let x = writer.graph.input("x", ElementType::F32, &dims(&[64]));
    let hidden = writer.linear(&x, 64, 128);
    let mut hidden = writer.graph.relu(&hidden);
    for _ in 0..3 {
        let inner = writer.linear(&hidden, 128, 128);
        let inner = writer.graph.relu(&inner);
        let inner = writer.linear(&inner, 128, 128);
        hidden = writer.graph.add(&hidden, &inner);
    }
    let logits = writer.linear(&hidden, 128, 18 * 22);
    let level = writer.linear(&hidden, 128, 18);
    let graph = &mut writer.graph;
    let logits = graph.reshape(&logits, &[0, 18, 22]);
    let shares = graph.softmax(&logits, -1);
    let below = |at: usize| if at / 21 <= at % 21 { PI } else { 0.0 };
    let sums = graph.constant(
        "sums",
        Tensor::f32(&[22, 21], (0..22 * 21).map(below).collect()),
    );
    let lsf = graph.node("MatMul", &[Some(&shares), Some(&sums)], &[]);
    let level = graph.unary("Exp", &level);
    graph.output("lsf_rad", &lsf, ElementType::F32, &dims(&[18, 21]));
    graph.output("level", &level, ElementType::F32, &dims(&[18]));
    let x = Tensor::f32(&[5, 64], numbers(7, 5 * 64));
    let difference = difference("decoder", &graph.finish().unwrap(), &x);
    assert!(difference <= 1e-5, "{difference}");
}

/// Every function of one number and every reduction, side by side.
#[test]
#[ignore = "needs ONNX Runtime"]
fn functions_agree_within_1e_5() {
    let mut graph = GraphBuilder::new("functions");
    let x = graph.input("x", ElementType::F32, &dims(&[31]));
    let mut parts = Vec::new();
    for function in ["Relu", "Sigmoid", "Tanh", "Exp", "Erf", "Neg"] {
        parts.push(graph.unary(function, &x));
    }
    let squares = graph.mul(&x, &x);
    parts.push(graph.unary("Sqrt", &squares));
    let offset = graph.scalar(0.1);
    let positive = graph.add(&squares, &offset);
    parts.push(graph.unary("Log", &positive));
    let exponent = graph.scalar(1.7);
    parts.push(graph.node("Pow", &[Some(&positive), Some(&exponent)], &[]));
    parts.push(graph.clip(&x, -0.5, 0.25));
    parts.push(graph.div(&x, &positive));
    parts.push(graph.softmax(&x, 0));
    let last = [("axis", Attribute::Int(-1))];
    let (scale, bias) = (numbers(3, 31), numbers(4, 31));
    let scale = graph.constant("scale", Tensor::f32(&[31], scale));
    let bias = graph.constant("bias", Tensor::f32(&[31], bias));
    parts.push(graph.node(
        "LayerNormalization",
        &[Some(&x), Some(&scale), Some(&bias)],
        &last,
    ));
    let axes = [("axes", Attribute::Ints(vec![-1]))];
    parts.push(graph.node("ReduceMean", &[Some(&x)], &axes));
    parts.push(graph.node("ReduceL2", &[Some(&x)], &axes));
    parts.push(graph.reduce_sum(&x, &[1], true));
    let parts: Vec<&Value> = parts.iter().collect();
    let all = graph.concat(&parts, -1);
    graph.output("y", &all, ElementType::F32, &dims(&[13 * 31 + 3]));
    let x = numbers(11, 9 * 31).into_iter().map(|x| 3.0 * x).collect();
    let x = Tensor::f32(&[9, 31], x);
    let difference = difference("functions", &graph.finish().unwrap(), &x);
    assert!(difference <= 1e-5, "{difference}");
}

#[test]
#[ignore = "needs ONNX Runtime"]
fn text_encoder_agrees_in_cosine() {
    let bytes = asperity_model::TEXT_ENCODER;
    let theirs = reference(bytes);
    let ours = Portable::from_shared(Bytes::from_static(bytes)).unwrap();
    let mut lowest = 1.0_f32;
    let mut largest = 0.0_f32;
    for length in [3, 4, 5, 7, 9, 12, 16, 23, 40, 64, 100, 128] {
        let words = numbers(length as u32, length - 2)
            .into_iter()
            .map(|x| 15_000 + (x * 13_000.0) as i64);
        let ids: Vec<i64> = [101].into_iter().chain(words).chain([102]).collect();
        let ids = Tensor::i64(&[1, length], ids);
        let run = |session: &dyn Session| {
            session
                .run(&[("input_ids", &ids)])
                .unwrap()
                .remove(0)
                .1
                .as_f32()
                .unwrap()
                .to_vec()
        };
        let (a, b) = (run(&ours), run(&theirs));
        assert_eq!((a.len(), b.len()), (384, 384));
        let dot = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f32>();
        lowest = lowest.min(dot(&a, &b) / (dot(&a, &a) * dot(&b, &b)).sqrt());
        largest = a
            .iter()
            .zip(&b)
            .fold(largest, |largest, (x, y)| largest.max((x - y).abs()));
    }
    println!("text encoder: lowest cosine {lowest}, largest difference {largest:e}");
    assert!(lowest >= 1.0 - 1e-3, "{lowest}");
}

#[test]
fn a_model_that_is_none_is_refused() {
    let error = match OnnxRuntime::from_bytes(b"no model") {
        Ok(_) => panic!("accepted"),
        Err(error) => error,
    };
    assert!(
        matches!(error, LoadError::Model(_) | LoadError::Library(_)),
        "{error}"
    );
    assert!(!error.remedy().is_empty());
}

#[test]
#[ignore = "needs ONNX Runtime"]
fn wrong_inputs_are_refused_before_the_library_sees_them() {
    let mut graph = GraphBuilder::new("double");
    let x = graph.input("x", ElementType::F32, &dims(&[2]));
    let y = graph.add(&x, &x);
    graph.output("y", &y, ElementType::F32, &dims(&[2]));
    let session = reference(&graph.finish().unwrap());
    let wrong = Tensor::i64(&[1, 2], vec![1, 2]);
    let error = session.run(&[("x", &wrong)]).unwrap_err().to_string();
    assert_eq!(
        error,
        "input `x` is int64 [1, 2] of 2 elements, expected float32 [B, 2]"
    );
}

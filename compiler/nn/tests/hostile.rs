//! Models that are cut off, damaged, cyclic or absurd are refused, by name, without a panic
//! and without large allocations.

use asperity_nn::{
    Dim, ElementType, Portable, Session, Tensor,
    build::GraphBuilder,
    proto::{GraphProto, ModelProto, NodeProto, TensorProto},
};
use prost::Message as _;

/// x [B, 3] → Softmax(x·W + b), reshaped, with constants of several types.
fn model() -> ModelProto {
    let mut graph = GraphBuilder::new("victim");
    let x = graph.input("x", ElementType::F32, &[Dim::named("B"), Dim::Fixed(3)]);
    let w = graph.constant(
        "w",
        Tensor::f32(&[3, 4], (0..12).map(|i| i as f32 * 0.1).collect()),
    );
    let b = graph.constant("b", Tensor::f32(&[4], vec![0.5; 4]));
    let y = graph.gemm(&x, &w, &b);
    let y = graph.softmax(&y, -1);
    let y = graph.reshape(&y, &[0, 2, 2]);
    graph.output(
        "y",
        &y,
        ElementType::F32,
        &[Dim::named("B"), Dim::Fixed(2), Dim::Fixed(2)],
    );
    graph.to_model()
}

/// The model after a change to its graph.
fn changed(change: impl FnOnce(&mut GraphProto)) -> ModelProto {
    let mut model = model();
    change(model.graph.as_mut().unwrap());
    model
}

fn refusal(model: &ModelProto) -> String {
    Portable::from_bytes(&model.encode_to_vec())
        .unwrap_err()
        .to_string()
}

#[test]
fn the_victim_runs() {
    let network = Portable::from_bytes(&model().encode_to_vec()).unwrap();
    let x = Tensor::f32(&[2, 3], vec![0.0; 6]);
    let results = network.run(&[("x", &x)]).unwrap();
    assert_eq!(results[0].1, Tensor::f32(&[2, 2, 2], vec![0.25; 8]));
}

#[test]
fn every_cut_is_refused_or_runs() {
    let bytes = model().encode_to_vec();
    for length in 0..bytes.len() {
        // The operator set is the last field, so no shortened file is a model.
        assert!(
            Portable::from_bytes(&bytes[..length]).is_err(),
            "{length} of {}",
            bytes.len()
        );
    }
}

#[test]
fn damaged_bytes_never_panic() {
    let bytes = model().encode_to_vec();
    let x = Tensor::f32(&[1, 3], vec![1.0; 3]);
    let mut loaded = 0;
    for position in 0..bytes.len() {
        for value in [
            0,
            1,
            7,
            0x7f,
            0x80,
            0xff,
            bytes[position] ^ 1,
            bytes[position] ^ 0x10,
        ] {
            let mut damaged = bytes.clone();
            damaged[position] = value;
            if let Ok(network) = Portable::from_bytes(&damaged) {
                let _ = network.run(&[("x", &x)]);
                loaded += 1;
            }
        }
    }
    // Names and weights may change without harm.
    assert!(loaded > 0);
}

#[test]
fn cycles_and_missing_values_are_named() {
    let cyclic = changed(|graph| graph.node[0].input[0] = "Softmax_2".to_owned());
    let text = refusal(&cyclic);
    assert!(
        text.starts_with("node `Gemm_1` (Gemm): input 0 `Softmax_2` is no input"),
        "{text}"
    );
    let own = changed(|graph| graph.node[0].input[0] = "Gemm_1".to_owned());
    assert!(refusal(&own).contains("a cycle"));
    let missing = changed(|graph| graph.node[1].input[0] = "nothing".to_owned());
    assert!(refusal(&missing).contains("input 0 `nothing`"));
    let output = changed(|graph| graph.output[0].name = "nothing".to_owned());
    assert_eq!(refusal(&output), "output `nothing`: no node gives it");
}

#[test]
fn names_given_twice_are_named() {
    let node = changed(|graph| graph.node[1].output[0] = "x".to_owned());
    assert!(refusal(&node).contains("output `x` is already the name of another value"));
    let constant = changed(|graph| graph.initializer[1].name = "w".to_owned());
    assert_eq!(
        refusal(&constant),
        "initializer `w`, name: empty, or given twice"
    );
}

#[test]
fn unknown_operators_and_attributes_are_named() {
    let operator = changed(|graph| graph.node[1].op_type = "Loop".to_owned());
    assert!(refusal(&operator).starts_with("node `Softmax_2` (Loop): operator not supported"));
    let domain = changed(|graph| graph.node[1].domain = "com.microsoft".to_owned());
    assert!(refusal(&domain).contains("operator not supported"));
    let attribute = changed(|graph| graph.node[1].attribute[0].name = "axes".to_owned());
    assert!(refusal(&attribute).contains("attribute `axes`: not known"));
    let kind = changed(|graph| graph.node[1].attribute[0].r#type = 1);
    assert!(refusal(&kind).contains("attribute `axis`: is of type Float, expected Int"));
    let inputs = changed(|graph| graph.node[1].input.push("x".to_owned()));
    assert!(refusal(&inputs).contains("2 inputs, expected 1"));
    let outputs = changed(|graph| graph.node[1].output.push("other".to_owned()));
    assert!(refusal(&outputs).contains("2 outputs, expected 1"));
}

#[test]
fn versions_and_missing_parts_are_named() {
    let mut old = model();
    old.opset_import[0].version = Some(9);
    assert_eq!(
        refusal(&old),
        "opset_import: operator set 9, supported are 13 to 22"
    );
    assert_eq!(
        refusal(&ModelProto::default()),
        "opset_import: no standard operator set: not an ONNX model?"
    );
    let mut bare = model();
    bare.graph = None;
    assert_eq!(refusal(&bare), "graph: missing");
    let silent = changed(|graph| graph.output.clear());
    assert_eq!(refusal(&silent), "graph.output: empty: nothing to compute");
}

#[test]
fn constants_that_are_not_what_they_say_are_named() {
    let constant =
        |change: fn(&mut TensorProto)| refusal(&changed(|graph| change(&mut graph.initializer[0])));
    let text = constant(|w| w.dims = vec![3, 5]);
    assert_eq!(
        text,
        "initializer `w`, raw_data: 48 bytes, expected 15 × 4 for [3, 5]"
    );
    let text = constant(|w| w.dims = vec![i64::MAX, i64::MAX, 0]);
    assert!(text.starts_with("initializer `w`, dims:"), "{text}");
    assert!(constant(|w| w.dims = vec![-1]).starts_with("initializer `w`, dims:"));
    assert!(constant(|w| w.data_type = 8).contains("data_type: type 8 is not supported"));
    assert!(constant(|w| w.data_location = 1).contains("data_location"));
    assert!(constant(|w| w.raw_data = None).contains("float_data: 0 elements, expected 12"));
    // A shape that does not fit is found in a run.
    let model = changed(|graph| graph.initializer[0].dims = vec![12]);
    let network = Portable::from_bytes(&model.encode_to_vec()).unwrap();
    let x = Tensor::f32(&[1, 3], vec![0.0; 3]);
    let error = network.run(&[("x", &x)]).unwrap_err().to_string();
    assert!(
        error.starts_with("node `Gemm_1` (Gemm): columns of A must match"),
        "{error}"
    );
}

#[test]
fn ports_that_are_not_what_they_say_are_named() {
    let element = changed(|graph| tensor_type(graph).elem_type = 10);
    assert_eq!(
        refusal(&element),
        "input `x`: element type 10 is not supported"
    );
    let none = changed(|graph| graph.input[0].r#type = None);
    assert_eq!(refusal(&none), "input `x`: is no tensor, or has no type");
    let integers = changed(|graph| tensor_type(graph).elem_type = 7);
    assert!(
        refusal(&integers).contains("node `Gemm_1` (Gemm): input 0 is int64, expected float32")
    );
    let negative = changed(|graph| {
        let shape = tensor_type(graph).shape.as_mut().unwrap();
        shape.dim[1].dim_value = Some(-3);
    });
    assert_eq!(refusal(&negative), "input `x`: dimension -3 is negative");
}

fn tensor_type(graph: &mut GraphProto) -> &mut asperity_nn::proto::TensorTypeProto {
    graph.input[0]
        .r#type
        .as_mut()
        .unwrap()
        .tensor_type
        .as_mut()
        .unwrap()
}

#[test]
fn vast_results_are_refused_before_they_are_allocated() {
    let mut graph = GraphBuilder::new("vast");
    let shape = graph.input("shape", ElementType::I64, &[Dim::Any]);
    let zeros = graph.node("ConstantOfShape", &[Some(&shape)], &[]);
    graph.output("y", &zeros, ElementType::F32, &[Dim::Any, Dim::Any]);
    let network = Portable::from_bytes(&graph.finish().unwrap()).unwrap();
    let run = |sizes: [i64; 2]| network.run(&[("shape", &Tensor::i64(&[2], sizes.to_vec()))]);
    assert!(run([2, 3]).is_ok());
    for sizes in [[1 << 40, 1 << 40], [1 << 40, 0], [1 << 27, 1], [-1, 1]] {
        let error = run(sizes).unwrap_err().to_string();
        assert!(error.starts_with("node `ConstantOfShape_1`"), "{error}");
    }
}

#[test]
fn inputs_that_are_not_asked_for_are_named() {
    let network = Portable::from_bytes(&model().encode_to_vec()).unwrap();
    let error = |inputs: &[(&str, &Tensor)]| network.run(inputs).unwrap_err().to_string();
    let x = Tensor::f32(&[1, 3], vec![0.0; 3]);
    assert_eq!(error(&[]), "input `x` (float32 [B, 3]) is missing");
    let unknown = "`z` is no input of this network, or was given twice; inputs: `x`";
    assert_eq!(error(&[("x", &x), ("z", &x)]), unknown);
    assert!(error(&[("x", &x), ("x", &x)]).starts_with("`x` is no input"));
    let flat = Tensor::f32(&[3], vec![0.0; 3]);
    assert_eq!(
        error(&[("x", &flat)]),
        "input `x` is float32 [3] of 3 elements, expected float32 [B, 3]"
    );
    let lying = Tensor::f32(&[2, 3], vec![0.0; 3]);
    assert!(error(&[("x", &lying)]).contains("[2, 3] of 3 elements"));
}

#[test]
fn old_files_may_list_constants_as_inputs() {
    let model = changed(|graph| {
        let mut info = graph.input[0].clone();
        info.name = "w".to_owned();
        graph.input.push(info);
    });
    let network = Portable::from_bytes(&model.encode_to_vec()).unwrap();
    assert_eq!(network.inputs().len(), 1);
}

#[test]
fn nodes_that_nothing_needs_are_not_run() {
    let model = changed(|graph| {
        graph.node.push(NodeProto {
            input: vec!["x".to_owned(), "b".to_owned()],
            output: vec!["unused".to_owned()],
            op_type: "Add".to_owned(),
            ..NodeProto::default()
        });
    });
    // [1, 3] + [4] would fail.
    let network = Portable::from_bytes(&model.encode_to_vec()).unwrap();
    assert!(
        network
            .run(&[("x", &Tensor::f32(&[1, 3], vec![0.0; 3]))])
            .is_ok()
    );
}

/// Files that a decoder would take a hundred times their bytes for.
#[test]
fn files_of_too_many_parts_are_refused_before_they_are_decoded() {
    let nodes = changed(|graph| graph.node = vec![NodeProto::default(); 70_000]);
    assert!(refusal(&nodes).contains("more than 65536 nodes, names and constants"));
    let names = changed(|graph| graph.node[0].input = vec![String::new(); 70_000]);
    assert!(refusal(&names).contains("more than 65536"));
    let dims = changed(|graph| graph.initializer[0].dims = vec![1; 17 << 20]);
    assert!(refusal(&dims).contains("more than 16777216 bytes of integers"));
    let within = changed(|graph| graph.node[0].attribute.clear());
    assert!(Portable::from_bytes(&within.encode_to_vec()).is_ok());
}

//! MatMul, Gemm, DequantizeLinear, and the two together.

use asperity_nn::{
    Bytes, Dim, ElementType, Portable, Session, Tensor,
    build::{Attribute, GraphBuilder},
};

use super::{apply, apply_to, counted, f32s, refusal};

#[test]
fn matmul_of_matrices_and_vectors() {
    let (a, b) = (counted(&[2, 3]), counted(&[3, 2]));
    assert_eq!(
        apply_to("MatMul", &[a.clone(), b.clone()]),
        f32s(&[2, 2], &[10.0, 13.0, 28.0, 40.0])
    );
    let vector = f32s(&[3], &[1.0, 0.0, 2.0]);
    assert_eq!(
        apply_to("MatMul", &[a.clone(), vector.clone()]),
        f32s(&[2], &[4.0, 13.0])
    );
    assert_eq!(
        apply_to("MatMul", &[vector.clone(), b]),
        f32s(&[2], &[8.0, 11.0])
    );
    assert_eq!(
        apply_to("MatMul", &[vector.clone(), vector]),
        f32s(&[], &[5.0])
    );
    let text = refusal("MatMul", &[a.clone(), a], &[]);
    assert!(text.contains("[[2, 3], [2, 3]]"), "{text}");
}

#[test]
fn matmul_broadcasts_the_other_axes() {
    let (a, b) = (
        f32s(&[2, 1, 1, 2], &[1.0, 2.0, 3.0, 4.0]),
        counted(&[2, 2, 1]),
    );
    // Rows (1, 2) and (3, 4) with columns (0, 1) and (2, 3).
    let result = apply_to("MatMul", &[a, b]);
    assert_eq!(result, f32s(&[2, 2, 1, 1], &[2.0, 8.0, 4.0, 18.0]));
}

#[test]
fn gemm_transposes_scales_and_adds() {
    let (a, b, c) = (counted(&[2, 3]), counted(&[3, 2]), f32s(&[2], &[1.0, 2.0]));
    let plain = apply_to("Gemm", &[a.clone(), b.clone(), c.clone()]);
    assert_eq!(plain, f32s(&[2, 2], &[11.0, 15.0, 29.0, 42.0]));
    let turned_a = f32s(&[3, 2], &[0.0, 3.0, 1.0, 4.0, 2.0, 5.0]);
    let turned_b = f32s(&[2, 3], &[0.0, 2.0, 4.0, 1.0, 3.0, 5.0]);
    let flags = [("transA", Attribute::Int(1)), ("transB", Attribute::Int(1))];
    let turned = apply(
        "Gemm",
        &[Some(turned_a), Some(turned_b), Some(c.clone())],
        &flags,
    );
    assert_eq!(turned, plain);
    let factors = [
        ("alpha", Attribute::Float(2.0)),
        ("beta", Attribute::Float(10.0)),
    ];
    let scaled = apply(
        "Gemm",
        &[Some(a.clone()), Some(b.clone()), Some(c)],
        &factors,
    );
    assert_eq!(scaled, f32s(&[2, 2], &[30.0, 46.0, 66.0, 100.0]));
    let text = refusal("Gemm", &[a, b, counted(&[3])], &[]);
    assert!(text.contains("do not broadcast"), "{text}");
}

fn quantized(shape: &[usize], data: &'static [u8]) -> Tensor {
    Tensor::I8 {
        shape: shape.to_vec(),
        data: Bytes::from_static(data),
    }
}

#[test]
fn dequantize_per_tensor_and_per_axis() {
    let weights = || Some(quantized(&[2, 2], &[1, 0xff, 2, 0x80]));
    let one = apply(
        "DequantizeLinear",
        &[weights(), Some(f32s(&[], &[0.5]))],
        &[],
    );
    assert_eq!(one, f32s(&[2, 2], &[0.5, -0.5, 1.0, -64.0]));
    let scales = || Some(f32s(&[2], &[0.5, 2.0]));
    let zeros = Some(quantized(&[2], &[1, 0xff]));
    let columns = apply("DequantizeLinear", &[weights(), scales(), zeros], &[]);
    assert_eq!(columns, f32s(&[2, 2], &[0.0, 0.0, 0.5, -254.0]));
    let rows = apply(
        "DequantizeLinear",
        &[weights(), scales()],
        &[("axis", Attribute::Int(0))],
    );
    assert_eq!(rows, f32s(&[2, 2], &[0.5, -0.5, 4.0, -256.0]));
    let three = f32s(&[3], &[1.0; 3]);
    let text = refusal(
        "DequantizeLinear",
        &[quantized(&[1, 2], &[0, 0]), three],
        &[],
    );
    assert!(text.contains("one scale an index of the axis"), "{text}");
}

/// x · DequantizeLinear(weights), where the weights are constants (fused at load) or given.
fn expanded_product(fused: bool, x: &Tensor) -> Tensor {
    let (k, n) = (5, 19);
    let bytes: Vec<u8> = (0..k * n).map(|i| (i * 37 % 251) as u8).collect();
    let weights = Tensor::I8 {
        shape: vec![k, n],
        data: bytes.into(),
    };
    let scale = Tensor::f32(&[n], (0..n).map(|i| 0.01 + 0.003 * i as f32).collect());
    let zero = Tensor::I8 {
        shape: vec![n],
        data: (0..n as u8).collect(),
    };
    let mut graph = GraphBuilder::new("product");
    let input = graph.input("x", ElementType::F32, &[Dim::Any, Dim::Any]);
    let w = if fused {
        graph.constant("w", weights.clone())
    } else {
        graph.input("w", ElementType::I8, &[Dim::Any, Dim::Any])
    };
    let (scale, zero) = (graph.constant("scale", scale), graph.constant("zero", zero));
    let w = graph.node(
        "DequantizeLinear",
        &[Some(&w), Some(&scale), Some(&zero)],
        &[],
    );
    let y = graph.node("MatMul", &[Some(&input), Some(&w)], &[]);
    graph.output("y", &y, ElementType::F32, &[Dim::Any, Dim::Any]);
    let network = Portable::from_bytes(&graph.finish().unwrap()).unwrap();
    let mut inputs = vec![("x", x)];
    if !fused {
        inputs.push(("w", &weights));
    }
    network.run(&inputs).unwrap().remove(0).1
}

#[test]
fn fused_weights_give_the_bits_of_expanded_ones() {
    for rows in [1, 2, 7] {
        let x = Tensor::f32(
            &[rows, 5],
            (0..rows * 5).map(|i| 0.3 * i as f32 - 2.0).collect(),
        );
        assert_eq!(expanded_product(true, &x), expanded_product(false, &x));
    }
}

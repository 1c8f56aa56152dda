//! Transpose, Reshape, Squeeze, Unsqueeze, Identity, Expand, Shape, Constant, ConstantOfShape, Range.

use asperity_nn::{Tensor, build::Attribute};

use super::{apply, apply_to, counted, f32s, i64s, refusal};

#[test]
fn transpose_reorders_axes() {
    let x = counted(&[2, 3]);
    let turned = f32s(&[3, 2], &[0.0, 3.0, 1.0, 4.0, 2.0, 5.0]);
    assert_eq!(apply_to("Transpose", &[x]), turned);
    let perm = |perm: &[i64]| [("perm", Attribute::Ints(perm.to_vec()))];
    let result = apply("Transpose", &[Some(counted(&[2, 2, 2]))], &perm(&[1, 0, 2]));
    assert_eq!(
        result,
        f32s(&[2, 2, 2], &[0.0, 1.0, 4.0, 5.0, 2.0, 3.0, 6.0, 7.0])
    );
    let text = refusal("Transpose", &[counted(&[2, 2])], &perm(&[0, 0]));
    assert!(text.contains("perm must name every axis once"), "{text}");
}

#[test]
fn reshape_keeps_and_infers() {
    let shape = |sizes: &[i64]| i64s(&[sizes.len()], sizes);
    let x = || counted(&[2, 6]);
    assert_eq!(
        apply_to("Reshape", &[x(), shape(&[0, 3, -1])]),
        counted(&[2, 3, 2])
    );
    assert_eq!(apply_to("Reshape", &[x(), shape(&[12])]), counted(&[12]));
    for wrong in [
        &[5, -1][..],
        &[-1, -1],
        &[-2, 6],
        &[0, 0, 0],
        &[i64::MAX, i64::MAX],
    ] {
        refusal("Reshape", &[x(), shape(wrong)], &[]);
    }
    let zero = [("allowzero", Attribute::Int(1))];
    let empty = apply(
        "Reshape",
        &[Some(f32s(&[0, 2], &[])), Some(shape(&[3, 0]))],
        &zero,
    );
    assert_eq!(empty, f32s(&[3, 0], &[]));
}

#[test]
fn squeeze_and_unsqueeze() {
    let list = |values: &[i64]| i64s(&[values.len()], values);
    let x = counted(&[1, 2, 1]);
    assert_eq!(apply_to("Squeeze", std::slice::from_ref(&x)), counted(&[2]));
    assert_eq!(
        apply_to("Squeeze", &[x.clone(), list(&[-1])]),
        counted(&[1, 2])
    );
    assert!(refusal("Squeeze", &[x, list(&[1])], &[]).contains("only axes of size 1 can go"));
    assert_eq!(
        apply_to("Unsqueeze", &[counted(&[2]), list(&[0, -1])]),
        counted(&[1, 2, 1])
    );
    assert!(
        refusal("Unsqueeze", &[counted(&[2]), list(&[0, 0])], &[]).ends_with("axis given twice: 0")
    );
    assert_eq!(apply_to("Identity", &[counted(&[2])]), counted(&[2]));
}

#[test]
fn expand_broadcasts_to_a_shape() {
    let x = f32s(&[2, 1], &[1.0, 2.0]);
    assert_eq!(
        apply_to("Expand", &[x.clone(), i64s(&[1], &[3])]),
        f32s(&[2, 3], &[1.0, 1.0, 1.0, 2.0, 2.0, 2.0])
    );
    assert_eq!(apply_to("Expand", &[x.clone(), i64s(&[2], &[1, 1])]), x);
    assert!(
        refusal("Expand", &[x.clone(), i64s(&[1], &[-1])], &[]).ends_with("size in a shape: -1")
    );
    let vast = refusal("Expand", &[x, i64s(&[2], &[2, 1 << 40])], &[]);
    assert!(vast.contains("over the limit"), "{vast}");
}

#[test]
fn shapes_from_and_of_tensors() {
    let x = counted(&[2, 3, 4]);
    assert_eq!(
        apply_to("Shape", std::slice::from_ref(&x)),
        i64s(&[3], &[2, 3, 4])
    );
    let part = |start, end| {
        [
            ("start", Attribute::Int(start)),
            ("end", Attribute::Int(end)),
        ]
    };
    assert_eq!(
        apply("Shape", &[Some(x.clone())], &part(1, 2)),
        i64s(&[1], &[3])
    );
    assert_eq!(
        apply("Shape", &[Some(x.clone())], &part(-2, 100)),
        i64s(&[2], &[3, 4])
    );
    assert_eq!(apply("Shape", &[Some(x)], &part(2, 1)), i64s(&[0], &[]));

    let shape = Some(i64s(&[2], &[1, 2]));
    assert_eq!(
        apply("ConstantOfShape", std::slice::from_ref(&shape), &[]),
        f32s(&[1, 2], &[0.0, 0.0])
    );
    let value = [("value", Attribute::Tensor(i64s(&[1], &[7])))];
    assert_eq!(
        apply("ConstantOfShape", &[shape], &value),
        i64s(&[1, 2], &[7, 7])
    );
    assert_eq!(apply("Constant", &[], &value), i64s(&[1], &[7]));
    assert_eq!(
        apply("Constant", &[], &[("value_float", Attribute::Float(2.5))]),
        f32s(&[], &[2.5])
    );
    assert!(refusal("Constant", &[], &[]).contains("exactly one value"));
}

#[test]
fn ranges() {
    let range = |start, limit, delta| [start, limit, delta].map(|value| i64s(&[], &[value]));
    assert_eq!(apply_to("Range", &range(3, 9, 3)), i64s(&[2], &[3, 6]));
    assert_eq!(apply_to("Range", &range(5, 0, -2)), i64s(&[3], &[5, 3, 1]));
    assert_eq!(apply_to("Range", &range(5, 0, 1)), i64s(&[0], &[]));
    assert!(refusal("Range", &range(0, 1, 0), &[]).ends_with("delta: 0"));
    assert!(refusal("Range", &range(i64::MIN, i64::MAX, 1), &[]).contains("over the limit"));
    let floats = [0.0, 1.0, 0.25].map(|x| f32s(&[], &[x]));
    assert_eq!(
        apply_to("Range", &floats),
        f32s(&[4], &[0.0, 0.25, 0.5, 0.75])
    );
    let endless = [0.0, f32::INFINITY, 1.0].map(|x| f32s(&[], &[x]));
    assert!(refusal("Range", &endless, &[]).contains("over the limit"));
    let small: [Tensor; 3] = [0, 2, 1].map(|x| Tensor::I32 {
        shape: vec![],
        data: vec![x],
    });
    assert_eq!(
        apply_to("Range", &small),
        Tensor::I32 {
            shape: vec![2],
            data: vec![0, 1]
        }
    );
}

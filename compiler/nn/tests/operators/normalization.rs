//! Softmax, LayerNormalization, reductions, running sums.

use asperity_nn::{Tensor, build::Attribute};

use super::{apply, counted, f32s, i64s, refusal};

fn axis(value: i64) -> [(&'static str, Attribute); 1] {
    [("axis", Attribute::Int(value))]
}

fn assert_close(result: &Tensor, shape: &[usize], expected: &[f64]) {
    assert_eq!(result.shape(), shape);
    for (x, expected) in result.as_f32().unwrap().iter().zip(expected) {
        assert!(
            (f64::from(*x) - expected).abs() < 1e-6,
            "{result:?}, expected {expected:?}"
        );
    }
}

#[test]
fn softmax_along_any_axis() {
    let x = || Some(f32s(&[2, 2], &[0.0, 1.0, 1000.0, 1000.0]));
    let (low, high) = (0.268_941_421, 0.731_058_579);
    assert_close(
        &apply("Softmax", &[x()], &[]),
        &[2, 2],
        &[low, high, 0.5, 0.5],
    );
    let x = Some(f32s(&[2, 2], &[0.0, 2.0, 1.0, 2.0]));
    assert_close(
        &apply("Softmax", &[x], &axis(0)),
        &[2, 2],
        &[low, 0.5, high, 0.5],
    );
}

#[test]
fn layer_normalization_centres_and_scales() {
    let (x, scale, bias) = (
        f32s(&[2, 2], &[1.0, 3.0, 5.0, 5.0]),
        f32s(&[2], &[1.0, 10.0]),
        f32s(&[2], &[0.5, 0.0]),
    );
    let epsilon = [
        ("epsilon", Attribute::Float(0.0)),
        ("axis", Attribute::Int(-1)),
    ];
    let result = apply(
        "LayerNormalization",
        &[Some(x.clone()), Some(scale.clone()), None],
        &epsilon[1..],
    );
    assert_eq!(result.shape(), [2, 2]);
    let x = f32s(&[1, 2], &[1.0, 3.0]);
    let result = apply(
        "LayerNormalization",
        &[Some(x.clone()), Some(scale.clone()), Some(bias)],
        &epsilon,
    );
    assert_close(&result, &[1, 2], &[-0.5, 10.0]);
    let text = refusal(
        "LayerNormalization",
        &[f32s(&[1, 3], &[0.0; 3]), scale],
        &[],
    );
    assert!(
        text.contains("scale and bias must have the size of the axes"),
        "{text}"
    );
}

#[test]
fn reductions_over_axes() {
    let x = || Some(counted(&[2, 3]));
    let keep = |keep: i64| ("keepdims", Attribute::Int(keep));
    let axes = |axes: &[i64]| ("axes", Attribute::Ints(axes.to_vec()));
    assert_eq!(
        apply("ReduceMean", &[x()], &[axes(&[1]), keep(0)]),
        f32s(&[2], &[1.0, 4.0])
    );
    assert_eq!(
        apply("ReduceMean", &[x()], &[axes(&[-2])]),
        f32s(&[1, 3], &[1.5, 2.5, 3.5])
    );
    assert_eq!(apply("ReduceMean", &[x()], &[]), f32s(&[1, 1], &[2.5]));
    let last = Some(i64s(&[1], &[-1]));
    assert_eq!(
        apply("ReduceSum", &[x(), last], &[]),
        f32s(&[2, 1], &[3.0, 12.0])
    );
    assert_eq!(apply("ReduceSum", &[x()], &[keep(0)]), f32s(&[], &[15.0]));
    let nothing = [("noop_with_empty_axes", Attribute::Int(1))];
    assert_eq!(apply("ReduceSum", &[x()], &nothing), counted(&[2, 3]));
    let x = Some(f32s(&[1, 2], &[3.0, 4.0]));
    assert_eq!(
        apply("ReduceL2", &[x], &[axes(&[1])]),
        f32s(&[1, 1], &[5.0])
    );
    let outside = [axes(&[2])];
    let text = refusal("ReduceMean", &[counted(&[2, 3])], &outside);
    assert!(text.ends_with("axis 2 is outside -2..=1"), "{text}");
}

#[test]
fn reductions_over_several_axes() {
    let axes = [
        ("axes", Attribute::Ints(vec![0, 2])),
        ("keepdims", Attribute::Int(0)),
    ];
    // Elements 0, 1, 4, 5 and 2, 3, 6, 7.
    let result = apply("ReduceMean", &[Some(counted(&[2, 2, 2]))], &axes);
    assert_eq!(result, f32s(&[2], &[2.5, 4.5]));
}

#[test]
fn argmax_takes_the_first_of_equals_or_the_last() {
    let x = || Some(f32s(&[2, 3], &[1.0, 5.0, 5.0, 0.0, -1.0, -2.0]));
    let flag = |name: &'static str, value| (name, Attribute::Int(value));
    let along = ("axis", Attribute::Int(1));
    assert_eq!(
        apply("ArgMax", &[x()], std::slice::from_ref(&along)),
        i64s(&[2, 1], &[1, 0])
    );
    let last = [along, flag("select_last_index", 1), flag("keepdims", 0)];
    assert_eq!(apply("ArgMax", &[x()], &last), i64s(&[2], &[2, 0]));
    let ids = Some(i64s(&[1, 4], &[3, 9, 49_407, 0]));
    assert_eq!(apply("ArgMax", &[ids], &axis(1)), i64s(&[1, 1], &[2]));
}

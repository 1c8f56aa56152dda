//! Gather, GatherND, Slice, Concat.

use asperity_nn::{Bytes, Tensor, build::Attribute};

use super::{apply, apply_to, counted, f32s, i64s, refusal};

#[test]
fn gather_picks_along_an_axis() {
    let table = counted(&[3, 2]);
    let ids = i64s(&[2, 2], &[2, 0, -1, 1]);
    let rows = apply_to("Gather", &[table.clone(), ids]);
    assert_eq!(
        rows,
        f32s(&[2, 2, 2], &[4.0, 5.0, 0.0, 1.0, 4.0, 5.0, 2.0, 3.0])
    );
    let along = [("axis", Attribute::Int(1))];
    let column = apply(
        "Gather",
        &[Some(table.clone()), Some(i64s(&[], &[1]))],
        &along,
    );
    assert_eq!(column, f32s(&[3], &[1.0, 3.0, 5.0]));
    let text = refusal("Gather", &[table, i64s(&[1], &[3])], &[]);
    assert_eq!(text, "node `Gather_1` (Gather): index 3 is outside -3..=2");
}

#[test]
fn gather_keeps_bytes() {
    let table = Tensor::I8 {
        shape: vec![2, 2],
        data: Bytes::from_static(&[1, 2, 0xff, 0xfe]),
    };
    let expected = Tensor::I8 {
        shape: vec![1, 2],
        data: Bytes::from_static(&[0xff, 0xfe]),
    };
    assert_eq!(apply_to("Gather", &[table, i64s(&[1], &[1])]), expected);
}

#[test]
fn gather_nd_picks_by_vectors() {
    let table = counted(&[2, 3]);
    let pairs = i64s(&[2, 2], &[0, 2, 1, -3]);
    assert_eq!(
        apply_to("GatherND", &[table.clone(), pairs]),
        f32s(&[2], &[2.0, 3.0])
    );
    let rows = i64s(&[1, 1], &[1]);
    assert_eq!(
        apply_to("GatherND", &[table.clone(), rows]),
        f32s(&[1, 3], &[3.0, 4.0, 5.0])
    );
    let text = refusal("GatherND", &[table, i64s(&[1, 3], &[0, 0, 0])], &[]);
    assert!(text.contains("the last axis of the indices"), "{text}");
}

#[test]
fn slices_as_python_does() {
    let list = |values: &[i64]| i64s(&[values.len()], values);
    let x = || counted(&[4]);
    let cut = |start, end| apply_to("Slice", &[x(), list(&[start]), list(&[end])]);
    assert_eq!(cut(1, 3), f32s(&[2], &[1.0, 2.0]));
    assert_eq!(cut(-2, i64::MAX), f32s(&[2], &[2.0, 3.0]));
    assert_eq!(cut(3, 1), f32s(&[0], &[]));
    assert_eq!(cut(i64::MIN, -3), f32s(&[1], &[0.0]));
    let stepped = |start, end, step| {
        apply_to(
            "Slice",
            &[x(), list(&[start]), list(&[end]), list(&[0]), list(&[step])],
        )
    };
    assert_eq!(stepped(3, i64::MIN, -2), f32s(&[2], &[3.0, 1.0]));
    assert_eq!(stepped(0, 4, 3), f32s(&[2], &[0.0, 3.0]));
    assert_eq!(stepped(0, 4, i64::MAX), f32s(&[1], &[0.0]));
    assert_eq!(stepped(3, i64::MIN, i64::MIN), f32s(&[1], &[3.0]));
}

#[test]
fn slices_of_several_axes() {
    let list = |values: &[i64]| i64s(&[values.len()], values);
    let result = apply_to(
        "Slice",
        &[
            counted(&[3, 4]),
            list(&[1, 0]),
            list(&[3, 4]),
            list(&[0, -1]),
            list(&[1, 2]),
        ],
    );
    assert_eq!(result, f32s(&[2, 2], &[4.0, 6.0, 8.0, 10.0]));
    let twice = [counted(&[3]), list(&[0, 0]), list(&[1, 1]), list(&[0, 0])];
    assert!(refusal("Slice", &twice, &[]).ends_with("axis given twice: 0"));
    let none = [
        counted(&[3]),
        list(&[0]),
        list(&[1]),
        list(&[0]),
        list(&[0]),
    ];
    assert!(refusal("Slice", &none, &[]).ends_with("step: 0"));
}

#[test]
fn concat_joins_along_an_axis() {
    let (a, b) = (
        f32s(&[2, 1], &[1.0, 2.0]),
        f32s(&[2, 2], &[3.0, 4.0, 5.0, 6.0]),
    );
    let along = |axis| [("axis", Attribute::Int(axis))];
    let joined = apply("Concat", &[Some(a.clone()), Some(b.clone())], &along(-1));
    assert_eq!(joined, f32s(&[2, 3], &[1.0, 3.0, 4.0, 2.0, 5.0, 6.0]));
    let sizes = apply(
        "Concat",
        &[Some(i64s(&[1], &[1])), Some(i64s(&[2], &[2, 3]))],
        &along(0),
    );
    assert_eq!(sizes, i64s(&[3], &[1, 2, 3]));
    let text = refusal("Concat", &[a.clone(), b], &along(0));
    assert!(
        text.contains("shapes must agree but for the axis"),
        "{text}"
    );
    let text = refusal("Concat", &[a], &[]);
    assert!(text.contains("attribute `axis`: missing"), "{text}");
}

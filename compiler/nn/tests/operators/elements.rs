//! Functions of elements: arithmetic, comparison, functions of one number, casts.

use asperity_nn::{Bytes, Tensor, build::Attribute};

use super::{apply, apply_to, f32s, i64s, refusal};

#[test]
fn arithmetic_broadcasts_as_numpy() {
    let (column, row) = (f32s(&[2, 1], &[1.0, 2.0]), f32s(&[3], &[10.0, 20.0, 30.0]));
    let pair = [column, row];
    assert_eq!(
        apply_to("Add", &pair),
        f32s(&[2, 3], &[11.0, 21.0, 31.0, 12.0, 22.0, 32.0])
    );
    assert_eq!(
        apply_to("Sub", &pair),
        f32s(&[2, 3], &[-9.0, -19.0, -29.0, -8.0, -18.0, -28.0])
    );
    assert_eq!(
        apply_to("Mul", &pair),
        f32s(&[2, 3], &[10.0, 20.0, 30.0, 20.0, 40.0, 60.0])
    );
    let quotients = [
        1.0 / 10.0,
        1.0 / 20.0,
        1.0 / 30.0,
        2.0 / 10.0,
        2.0 / 20.0,
        2.0 / 30.0,
    ];
    assert_eq!(apply_to("Div", &pair), f32s(&[2, 3], &quotients));
}

#[test]
fn scalars_and_middle_axes_broadcast() {
    let x = f32s(&[2, 2, 2], &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
    let scalar = f32s(&[], &[1.0]);
    assert_eq!(
        apply_to("Add", &[x.clone(), scalar.clone()]),
        f32s(&[2, 2, 2], &[2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0])
    );
    assert_eq!(
        apply_to("Sub", &[scalar, x.clone()]),
        f32s(&[2, 2, 2], &[0.0, -1.0, -2.0, -3.0, -4.0, -5.0, -6.0, -7.0])
    );
    let middle = f32s(&[2, 1, 2], &[10.0, 20.0, 30.0, 40.0]);
    assert_eq!(
        apply_to("Add", &[x, middle]),
        f32s(
            &[2, 2, 2],
            &[11.0, 22.0, 13.0, 24.0, 35.0, 46.0, 37.0, 48.0]
        )
    );
}

#[test]
fn integers_wrap_and_zero_divides_nothing() {
    let (a, b) = (i64s(&[2], &[7, i64::MIN]), i64s(&[2], &[-2, -1]));
    assert_eq!(
        apply_to("Div", &[a.clone(), b.clone()]),
        i64s(&[2], &[-3, i64::MIN])
    );
    assert_eq!(
        apply_to("Sub", &[a.clone(), b.clone()]),
        i64s(&[2], &[9, i64::MIN + 1])
    );
    assert_eq!(
        apply_to("Mul", &[a.clone(), b]),
        i64s(&[2], &[-14, i64::MIN])
    );
    let zero = i64s(&[], &[0]);
    assert!(refusal("Div", &[a, zero], &[]).ends_with("division of integers by: 0"));
}

#[test]
fn shapes_that_do_not_broadcast_are_named() {
    let text = refusal("Add", &[f32s(&[2], &[0.0; 2]), f32s(&[3], &[0.0; 3])], &[]);
    assert_eq!(
        text,
        "node `Add_1` (Add): shapes do not broadcast; shapes: [[2], [3]]"
    );
}

#[test]
fn types_that_differ_are_named_at_load() {
    let text = refusal("Add", &[f32s(&[1], &[0.0]), i64s(&[1], &[0])], &[]);
    let expected =
        "node `Add_1` (Add): input 1 is int64, expected the type of the inputs before it";
    assert_eq!(text, expected);
}

#[test]
fn powers() {
    let base = f32s(&[3], &[3.0, 9.0, 2.0]);
    let exponent = f32s(&[3], &[2.0, 0.5, -1.0]);
    assert_eq!(
        apply_to("Pow", &[base.clone(), exponent]),
        f32s(&[3], &[9.0, 3.0, 0.5])
    );
    assert_eq!(
        apply_to("Pow", &[base, i64s(&[], &[3])]),
        f32s(&[3], &[27.0, 729.0, 8.0])
    );
}

#[test]
fn comparisons() {
    let pair = [f32s(&[3], &[1.0, 2.0, f32::NAN]), f32s(&[], &[2.0])];
    let bools = |data: [bool; 3]| Tensor::Bool {
        shape: vec![3],
        data: data.to_vec(),
    };
    assert_eq!(apply_to("Equal", &pair), bools([false, true, false]));
    assert_eq!(apply_to("Less", &pair), bools([true, false, false]));
    assert_eq!(apply_to("LessOrEqual", &pair), bools([true, true, false]));
    assert_eq!(apply_to("Greater", &pair), bools([false, false, false]));
    assert_eq!(
        apply_to("GreaterOrEqual", &pair),
        bools([false, true, false])
    );
    let pair = [i64s(&[2], &[1, 5]), i64s(&[2], &[1, 4])];
    let expected = Tensor::Bool {
        shape: vec![2],
        data: vec![true, false],
    };
    assert_eq!(apply_to("Equal", &pair), expected);
}

#[test]
fn where_chooses_and_broadcasts() {
    let condition = Tensor::Bool {
        shape: vec![2, 1],
        data: vec![true, false],
    };
    let (x, y) = (f32s(&[3], &[1.0, 2.0, 3.0]), f32s(&[], &[0.0]));
    assert_eq!(
        apply_to("Where", &[condition.clone(), x, y]),
        f32s(&[2, 3], &[1.0, 2.0, 3.0, 0.0, 0.0, 0.0])
    );
    let (x, y) = (i64s(&[1], &[1]), i64s(&[1], &[2]));
    assert_eq!(
        apply_to("Where", &[condition, x, y]),
        i64s(&[2, 1], &[1, 2])
    );
}

#[test]
fn functions_at_known_points() {
    let x = || vec![f32s(&[3], &[-1.0, 0.0, 2.0])];
    let close = |op_type: &str, expected: [f64; 3]| {
        let result = apply_to(op_type, &x());
        let result = result.as_f32().unwrap();
        for (result, expected) in result.iter().zip(expected) {
            let error = (f64::from(*result) - expected).abs();
            assert!(
                error <= 2e-7 * expected.abs().max(1.0),
                "{op_type}: {result} for {expected}"
            );
        }
    };
    close("Relu", [0.0, 0.0, 2.0]);
    close("Neg", [1.0, 0.0, -2.0]);
    close("Exp", [0.367_879_441, 1.0, 7.389_056_099]);
    close("Erf", [-0.842_700_793, 0.0, 0.995_322_265]);
    close("Tanh", [-0.761_594_156, 0.0, 0.964_027_580]);
    close("Sigmoid", [0.268_941_421, 0.5, 0.880_797_078]);
    assert_eq!(
        apply_to("Neg", &[i64s(&[2], &[1, -2])]),
        i64s(&[2], &[-1, 2])
    );
    assert_eq!(
        apply_to("Sqrt", &[f32s(&[2], &[4.0, 2.0])]),
        f32s(&[2], &[2.0, std::f32::consts::SQRT_2])
    );
    assert_eq!(
        apply_to("Log", &[f32s(&[2], &[1.0, 0.0])]),
        f32s(&[2], &[0.0, f32::NEG_INFINITY])
    );
}

#[test]
fn clip_takes_either_bound() {
    let x = || Some(f32s(&[3], &[-1.0, 0.5, 2.0]));
    let bound = |x: f32| Some(f32s(&[], &[x]));
    assert_eq!(
        apply("Clip", &[x(), bound(0.0), bound(1.0)], &[]),
        f32s(&[3], &[0.0, 0.5, 1.0])
    );
    assert_eq!(
        apply("Clip", &[x(), None, bound(1.0)], &[]),
        f32s(&[3], &[-1.0, 0.5, 1.0])
    );
    assert_eq!(
        apply("Clip", &[x(), bound(0.0)], &[]),
        f32s(&[3], &[0.0, 0.5, 2.0])
    );
    assert_eq!(apply("Clip", &[x()], &[]), f32s(&[3], &[-1.0, 0.5, 2.0]));
}

#[test]
fn nans_come_out_canonical() {
    let odd = f32::from_bits(0xffc0_1234);
    let result = apply_to("Neg", &[f32s(&[1], &[odd])]);
    assert_eq!(result.as_f32().unwrap()[0].to_bits(), f32::NAN.to_bits());
}

#[test]
fn casts_drop_fractions_and_saturate() {
    let to = |code| [("to", Attribute::Int(code))];
    let x = f32s(&[4], &[1.9, -1.9, f32::NAN, 1e30]);
    assert_eq!(
        apply("Cast", &[Some(x)], &to(7)),
        i64s(&[4], &[1, -1, 0, i64::MAX])
    );
    let x = Tensor::I8 {
        shape: vec![2],
        data: Bytes::from_static(&[0xff, 0x7f]),
    };
    assert_eq!(
        apply("Cast", &[Some(x)], &to(1)),
        f32s(&[2], &[-1.0, 127.0])
    );
    let x = Some(f32s(&[2], &[0.0, -2.0]));
    assert_eq!(
        apply("Cast", &[x], &to(9)),
        Tensor::Bool {
            shape: vec![2],
            data: vec![false, true]
        }
    );
    let x = Tensor::Bool {
        shape: vec![2],
        data: vec![false, true],
    };
    assert_eq!(
        apply("Cast", &[Some(x)], &to(6)),
        Tensor::I32 {
            shape: vec![2],
            data: vec![0, 1]
        }
    );
    let text = refusal("Cast", &[f32s(&[1], &[0.0])], &to(10));
    assert!(text.contains("attribute `to`: type 10"), "{text}");
}

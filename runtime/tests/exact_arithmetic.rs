//! Both arithmetics are exact where the result can be held.

use asperity_runtime::{
    Arithmetic, Fixed, Float,
    arithmetic::Scalar,
    quantity::{
        Four, Magnitude, Magnitudes, Quantity, StoredVector, Vector,
        unit::{
            Coordinate, FineNewton, Fraction, Metre, MetrePerSecond, Newton, NewtonPerMetre, Unit,
            Weight,
        },
    },
};
use asperity_tests::draw::Draw;
use fixed::{FixedI32, types::extra::U28};

fn q<A: Arithmetic, U: Unit>(x: f64) -> Quantity<A, U> {
    Quantity::of(x as f32)
}

fn v<A: Arithmetic, U: Unit>(x: [f64; 3]) -> Vector<A, U> {
    Vector::of(x.map(|x| x as f32))
}

fn value<A: Arithmetic, U: Unit>(x: Quantity<A, U>) -> f64 {
    x.value().into()
}

fn values<A: Arithmetic, U: Unit>(x: Vector<A, U>) -> [f64; 3] {
    x.values().map(f64::from)
}

fn lanes<A: Arithmetic, U: Unit>(x: Four<A, U>) -> [f64; 4] {
    [0, 1, 2, 3].map(|lane| f64::from(x.lane(lane).value()))
}

/// Whole multiples of 1/256 up to ±1, whose sums and products are exact everywhere.
fn numbers(count: usize) -> Vec<f64> {
    let mut draw = Draw::new(1);
    (0..count)
        .map(|_| (draw.below(513) as f64 - 256.0) / 256.0)
        .collect()
}

#[test]
fn sums_products_and_comparisons_of_short_numbers_are_exact() {
    fn check<A: Arithmetic>() {
        for pair in numbers(2000).chunks_exact(2) {
            let (a, b) = (pair[0], pair[1]);
            let (m, n) = (q::<A, Metre>(a), q::<A, Metre>(b));
            assert_eq!(value(m), a);
            assert_eq!(value(m + n), a + b);
            assert_eq!(value(m - n), a - b);
            assert_eq!(value(-m), -a);
            assert_eq!(value(m * q::<A, Fraction>(b)), a * b);
            assert_eq!(value(q::<A, Fraction>(b) * m), a * b);
            let force: Quantity<A, Newton> = q::<A, NewtonPerMetre>(64.0 * a) * n;
            assert_eq!(value(force), 64.0 * a * b);
            assert_eq!(
                [m < n, m > n, m <= n, m >= n],
                [a < b, a > b, a <= b, a >= b]
            );
            assert_eq!([m == n, m != n], [a == b, a != b]);
            assert_eq!(m.partial_cmp(&n), a.partial_cmp(&b));
            assert_eq!(value(m.min(n)), a.min(b));
            assert_eq!(value(m.max(n)), a.max(b));
            let limit = q::<A, Metre>(0.5);
            assert_eq!(value(m.clamp_from_zero(limit)), a.clamp(0.0, 0.5));
            assert_eq!(value(force.to::<FineNewton>()), 64.0 * a * b);
            assert_eq!(value(force.to::<Coordinate>()), 64.0 * a * b);
        }
        for n in [-3, -1, 0, 1, 2, 7] {
            assert_eq!(value(Quantity::<A, Metre>::whole(n)), f64::from(n));
        }
        assert_eq!(value(Quantity::<A, Metre>::ZERO), 0.0);
        let most = q::<A, Metre>(7.9);
        assert!(Quantity::<A, Metre>::FARTHEST > most);
        assert_eq!(A::Scalar::<U28>::from_bits(m_bits::<A>(0.75)).value(), 0.75);
    }
    fn m_bits<A: Arithmetic>(x: f32) -> u32 {
        A::Scalar::<U28>::of(x).bits()
    }
    check::<Float>();
    check::<Fixed>();
}

#[test]
fn quotients_of_short_numbers_are_exact() {
    fn check<A: Arithmetic>() {
        for a in numbers(200) {
            for divisor in [0.25, 0.5, 1.0, 2.0, 4.0] {
                let ratio: Quantity<A, Fraction> = q::<A, MetrePerSecond>(a / 4.0).over(q(divisor));
                assert!((value(ratio) - a / 4.0 / divisor).abs() < 2e-9);
            }
        }
        let part: Quantity<A, Fraction> = q::<A, FineNewton>(1.0).over(q::<A, FineNewton>(3.0));
        assert!((value(part) - 1.0 / 3.0).abs() < 2e-8);
    }
    check::<Float>();
    check::<Fixed>();
    let zero = Quantity::<Fixed, Weight>::ZERO;
    assert_eq!(
        value(zero.over(zero)),
        0.0,
        "0/0 is 0 where numbers have a range"
    );
    let over = |x: f64| q::<Fixed, Weight>(x).over(zero).0.to_bits();
    assert_eq!([1.0, -1.0].map(over), [i32::MAX, i32::MIN]);
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[test]
fn vectors_are_exact_on_short_numbers() {
    fn check<A: Arithmetic>() {
        let numbers = numbers(3000);
        for six in numbers.chunks_exact(6) {
            let (a, b) = ([six[0], six[1], six[2]], [six[3], six[4], six[5]]);
            let (m, n) = (v::<A, Metre>(a), v::<A, Metre>(b));
            let along = |f: fn(f64, f64) -> f64| [0, 1, 2].map(|i| f(a[i], b[i]));
            assert_eq!(values(m), a);
            assert_eq!(values(m + n), along(|a, b| a + b));
            assert_eq!(values(m - n), along(|a, b| a - b));
            assert_eq!(values(m * q::<A, Fraction>(b[0])), a.map(|x| x * b[0]));
            assert_eq!(value(m.dot(v::<A, Fraction>(b))), dot(a, b));
            assert_eq!(m.components().map(value), a);
            assert_eq!(m.to_array().map(|x| f64::from(x.value())), a);
            assert_eq!(values(StoredVector::from(m).get()), a);
            assert_eq!(StoredVector::from(m) == StoredVector::from(n), a == b);
            assert_eq!([m == n, m == m], [a == b, true]);
            let four = m.with_fourth(q(b[2]));
            assert_eq!(lanes(four), [a[0], a[1], a[2], b[2]]);
            assert_eq!(values(four.vector()), a);
            // The fourth number beside a vector has no part in it.
            assert!(four.vector() == m);
            assert_eq!(value(four.vector().dot(v::<A, Fraction>(b))), dot(a, b));
            let cross = values(v::<A, Fraction>(a).cross(v::<A, Fraction>(b)));
            let exact = [
                a[1] * b[2] - a[2] * b[1],
                a[2] * b[0] - a[0] * b[2],
                a[0] * b[1] - a[1] * b[0],
            ];
            assert_eq!(cross, exact);
            let mut without = a;
            without[1] = 0.0;
            let up = v::<A, Fraction>([0.0, 1.0, 0.0]);
            assert_eq!(values(m.tangential(up)), without);
        }
        for axis in 0..3 {
            let (mut a, mut b) = ([0.5; 3], [0.5; 3]);
            (a[axis], b[axis]) = (0.25, -0.25);
            let stored = |x| StoredVector::from(v::<A, Metre>(x));
            assert!(v::<A, Metre>(a) != v::<A, Metre>(b) && stored(a) != stored(b));
        }
        assert_eq!(
            values(Vector::<A, Metre>::whole([1, -2, 3])),
            [1.0, -2.0, 3.0]
        );
        assert_eq!(values(Vector::<A, Metre>::ZERO), [0.0; 3]);
        assert_eq!(values(StoredVector::<A, Metre>::ZERO.get()), [0.0; 3]);
        // The part in a slanted plane.
        let slanted = v::<A, Fraction>([0.6, 0.0, 0.8]);
        let found = values(v::<A, Metre>([0.5, 0.25, -1.0]).tangential(slanted));
        let exact = [0.5 + 0.6 * 0.5, 0.25, -1.0 + 0.8 * 0.5];
        for (found, exact) in found.iter().zip(exact) {
            assert!((found - exact).abs() < 2e-7, "{found} {exact}");
        }
    }
    check::<Float>();
    check::<Fixed>();
}

#[test]
fn fours_are_exact_on_short_numbers() {
    fn check<A: Arithmetic>() {
        let numbers = numbers(3200);
        for eight in numbers.chunks_exact(8) {
            let (a, b): ([f64; 4], [f64; 4]) = (
                [0, 1, 2, 3].map(|i| eight[i]),
                [4, 5, 6, 7].map(|i| eight[i]),
            );
            let along = |f: fn(f64, f64) -> f64| [0, 1, 2, 3].map(|i| f(a[i], b[i]));
            let four = |x: [f64; 4]| Four::<A, Metre>::of(x.map(|x| x as f32));
            let (m, n) = (four(a), four(b));
            assert_eq!(lanes(m), a);
            assert_eq!(lanes(m + n), along(|a, b| a + b));
            assert_eq!(lanes(m - n), along(|a, b| a - b));
            assert_eq!(lanes(m.min(n)), along(f64::min));
            let fractions = Four::<A, Fraction>::of(b.map(|x| x as f32));
            assert_eq!(lanes(m * fractions), along(|a, b| a * b));
            assert_eq!(value(m.sum()), a.iter().sum::<f64>());
            assert_eq!([m == n, m == m], [a == b, true]);
            assert_eq!(lanes(Four::splat(m.lane(2))), [a[2]; 4]);
            assert_eq!(m.to_array().map(|x| f64::from(x.value())), a);
            let largest = a.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            for limit in [0.25, 0.5, 0.75, largest] {
                assert_eq!(
                    m.is_within(Quantity::of(limit as f32)),
                    largest <= limit,
                    "{a:?} {limit}"
                );
            }
            let three = [a[0], a[1], a[2]];
            let largest = three.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let vector = v::<A, Metre>(three);
            for limit in [0.25, 0.5, 0.75, largest] {
                assert_eq!(
                    vector.is_within(Quantity::of(limit as f32)),
                    largest <= limit
                );
            }
        }
        let whole = Four::<A, Metre>::whole([1, -2, 3, -4]);
        assert_eq!(lanes(whole), [1.0, -2.0, 3.0, -4.0]);
        assert_eq!(lanes(Four::<A, Metre>::ZERO), [0.0; 4]);
        assert_eq!(value(whole.lane(4)), 1.0, "lanes go round");
        for lane in 0..4 {
            let mut other = [1, -2, 3, -4];
            other[lane] *= 2;
            assert!(whole != Four::whole(other));
        }
    }
    check::<Float>();
    check::<Fixed>();
}

/// A number beyond a limit in any lane, by the least that there is.
#[test]
fn within_a_limit_is_exact_in_every_lane() {
    for lane in 0..4 {
        for sign in [1.0_f32, -1.0] {
            let mut at = [0.1_f32; 4];
            at[lane] = sign * 0.75;
            assert!(Four::<Float, Metre>::of(at).is_within(Quantity::of(0.75)));
            assert!(Four::<Fixed, Metre>::of(at).is_within(Quantity::of(0.75)));
            at[lane] = sign * 0.75_f32.next_up();
            assert!(!Four::<Float, Metre>::of(at).is_within(Quantity::of(0.75)));
            let mut bits = [FixedI32::<U28>::from_bits(5); 4];
            bits[lane] = FixedI32::from_bits((3 << 26) + 1);
            if sign < 0.0 {
                bits[lane] = -bits[lane];
            }
            assert!(!Four::<Fixed, Metre>::load(&bits).is_within(Quantity::of(0.75)));
            at[lane] = f32::NAN;
            assert!(!Four::<Float, Metre>::of(at).is_within(Quantity::of(0.75)));
        }
    }
    let least = Four::<Fixed, Metre>::load(&[FixedI32::MIN; 4]);
    assert!(!least.is_within(Quantity::of(7.0)));
}

#[test]
fn lengths_and_directions_of_short_vectors_are_exact() {
    fn check<A: Magnitudes>(within: f64) {
        for (vector, length) in [
            ([2.0, 3.0, 6.0], 7.0),
            ([-2.0, 6.0, -3.0], 7.0),
            ([1.0, 4.0, 8.0], 9.0),
            ([0.0, -3.0, 4.0], 5.0),
            ([0.0, 0.0, -1.0], 1.0),
            ([1.0, 0.0, 0.0], 1.0),
            ([0.0, 1.0, 0.0], 1.0),
        ] {
            for scale in [0.125, 2e-3, 1e-5] {
                let vector: [f64; 3] = vector.map(|x| x * scale);
                let (length, m) = (length * scale, v::<A, Metre>(vector));
                // A step of 3.7 nm in fixed point.
                let share = within + 4e-9 * within.signum() / length;
                let near = |found: f64, exact: f64| {
                    assert!((found - exact).abs() < share, "{vector:?}: {found} {exact}");
                };
                for magnitude in [Magnitude::above_zero(m), Magnitude::unguarded(m)] {
                    near(value(magnitude.length()) / length, 1.0);
                    let direction = values(m.direction(magnitude));
                    for (found, exact) in direction.iter().zip(vector) {
                        near(*found, exact / length);
                    }
                    let half = magnitude.divides(q(length / 2.0));
                    near(value(half), 0.5);
                    assert!(value(magnitude.divides(q(length * 1.01))) >= 1.0);
                    // Along itself it is its length; across, nothing.
                    let one: Quantity<A, Fraction> = Quantity::whole(1);
                    near(value(one * m.along(m, magnitude)) / length, 1.0);
                    let other = v::<A, Metre>([0.01, -0.02, 0.04]);
                    let exact = dot([0.01, -0.02, 0.04], vector) / length;
                    let found = value(one * other.along(m, magnitude));
                    assert!((found - exact).abs() < 0.1 * share, "{found} {exact}");
                }
            }
        }
        let none = Magnitude::above_zero(Vector::<A, Metre>::ZERO);
        assert!(value(none.length()).abs() < 1e-17);
        assert_eq!(values(Vector::<A, Metre>::ZERO.direction(none)), [0.0; 3]);
        assert!(
            value(none.divides(q(0.001))) >= 1.0,
            "everything reaches no length"
        );
    }
    check::<Float>(3e-7);
    check::<Fixed>(3e-8);
}

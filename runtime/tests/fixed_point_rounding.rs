//! Fixed point rounds every result once, to the nearest, and ends at the ends of its range.

use asperity_runtime::{
    Arithmetic, Fixed, Float,
    arithmetic::{Cut, Point, Scalar},
    quantity::{
        Quantity,
        unit::{Coefficient, LineCosine},
    },
};
use asperity_tests::draw::Draw;
use fixed::{
    FixedI32,
    types::extra::{U10, U12, U15, U16, U20, U22, U24, U28, U30},
};

/// `wide` with `shift` more bits behind the point, rounded to the nearest, halves up.
fn rounded(wide: i128, shift: i32) -> i128 {
    if shift <= 0 {
        return wide << -shift;
    }
    (wide + (1 << (shift - 1))).div_euclid(1 << shift)
}

/// Bits of fixed point of every size, ends included.
fn bits(draw: &mut Draw) -> i32 {
    match draw.below(12) {
        0 => 0,
        1 => 1,
        2 => -1,
        _ => (draw.bits() as i32) >> draw.below(31),
    }
}

fn held(x: i128) -> bool {
    i128::from(i32::MIN) <= x && x <= i128::from(i32::MAX)
}

fn products_round_once<F: Point, G: Point, H: Point>(draw: &mut Draw) -> usize {
    let shift = F::I32 + G::I32 - H::I32;
    let mut checked = 0;
    for _ in 0..2000 {
        let a = [0; 4].map(|_| bits(draw) >> 3);
        let c = [0; 4].map(|_| bits(draw) >> 3);
        let wide = |lane: usize| i128::from(a[lane]) * i128::from(c[lane]);
        let (x, y) = (
            a.map(FixedI32::<F>::from_bits),
            c.map(FixedI32::<G>::from_bits),
        );
        let limit = 3.5_f32;
        let most = ((f64::from(limit) * 2_f64.powi(H::I32)) as i128).min(i128::from(i32::MAX));
        let cut = |x: i128| x.clamp(-most, most) as i32;
        let four = [0, 1, 2, 3].map(|lane| rounded(wide(lane), shift));
        let at = Cut::At(limit);
        let product: FixedI32<H> = Fixed::product(x[0], y[0], at);
        assert_eq!(product.to_bits(), cut(four[0]));
        let (fx, fy) = (Fixed::four(&x), Fixed::four(&y));
        let found = Fixed::numbers::<H>(Fixed::four_product(fx, fy, at));
        assert_eq!(found.map(|x| x.to_bits()), four.map(cut));
        let sum = rounded(wide(0) + wide(1), shift);
        let terms = [(x[0], y[0]), (x[1], y[1])];
        let found: FixedI32<H> = Fixed::sum_of_products(terms, at);
        assert_eq!(found.to_bits(), cut(sum));
        let twice = Fixed::numbers::<H>(Fixed::four_sum_of_products([(fx, fy), (fx, fy)], at));
        let doubled = [0, 1, 2, 3].map(|lane| cut(rounded(2 * wide(lane), shift)));
        assert_eq!(twice.map(|x| x.to_bits()), doubled);
        if held(four[0]) {
            checked += 1;
            let product: FixedI32<H> = Fixed::product(x[0], y[0], Cut::Never);
            assert_eq!(i128::from(product.to_bits()), four[0]);
        }
        if held(sum) {
            let found: FixedI32<H> = Fixed::sum_of_products(terms, Cut::Never);
            assert_eq!(i128::from(found.to_bits()), sum);
        }
        let dot = rounded(wide(0) + wide(1) + wide(2), shift);
        if held(dot) {
            let found: FixedI32<H> = Fixed::dot3(fx, fy);
            assert_eq!(i128::from(found.to_bits()), dot);
        }
    }
    checked
}

#[test]
fn products_and_their_sums_are_rounded_once_to_the_nearest_or_cut() {
    let mut draw = Draw::new(2);
    let checked = [
        products_round_once::<U28, U30, U28>(&mut draw),
        products_round_once::<U12, U28, U16>(&mut draw),
        products_round_once::<U22, U16, U16>(&mut draw),
        products_round_once::<U20, U20, U20>(&mut draw),
        products_round_once::<U24, U10, U16>(&mut draw),
        products_round_once::<U10, U10, U20>(&mut draw),
        products_round_once::<U10, U12, U24>(&mut draw),
    ];
    assert!(checked.iter().all(|n| *n > 100), "{checked:?}");
}

#[test]
fn conversions_between_points_round_to_the_nearest() {
    fn check<F: Point, G: Point>(draw: &mut Draw) {
        for _ in 0..2000 {
            let a = bits(draw);
            let exact = rounded(a.into(), F::I32 - G::I32);
            if held(exact) {
                let found: FixedI32<G> = Fixed::convert(FixedI32::<F>::from_bits(a));
                assert_eq!(i128::from(found.to_bits()), exact, "{a}");
            }
        }
    }
    let mut draw = Draw::new(3);
    check::<U28, U16>(&mut draw);
    check::<U16, U28>(&mut draw);
    check::<U22, U28>(&mut draw);
    check::<U15, U20>(&mut draw);
    check::<U20, U20>(&mut draw);
    let coefficient = Quantity::<Fixed, Coefficient>::of(1.75);
    assert_eq!(coefficient.to::<LineCosine>().value(), 1.75);
}

#[test]
fn a_float_becomes_the_nearest_number_or_the_end_of_the_range() {
    fn check<F: Point>(draw: &mut Draw) {
        let scale = 2_f64.powi(F::I32);
        for _ in 0..5000 {
            let x = f32::from_bits(draw.bits() as u32);
            let small = (draw.range(-3.0, 3.0) * 2_f64.powi(-(draw.below(30) as i32))) as f32;
            for x in [x, small] {
                let number = <FixedI32<F> as Scalar>::of(x);
                if x.is_nan() {
                    assert_eq!(number.to_bits(), 0);
                    assert!(!<FixedI32<F> as Scalar>::holds(x));
                    continue;
                }
                // Halves go away from zero.
                let exact = (f64::from(x) * scale).round();
                let wanted = exact.clamp(i32::MIN.into(), i32::MAX.into()) as i32;
                assert_eq!(number.to_bits(), wanted, "{x}");
                let most = f64::from(i32::MAX) / scale;
                let holds = <FixedI32<F> as Scalar>::holds(x);
                assert_eq!(holds, f64::from(x).abs() <= most, "{x}");
                let back = (f64::from(wanted) / scale) as f32;
                assert_eq!(Scalar::value(number), back);
                let bits = Scalar::bits(number);
                assert_eq!(bits, wanted as u32);
                assert_eq!(<FixedI32<F> as Scalar>::from_bits(bits), number);
            }
        }
    }
    let mut draw = Draw::new(4);
    check::<U10>(&mut draw);
    check::<U16>(&mut draw);
    check::<U28>(&mut draw);
    check::<U30>(&mut draw);
    type Metres = FixedI32<U28>;
    // The ends: ±8 m, of which the upper one is just out of range.
    assert!(<Metres as Scalar>::holds(8.0_f32.next_down()));
    assert!(!<Metres as Scalar>::holds(8.0) && !<Metres as Scalar>::holds(-8.0));
    assert_eq!(<Metres as Scalar>::FARTHEST, Metres::MAX);
    assert_eq!(<Metres as Scalar>::MISSING, Metres::MIN);
    let (most, least) = (Metres::MAX, Metres::MIN);
    let step = Metres::from_bits(1);
    assert_eq!(Scalar::saturating_add(most, step), most);
    assert_eq!(Scalar::saturating_add(least, -step), least);
    assert_eq!(Scalar::saturating_add(step, step).to_bits(), 2);
    assert!(<f32 as Scalar>::MISSING.is_nan() && !<f32 as Scalar>::holds(f32::NAN));
    assert!(<f32 as Scalar>::holds(f32::INFINITY) && <f32 as Scalar>::holds(-1.0));
    assert_eq!(<f32 as Scalar>::FARTHEST, f32::INFINITY);
    assert_eq!(Scalar::saturating_add(1.5_f32, 2.0), 3.5);
    assert_eq!(<f32 as Scalar>::from_bits(Scalar::bits(-2.5_f32)), -2.5);
}

#[test]
fn whole_numbers_have_no_part_behind_the_point() {
    for n in [-7, -1, 0, 1, 7] {
        assert_eq!(Fixed::whole::<U28>(n).to_bits(), n << 28);
        assert_eq!(Fixed::whole::<U10>(n).to_bits(), n << 10);
        assert_eq!(Float::whole::<U28>(n), n as f32);
    }
}

#[test]
fn three_of_four_are_kept_and_the_fourth_is_none() {
    let four = [1, 2, 3, 4].map(FixedI32::<U20>::from_bits);
    let kept = Fixed::four_of_three::<U20>(Fixed::three(Fixed::four(&four)));
    let wanted = [1, 2, 3, 0].map(FixedI32::<U20>::from_bits);
    assert_eq!(Fixed::numbers(kept), wanted);
    assert_eq!(
        Fixed::numbers(Fixed::first_three(Fixed::four(&four))),
        wanted
    );
    let four = [1.0, 2.0, 3.0, 4.0];
    let kept = Float::four_of_three::<U20>(Float::three::<U20>(Float::four::<U20>(&four)));
    assert_eq!(Float::numbers::<U20>(kept)[..3], four[..3]);
}

#[test]
fn sums_of_products_of_floats_go_from_the_first_to_the_last() {
    // In any other order the small one would be lost, or the large ones would not cancel.
    let terms = [(1e8, 1.0), (1e8, -1.0), (0.5, 0.5)];
    let none = Cut::At(0.1);
    let sum = Float::sum_of_products::<3, U20, U20, U20>(terms, none);
    assert_eq!(sum, 0.25, "floats are not cut");
    let four = |x: f32| Float::four::<U20>(&[x; 4]);
    let terms = terms.map(|(x, c)| (four(x), four(c)));
    let sum = Float::four_sum_of_products::<3, U20, U20, U20>(terms, none);
    assert_eq!(Float::numbers::<U20>(sum), [0.25; 4]);
    assert_eq!(Float::product::<U20, U20, U20>(3.0, 0.5, none), 1.5);
    assert_eq!(Float::quotient::<U20, U20, U20>(3.0, 4.0), 0.75);
}

//! Conversion of mixed parameters to coefficients, at any precision.
//!
//! Zero pairs are multiplied in the order of [`stage`], low and high frequencies in turn.
//! Products of neighbouring zeros grow large and cancel later; products of zeros far apart
//! stay small.

use crate::number::Number;
use asperity_formats::limits::MAX_ORDER;

/// A number for each pole or zero; 0 above the order.
pub(crate) type OrderArray<P> = [P; MAX_ORDER];

/// Half of a symmetric polynomial, of the sum and of the difference side. Two zeros stand
/// before the first coefficient.
type Half<P> = [[P; 2]; 16];
const FIRST: usize = 2;

/// Where LSF `index` of `order` is stored.
///
/// LSFs of the sum polynomial stand at even places, those of the difference polynomial at odd
/// ones; on each side low and high frequencies take turns.
pub(crate) fn stage(index: usize, order: usize) -> usize {
    let (side, pair) = (index % 2, index / 2);
    let pairs = (order + 1 - side) / 2;
    let turn = if 2 * pair < pairs {
        2 * pair
    } else {
        2 * (pairs - 1 - pair) + 1
    };
    2 * turn + side
}

/// Coefficients 1..=p of A(z) from the cosines of its LSFs.
pub(crate) fn from_cosines<P: Number>(cosines: &OrderArray<P>, order: usize) -> OrderArray<P> {
    let minus_two = P::of(-2.0);
    let mut half: Half<P> = [[P::ZERO; 2]; 16];
    half[FIRST] = [P::of(1.0); 2];
    let pairs = order / 2;
    for (done, pair) in cosines.as_chunks::<2>().0.iter().take(pairs).enumerate() {
        let m = [minus_two.times(pair[0]), minus_two.times(pair[1])];
        for k in (FIRST + 1..=FIRST + done + 1).rev() {
            for lane in 0..2 {
                half[k][lane] = multiplied(&half, k, done, lane, m[lane]);
            }
        }
    }
    if order % 2 == 1 {
        let m = minus_two.times(cosines[order - 1]);
        for k in (FIRST + 1..=FIRST + pairs + 1).rev() {
            half[k][0] = multiplied(&half, k, pairs, 0, m);
        }
    }
    assemble(&half, order)
}

/// Coefficient `k` of a symmetric polynomial of degree `2·done` times 1 + m z⁻¹ + z⁻².
#[inline]
fn multiplied<P: Number>(half: &Half<P>, k: usize, done: usize, lane: usize, m: P) -> P {
    // The polynomial is symmetric: past the middle, read the mirror image.
    let here = if k == FIRST + done + 1 {
        half[k - 2][lane]
    } else {
        half[k][lane]
    };
    here.plus(half[k - 2][lane])
        .plus(m.times(half[k - 1][lane]))
}

/// a_k = (q_k + p_k)/2 and a_{p+1−k} = (q_k − p_k)/2.
#[inline]
fn assemble<P: Number>(half: &Half<P>, order: usize) -> OrderArray<P> {
    let one_half = P::of(0.5);
    let mut a = [P::ZERO; MAX_ORDER];
    let odd = order % 2 == 1;
    for k in 1..=order.div_ceil(2) {
        let at = FIRST + k;
        let (q, p) = if odd {
            let middle = 2 * k == order + 1;
            let p = if middle {
                P::ZERO
            } else {
                half[at][1].minus(half[at - 2][1])
            };
            (half[at][0], p)
        } else {
            (
                half[at][0].plus(half[at - 1][0]),
                half[at][1].minus(half[at - 1][1]),
            )
        };
        a[order - k] = one_half.times(q.minus(p));
        a[k - 1] = one_half.times(q.plus(p));
    }
    a
}

/// cos ω for ω in 0..π, within 6e-8: minus the sine of ω − π/2.
#[inline]
pub(crate) fn cosine<P: Number>(omega: P) -> P {
    const ODD: [f64; 6] = [
        1.0,
        -1.0 / 6.0,
        1.0 / 120.0,
        -1.0 / 5_040.0,
        1.0 / 362_880.0,
        -1.0 / 39_916_800.0,
    ];
    let t = omega.minus(P::of(core::f64::consts::FRAC_PI_2));
    let square = t.times(t);
    let sum = ODD
        .iter()
        .rev()
        .fold(P::ZERO, |sum, &c| sum.times(square).plus(P::of(c)));
    P::ZERO.minus(t.times(sum))
}

/// k = tanh(x/2) of a log-area ratio x: a continued fraction at x/32, doubled four times.
#[inline]
pub(crate) fn from_log_area<P: Number>(ratio: P) -> P {
    let t = ratio.times(P::of(1.0 / 32.0));
    let square = t.times(t);
    let above = P::of(945.0).plus(square.times(P::of(105.0).plus(square)));
    let below = P::of(945.0).plus(square.times(P::of(420.0).plus(square.times(P::of(15.0)))));
    (0..4).fold(t.times(above).over(below), |k, _| {
        P::of(2.0).times(k).over(P::of(1.0).plus(k.times(k)))
    })
}

/// Coefficients of A(z) from reflection coefficients.
pub(crate) fn step_up<P: Number>(reflection: &OrderArray<P>, order: usize) -> OrderArray<P> {
    let mut a = [P::ZERO; MAX_ORDER];
    for (done, &r) in reflection.iter().enumerate().take(order) {
        for i in 0..done.div_ceil(2) {
            let (x, y) = (a[i], a[done - 1 - i]);
            a[i] = x.plus(r.times(y));
            a[done - 1 - i] = y.plus(r.times(x));
        }
        a[done] = r;
    }
    a
}

/// Reflection coefficients of A(z); where one of them is 1 or more, A(z) is not stable.
pub(crate) fn step_down<P: Number>(coefficients: &OrderArray<P>, order: usize) -> OrderArray<P> {
    let mut a = *coefficients;
    for last in (0..order).rev() {
        let r = a[last];
        let scale = P::of(1.0).over(P::of(1.0).minus(r.times(r)));
        for i in 0..last.div_ceil(2) {
            let (x, y) = (a[i], a[last - 1 - i]);
            a[i] = x.minus(r.times(y)).times(scale);
            a[last - 1 - i] = y.minus(r.times(x)).times(scale);
        }
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;
    use asperity::signal::{lsf, reflection};

    fn angles(order: usize) -> Vec<f64> {
        let step = core::f64::consts::PI / (order + 1) as f64;
        (1..=order)
            .map(|k| step * (k as f64 + 0.3 * (k as f64 * 7.0).sin()))
            .collect()
    }

    #[test]
    fn every_order_agrees_with_the_compiler() {
        for order in 1..=MAX_ORDER {
            let lsf_rad = angles(order);
            let mut cosines = [0.0; MAX_ORDER];
            for (index, omega) in lsf_rad.iter().enumerate() {
                cosines[stage(index, order)] = cosine(*omega);
            }
            let exact = lsf::to_polynomial(&lsf_rad);
            let a = from_cosines(&cosines, order);
            let k = step_down(&a, order);
            let back = step_up(&k, order);
            let reflection = reflection::step_down(&exact).expect("stable");
            for i in 0..order {
                assert!((a[i] - exact[i + 1]).abs() < 1e-5, "order {order}");
                assert!((back[i] - a[i]).abs() < 1e-9);
                assert!((k[i] - reflection[i]).abs() < 1e-4);
            }
        }
    }

    #[test]
    fn a_log_area_ratio_gives_its_reflection_coefficient_back() {
        for k in [-0.999_998_f64, -0.9, -0.1, 0.0, 0.5, 0.99] {
            let ratio = ((1.0 + k) / (1.0 - k)).ln();
            assert!((from_log_area(ratio) - k).abs() < 1e-7, "{k}");
        }
    }
}

//! Converts the codes of a model's LSFs to the −2 cos ω that a tick mixes.

use crate::{
    arithmetic::{Arithmetic, Scalar as _},
    lanes::F4,
    math::minus_two_cos_pi,
    model::lsf_to_ar::place,
    quantity::{Raw, unit::LineCosine},
};
use asperity_formats::{LsfCode, limits::MAX_ORDER};

/// Fours of cosines that are taken side by side: none waits for another.
const SIDE_BY_SIDE: usize = if F4::IN_REGISTERS { 3 } else { 1 };

/// −2 cos ω of a model, in the order of [`place`]; the rest is 0. Four places take two codes from
/// either end; the codes left in the middle come last.
// Where the length of a row is known, it costs a fifth less.
#[cfg_attr(not(target_arch = "arm"), inline(always))]
pub(super) fn to_cosines<A: Arithmetic>(row: &mut [Raw<A, LineCosine>], codes: &[[u8; 2]]) {
    let order = codes.len();
    let front = codes.as_chunks::<2>().0;
    let back = codes.as_rchunks::<2>().1.iter().rev();
    // An odd order takes the upper of two first.
    let turn = u16::BITS * (order as u32 % 2);
    // The cosine of half of a half turn is 0.
    let mut angles = [F4::HALF; MAX_ORDER / 4];
    let mut places = angles.iter_mut();
    let whole = front.iter().zip(back).take(order / 4);
    for ((&front, &back), place) in whole.zip(places.by_ref()) {
        *place = half_turns(two(front), two(back).rotate_left(turn));
    }
    let left = codes.get(order / 4 * 2..).unwrap_or_default();
    let left = match *left.get(..order % 4).unwrap_or_default() {
        [a] => Some([[a, RIGHT_ANGLE], [RIGHT_ANGLE; 2]]),
        [a, b] => Some([[a, b], [RIGHT_ANGLE; 2]]),
        [a, b, c] => Some([[a, b], [c, RIGHT_ANGLE]]),
        _ => None,
    };
    if let (Some([front, back]), Some(place)) = (left, places.next()) {
        *place = half_turns(two(front), two(back));
    }
    let angles = angles.as_chunks::<SIDE_BY_SIDE>().0;
    for (places, &angles) in row.chunks_mut(4 * SIDE_BY_SIDE).zip(angles) {
        let cosines = minus_two_cos_pi(angles);
        for (place, four) in places.as_chunks_mut().0.iter_mut().zip(cosines) {
            *place = (four + F4::splat(AWAY_FROM_ZERO))
                .to_array()
                .map(A::Scalar::of);
        }
    }
}

/// Added to a cosine, 2⁻⁵⁰, which leaves all but 0 as they are: a line spectrum would approach a 0
/// through denormals.
const AWAY_FROM_ZERO: f32 = f32::from_bits((127 - 50) << 23);

/// A code whose cosine is 0.
const RIGHT_ANGLE: [u8; 2] = 0x8000_u16.to_le_bytes();

/// Two codes, the first in the lower half.
fn two([[a, b], [c, d]]: [[u8; 2]; 2]) -> u32 {
    u32::from_le_bytes([a, b, c, d])
}

/// ω / π of four codes.
#[inline(always)]
fn half_turns(front: u32, back: u32) -> F4 {
    let half_turns = |code: u32| LsfCode::from_bits(code as u16).half_turns();
    F4::load(&[front, front >> 16, back, back >> 16].map(half_turns))
}

/// Which code [`to_cosines`] puts at a place.
const fn source(place: usize, order: usize) -> usize {
    let (four, lane) = (place / 4, place % 4);
    if lane < 2 || four == order / 4 {
        2 * four + lane
    } else {
        order - 2 - 2 * four + (lane + order) % 2
    }
}

// That order is the one in which conversion multiplies.
const _: () = {
    let mut order = 1;
    while order <= MAX_ORDER {
        let mut at = 0;
        while at < order {
            assert!(place(source(at, order), order) == at);
            at += 1;
        }
        order += 1;
    }
};

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::{Fixed, Float};
    use std::vec::Vec;

    /// −2 cos(π·code/65536) of every code at the place where conversion expects it, zeros behind.
    #[test]
    fn every_code_becomes_its_cosine_at_its_place() {
        fn check<A: Arithmetic>(within: f64) {
            for order in 0..=MAX_ORDER {
                let codes: Vec<u16> = (0..order)
                    .map(|at| (65_536 * (at + 1) / (order + 1)) as u16)
                    .collect();
                let stored: Vec<_> = codes.iter().map(|code| code.to_le_bytes()).collect();
                let mut row = [A::Scalar::of(1.5); MAX_ORDER];
                to_cosines::<A>(&mut row, &stored);
                for (index, &code) in codes.iter().enumerate() {
                    let angle = core::f64::consts::PI * f64::from(code) / 65_536.0;
                    let found = f64::from(row[place(index, order)].value());
                    let exact = -2.0 * angle.cos();
                    assert!(
                        (found - exact).abs() < within,
                        "{index} of {order}: {found}"
                    );
                }
                let used: Vec<_> = (0..order).map(|index| place(index, order)).collect();
                for (at, cosine) in row.iter().enumerate() {
                    let next_to_nothing = cosine.value().abs() < 1e-12;
                    assert!(used.contains(&at) || next_to_nothing, "{at} of {order}");
                }
            }
        }
        check::<Float>(5e-7);
        check::<Fixed>(5e-7);
    }

    /// A short row takes what it has room for.
    #[test]
    fn a_row_of_the_length_of_its_order_is_filled() {
        for order in (4..=MAX_ORDER).step_by(4) {
            let codes: Vec<_> = (1..=order as u16)
                .map(|at| (2000 * at).to_le_bytes())
                .collect();
            let (mut short, mut long) = ([0.0; MAX_ORDER], [0.0; MAX_ORDER]);
            to_cosines::<Float>(&mut short[..order], &codes);
            to_cosines::<Float>(&mut long, &codes);
            assert_eq!(short[..order], long[..order]);
        }
    }

    /// A line spectrum that goes to a cosine of 0 never passes through denormals.
    #[test]
    fn a_right_angle_is_next_to_nothing_and_not_zero() {
        let mut row = [0.0; 4];
        to_cosines::<Float>(&mut row, &[RIGHT_ANGLE]);
        assert!(row[0] > 0.0 && row[0].is_normal() && row[0] < 1e-14);
    }
}

//! Floating point: `f32`, and registers of four.

use super::{Arithmetic, NEARLY_INSIDE, Point, Scalar, Zero};
use crate::{
    Config, ConfigError, LoadError, Surface,
    lanes::{F3, F4},
    lsf::Two,
    math::{max, sqrt, sqrt_pair},
};
use asperity_formats::Asset;
use core::ops::{Add, Mul};

/// IEEE 754 `f32`. Every operation rounds alike on every processor, and no two are fused.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Float;

/// Weights that a search keeps.
const BEST: usize = if F4::IN_REGISTERS { 4 } else { 1 };

/// The best of all weights so far, or the best in each lane of a register.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Best([f32; BEST]);

impl Best {
    #[inline(always)]
    fn of(lanes: F4) -> Self {
        let mut best = [0.0; BEST];
        best.copy_from_slice(&lanes.to_array()[..BEST]);
        Self(best)
    }

    #[inline(always)]
    fn lanes(self) -> F4 {
        let mut lanes = [0.0; 4];
        lanes[..BEST].copy_from_slice(&self.0);
        F4::load(&lanes)
    }
}

/// A length and its reciprocal.
#[derive(Debug, Clone, Copy)]
pub struct FloatPolar {
    length: f32,
    inverse: f32,
}

impl FloatPolar {
    /// Adds nothing to a length in use, and makes the reciprocal of none finite.
    const NO_LENGTH: f32 = 1.0e-18;
    /// Its square.
    const LEAST: f32 = 1.0e-36;
}

/// Below this an output that decays is set to zero, so that no denormal slows a tick.
const SILENCE_M_S2: f32 = 1.0e-20;
/// Bound of the vibration: see [`Arithmetic::VIB_LIMIT_M_S2`].
const VIB_LIMIT_M_S2: f32 = 1.0e4;
/// Lengths beyond this are errors.
const SANE: f32 = 1e15;
/// ε = s·(C1 + C3·s²): see [`excitation`](crate::excitation).
pub(crate) const C1: f32 = 0.006_421_041;
pub(crate) const C3: f32 = 5.773_954e-9;

impl Zero for f32 {
    const ZERO: Self = 0.0;
}

impl Zero for F4 {
    const ZERO: Self = Self::ZERO;
}

impl Zero for F3 {
    const ZERO: Self = Self::ZERO;
}

impl Scalar for f32 {
    const FARTHEST: Self = Self::INFINITY;
    const MISSING: Self = Self::NAN;

    #[inline(always)]
    fn of(value: f32) -> Self {
        value
    }

    #[inline(always)]
    fn value(self) -> f32 {
        self
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        self.to_bits()
    }

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        Self::from_bits(bits)
    }

    fn holds(value: f32) -> bool {
        !value.is_nan()
    }
}

impl Arithmetic for Float {
    type Scalar<F: Point> = f32;
    type Four<F: Point> = F4;
    type Three<F: Point> = F3;
    type Best = Best;
    type Square = f32;
    type Polar = FloatPolar;
    type Sum = F4;

    const WORST: Best = Best([-1.0e30; BEST]);
    const FAR_OFF: f32 = 1.0e6;
    const STEEP: f32 = 1.0e3;
    const ONE_HALF: f32 = 0.5;
    const IN_REGISTERS: bool = F4::IN_REGISTERS;
    const REACH_M: f32 = 1.0e4;
    const OUT_OF_REACH_M: f32 = 1.0e5;
    const ROUNDING_N: f32 = 0.0;
    const VIB_LIMIT_M_S2: f32 = VIB_LIMIT_M_S2;
    const SILENCE_M_S2: f32 = SILENCE_M_S2;

    fn check_config(_: &Config) -> Result<(), ConfigError> {
        Ok(())
    }

    fn check_surface(_: &Surface) -> Result<(), ConfigError> {
        Ok(())
    }

    fn check(_: &Asset<'_>) -> Result<(), LoadError> {
        Ok(())
    }

    #[inline(always)]
    fn whole<F: Point>(n: i32) -> f32 {
        n as f32
    }

    #[inline(always)]
    fn nearest<F: Point>(a: f32) -> u32 {
        /// From here on floats are whole numbers: a sum rounds to the nearest.
        const WHOLE: f32 = (1 << 23) as f32;
        (a + WHOLE).to_bits() % (1 << 23)
    }

    #[inline(always)]
    fn to<F: Point, G: Point>(a: f32) -> f32 {
        a
    }

    #[inline(always)]
    fn plus_within<F: Point>(a: f32, b: f32) -> f32 {
        a + b
    }

    #[inline(always)]
    fn times<F: Point, G: Point, H: Point>(a: f32, b: f32) -> f32 {
        a * b
    }

    #[inline(always)]
    fn times_within<F: Point, G: Point, H: Point>(a: f32, b: f32, _: f32) -> f32 {
        a * b
    }

    #[inline(always)]
    fn left_of<F: Point>(a: f32, b: f32) -> f32 {
        if a > 0.0 { max(a - b, 0.0) } else { 0.0 }
    }

    #[inline(always)]
    fn over<F: Point, G: Point, H: Point>(a: f32, b: f32) -> f32 {
        a / b
    }

    #[inline(always)]
    fn four<F: Point>(numbers: &[f32; 4]) -> F4 {
        F4::load(numbers)
    }

    #[inline(always)]
    fn three<F: Point>(four: F4) -> F3 {
        F3::of(four)
    }

    #[inline(always)]
    fn four_of_three<F: Point>(three: F3) -> F4 {
        three.four()
    }

    #[inline(always)]
    fn numbers<F: Point>(four: F4) -> [f32; 4] {
        four.to_array()
    }

    #[inline(always)]
    fn four_plus<F: Point>(a: F4, b: F4) -> F4 {
        a + b
    }

    #[inline(always)]
    fn four_minus<F: Point>(a: F4, b: F4) -> F4 {
        a - b
    }

    #[inline(always)]
    fn alternating<F: Point>(a: F4) -> F4 {
        F4::load(&[1.0, -1.0, 1.0, -1.0]) * a
    }

    #[inline(always)]
    fn four_min<F: Point>(a: F4, b: F4) -> F4 {
        a.min(b)
    }

    #[inline(always)]
    fn four_times<F: Point, G: Point, H: Point>(a: F4, b: F4) -> F4 {
        a * b
    }

    #[inline(always)]
    fn four_scaled<F: Point, G: Point, H: Point>(a: F4, b: f32) -> F4 {
        a * F4::splat(b)
    }

    #[inline(always)]
    fn four_times_within<F: Point, G: Point, H: Point>(a: F4, b: F4, _: F4) -> F4 {
        a * b
    }

    #[inline(always)]
    fn four_sum_within<const N: usize, F: Point, G: Point, H: Point>(
        terms: [(F4, F4); N],
        _: f32,
    ) -> F4 {
        let (x, c) = terms[0];
        terms[1..].iter().fold(c * x, |sum, &(x, c)| sum + c * x)
    }

    #[inline(always)]
    fn sum_within<const N: usize, F: Point, G: Point, H: Point>(
        terms: [(f32, f32); N],
        _: f32,
    ) -> f32 {
        let (x, c) = terms[0];
        terms[1..].iter().fold(c * x, |sum, &(x, c)| sum + c * x)
    }

    #[inline(always)]
    fn dot3<F: Point, G: Point, H: Point>(a: F4, b: F4) -> f32 {
        a.dot3(b)
    }

    #[inline(always)]
    fn first_three<F: Point>(a: F4) -> F4 {
        a
    }

    #[inline(always)]
    fn is_within<F: Point>(a: F4, limit: f32) -> bool {
        a.is_within(limit)
    }

    #[inline(always)]
    fn better(best: Best, four: F4, bits: u32, index: u32) -> Best {
        // Zeros lose their sign, which platforms compare differently.
        let four = four + F4::ZERO;
        if F4::IN_REGISTERS {
            return Best::of(four.mark(bits, index).max(best.lanes()));
        }
        let marked = |x: f32, index: u32| f32::from_bits(x.to_bits() & !bits | index);
        let lanes = four.to_array().into_iter().zip(index..);
        let least = best.lanes().to_array()[0];
        Best([lanes.fold(least, |best, (x, index)| max(marked(x, index), best)); BEST])
    }

    #[inline(always)]
    fn is_inside(best: Best) -> bool {
        if F4::IN_REGISTERS {
            return best.lanes().reaches(NEARLY_INSIDE);
        }
        best.0[0] >= NEARLY_INSIDE
    }

    #[inline(always)]
    fn keep_best(best: Best, bits: &mut [u32; 4]) {
        for (bits, lane) in bits.iter_mut().zip(best.0) {
            *bits = lane.to_bits();
        }
    }

    #[inline(always)]
    fn kept_best(bits: &[u32; 4]) -> Best {
        let mut best = [0.0; BEST];
        for (lane, bits) in best.iter_mut().zip(bits) {
            *lane = f32::from_bits(*bits);
        }
        Best(best)
    }

    #[inline(always)]
    fn best(best: Best, bits: u32) -> u32 {
        if !F4::IN_REGISTERS {
            return best.0[0].to_bits() & bits;
        }
        let lanes = best.lanes().to_array();
        let lane = |lane: usize| f32::from_bits(lanes[lane].to_bits() | lane as u32);
        max(max(lane(0), lane(1)), max(lane(2), lane(3))).to_bits() & bits
    }

    #[inline(always)]
    fn square<F: Point>(a: F4) -> f32 {
        a.dot3(a)
    }

    #[inline(always)]
    fn square_of<F: Point>(length: f32) -> f32 {
        length * length
    }

    #[inline(always)]
    fn is_some(square: f32) -> bool {
        square > 1e-18
    }

    #[inline(always)]
    fn is_sane(square: f32) -> bool {
        square <= SANE * SANE
    }

    #[inline(always)]
    fn polar(square: f32) -> FloatPolar {
        let length = sqrt(square);
        FloatPolar {
            length,
            inverse: 1.0 / (length + FloatPolar::NO_LENGTH),
        }
    }

    #[inline(always)]
    fn polar_pair<F: Point, G: Point>(a: F4, b: F4) -> [FloatPolar; 2] {
        let [x, y, z, _] = (a * a).to_array();
        // No sum waits for what keeps the reciprocal finite.
        let square = (x + y) + (z + FloatPolar::LEAST);
        sqrt_pair([square, b.dot3(b)]).map(|length| FloatPolar {
            length,
            inverse: 1.0 / length,
        })
    }

    #[inline(always)]
    fn tangential<F: Point>(vector: F4, normal: F4) -> F4 {
        vector - normal * F4::splat(vector.dot3(normal))
    }

    #[inline(always)]
    fn length<F: Point>(polar: FloatPolar) -> f32 {
        polar.length
    }

    #[inline(always)]
    fn direction<F: Point>(vector: F4, polar: FloatPolar) -> F4 {
        vector * F4::splat(polar.inverse)
    }

    #[inline(always)]
    fn along<F: Point, G: Point, H: Point>(
        vector: F4,
        other: F4,
        polar: FloatPolar,
        factor: f32,
        _: f32,
    ) -> f32 {
        // The reciprocal is known last.
        vector.dot3(other) * factor * polar.inverse
    }

    #[inline(always)]
    fn share<F: Point>(reach: f32, polar: FloatPolar) -> f32 {
        reach * polar.inverse
    }

    #[inline(always)]
    fn over_root<F: Point>(reach: f32, square: f32) -> f32 {
        reach / sqrt(square)
    }

    #[inline(always)]
    fn extend<const FULL: bool>(two: &Two<f32>, c: [Option<f32>; 5]) -> f32 {
        extended::<FULL, f32>(two, c).unwrap_or(0.0)
    }

    #[inline(always)]
    fn extend_four<const FULL: bool>(two: &Two<F4>, c: [Option<F4>; 5]) -> F4 {
        extended::<FULL, F4>(two, c).unwrap_or(F4::ZERO)
    }

    #[inline(always)]
    fn gaussian(centred: i32) -> f32 {
        let s = centred as f32;
        s * (C1 + C3 * (s * s))
    }

    #[inline(always)]
    fn sum_of(first: f32) -> F4 {
        F4::load(&[first, 0.0, 0.0, 0.0])
    }

    #[inline(always)]
    fn inner_product(blocks: usize, c: &[[f32; 4]], x: &[[f32; 4]]) -> F4 {
        let products = c.iter().zip(x).take(blocks);
        let mut products = products.map(|(c, x)| F4::load(c) * F4::load(x));
        let first = products.next().unwrap_or(F4::ZERO);
        products.fold(first, |partial, product| partial + product)
    }

    #[inline(always)]
    fn sample_of(sum: F4) -> (f32, bool) {
        let raw = sum.sum();
        if is_usual(raw) {
            (raw, false)
        } else {
            bound(raw)
        }
    }
}

/// See [`Arithmetic::extend`]: what is not there takes no operation.
#[inline(always)]
fn extended<const FULL: bool, T: Copy + Add<Output = T> + Mul<Output = T>>(
    two: &Two<T>,
    [c, one, middle, three, four]: [Option<T>; 5],
) -> Option<T> {
    let plus = |a: Option<T>, b: Option<T>| match (a, b) {
        (Some(a), Some(b)) => Some(a + b),
        (a, b) => a.or(b),
    };
    let times = |factor: T, x: Option<T>| x.map(|x| factor * x);
    let shown = |x: Option<T>| if FULL { x } else { times(two.o, x) };
    let ends = plus(plus(c, shown(four)), times(two.q, middle));
    plus(ends, times(two.s, plus(one, shown(three))))
}

/// Whether an output is neither too small to matter, nor too large, nor NaN. Bits of positive
/// numbers are in their order.
#[inline(always)]
fn is_usual(raw: f32) -> bool {
    const LEAST: u32 = SILENCE_M_S2.to_bits();
    const SPAN: u32 = VIB_LIMIT_M_S2.to_bits() - LEAST;
    raw.abs().to_bits().wrapping_sub(LEAST) <= SPAN
}

/// An output too small to matter, too large, or NaN, which becomes silence.
fn bound(raw: f32) -> (f32, bool) {
    if raw.abs() < SILENCE_M_S2 {
        (0.0, false)
    } else if raw > VIB_LIMIT_M_S2 {
        (VIB_LIMIT_M_S2, true)
    } else if raw < -VIB_LIMIT_M_S2 {
        (-VIB_LIMIT_M_S2, true)
    } else {
        (0.0, raw.is_nan())
    }
}

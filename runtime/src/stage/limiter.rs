//! Peak and slew of the total force.
//!
//! The wanted force is shortened to the peak. The way there from the last force is shortened to the
//! slew of a tick. Vectors are shortened, not turned. Hence |F| ≤ peak and
//! |F_n − F_{n−1}| ≤ slew·T, rounding included.

use crate::{
    arithmetic::{Fixed, Float, Point, fixed::wide},
    config::Limits,
    events::Flags,
    math::sqrt,
    quantity::{
        Magnitudes, Quantity, Vector,
        unit::{Fraction, Newton, Unit},
    },
};
use fixed::FixedI32;

/// Shortening a vector.
pub trait Shortening: Magnitudes {
    /// Forces stay this far within their limits, N, so that the rounding of two steps exceeds none.
    const ROUNDING_N: f32;

    /// The square of a length.
    fn square_of<F: Point>(length: Self::Scalar<F>) -> Self::Square;

    /// Returns true if a square is a number of a plausible size.
    fn is_sane(square: Self::Square) -> bool;

    /// `reach` over the root of `square`, which is no smaller.
    fn over_root<F: Point>(
        reach: Self::Scalar<F>,
        square: Self::Square,
    ) -> Self::Scalar<<Fraction as Unit>::Point>;
}

impl Shortening for Float {
    const ROUNDING_N: f32 = 0.0;

    #[inline(always)]
    fn square_of<F: Point>(length: f32) -> f32 {
        length * length
    }

    #[inline(always)]
    fn is_sane(square: f32) -> bool {
        /// Lengths beyond this are errors.
        const SANE: f32 = 1e15;
        square <= SANE * SANE
    }

    #[inline(always)]
    fn over_root<F: Point>(reach: f32, square: f32) -> f32 {
        reach / sqrt(square)
    }
}

impl Shortening for Fixed {
    const ROUNDING_N: f32 = 4.0e-5;

    #[inline(always)]
    fn square_of<F: Point>(length: FixedI32<F>) -> u64 {
        wide(length, length) as u64
    }

    #[inline(always)]
    fn is_sane(_: u64) -> bool {
        true
    }

    #[inline(always)]
    fn over_root<F: Point>(reach: FixedI32<F>, square: u64) -> FixedI32<<Fraction as Unit>::Point> {
        // The length itself is not needed: the caller knows that it is no shorter than the reach.
        Self::magnitude(square).under(reach).min(FixedI32::ONE)
    }
}

/// The limits of a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limiter<A: Shortening = Float> {
    peak: Bound<A>,
    step: Bound<A>,
}

/// A limit: the length to shorten to, which rounding does not exceed, and the square of the limit.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Bound<A: Shortening> {
    longest: Quantity<A, Newton>,
    square: A::Square,
}

impl<A: Shortening> Bound<A> {
    fn new(longest_n: f32) -> Self {
        /// Keeps rounding from exceeding a limit.
        const MARGIN: f32 = 1.0 - 2e-6;
        let longest_n = longest_n - A::ROUNDING_N;
        Self {
            longest: Quantity::of(longest_n * MARGIN),
            square: A::square_of(Quantity::<A, Newton>::of(longest_n).0),
        }
    }

    /// Shortens a vector to the bound, with the flag `longer` where it was longer. A vector that is
    /// not finite becomes zero.
    #[inline(always)]
    fn shorten(&self, v: Vector<A, Newton>, longer: Flags) -> (Vector<A, Newton>, Flags) {
        let square = v.square();
        if square <= self.square {
            (v, Flags::NONE)
        } else if A::is_sane(square) {
            let shrink = Quantity::<A, Fraction>(A::over_root(self.longest.0, square));
            ((v * shrink).settled(), longer)
        } else {
            (Vector::ZERO, Flags::NONE)
        }
    }
}

impl<A: Shortening> Limiter<A> {
    /// The limiter of a device at a servo rate.
    #[must_use]
    pub fn new(limits: &Limits, servo_rate_hz: f32) -> Self {
        Self {
            peak: Bound::new(limits.peak_n),
            step: Bound::new(limits.slew_n_s / servo_rate_hz),
        }
    }

    /// Goes from `last` towards `wanted`, both N. Anything that is not finite counts as no force.
    /// [`Flags::PEAK_LIMITED`] and [`Flags::SLEW_LIMITED`] tell what was cut.
    #[inline(always)]
    #[must_use]
    pub fn step(
        &self,
        last: Vector<A, Newton>,
        wanted: Vector<A, Newton>,
    ) -> (Vector<A, Newton>, Flags) {
        let (target, peak) = self.peak.shorten(wanted, Flags::PEAK_LIMITED);
        let way = target - last;
        if way.square() <= self.step.square {
            return (target, peak);
        }
        let (step, slew) = self.step.shorten(way, Flags::SLEW_LIMITED);
        // Both ends are within the peak, so every point between them is, up to rounding.
        let next = last + step;
        let next = if A::ROUNDING_N > 0.0 {
            self.peak.shorten(next, Flags::NONE).0
        } else {
            next
        };
        (next, peak.union(slew))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{config::Config, math::norm};

    #[test]
    fn a_spike_is_cut_in_peak_and_slew_and_a_nan_is_no_force() {
        let limiter = Limiter::<Float>::new(&Config::default().limits, 1000.0);
        let step = |last: [f32; 3], wanted: [f32; 3]| {
            let (next, limited) = limiter.step(Vector::of(last), Vector::of(wanted));
            (next.values(), limited)
        };
        let (a, limited) = step([0.0; 3], [0.0, 0.0, 100.0]);
        assert!(limited.contains(Flags::PEAK_LIMITED) && limited.contains(Flags::SLEW_LIMITED));
        assert!(norm(a) <= 2.0 && norm(a) > 1.999);
        let (b, _) = step(a, [0.0, 0.0, 100.0]);
        assert!(norm(b) <= 3.3 && norm(b) > 3.299);
        let (c, _) = step(b, [f32::NAN, 0.0, f32::INFINITY]);
        assert!(norm(c) < 1.301);
    }
}

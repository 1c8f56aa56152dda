//! Peak and slew of the total force.

use crate::{
    Flags,
    arithmetic::{
        Arithmetic, Float, Four, Number,
        units::{Newton, Unit},
    },
};

/// The limits a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limiter<A: Arithmetic = Float> {
    peak_n: Bound<A>,
    step_n: Bound<A>,
}

/// A length that rounding does not exceed, and the square of the length.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Bound<A: Arithmetic> {
    longest: Number<A, Newton>,
    square: A::Square,
}

impl<A: Arithmetic> Bound<A> {
    fn new(longest: f32) -> Self {
        let longest = longest - A::ROUNDING_N;
        Self {
            longest: Number::of(longest * MARGIN),
            square: A::square_of::<Newton>(Number::<A, Newton>::of(longest).0),
        }
    }
}

/// Keeps rounding from exceeding a limit.
const MARGIN: f32 = 1.0 - 2e-6;

impl<A: Arithmetic> Limiter<A> {
    /// Limits of a device at a servo rate.
    #[must_use]
    pub fn new(limits: &crate::Limits, servo_rate_hz: f32) -> Self {
        Self {
            peak_n: Bound::new(limits.peak_n),
            step_n: Bound::new(limits.slew_n_s / servo_rate_hz),
        }
    }

    /// From `last` towards `wanted`, both N. Vectors are shortened, not turned.
    /// Anything that is not finite counts as no force. Tells with
    /// [`Flags::PEAK_LIMITED`] and [`Flags::SLEW_LIMITED`] what was cut.
    #[inline]
    #[must_use]
    pub fn step(
        &self,
        last: [A::Scalar<Newton>; 3],
        wanted: [A::Scalar<Newton>; 3],
    ) -> ([A::Scalar<Newton>; 3], Flags) {
        let (next, limited) = self.advance(Four::vec3(last), Four::vec3(wanted));
        (next.xyz(), limited)
    }

    /// [`Limiter::step`] on lanes; the fourth ones are zero.
    #[inline(always)]
    pub(crate) fn advance(
        &self,
        last: Four<A, Newton>,
        wanted: Four<A, Newton>,
    ) -> (Four<A, Newton>, Flags) {
        let (target, peak) = shorten(wanted, &self.peak_n, Flags::PEAK_LIMITED);
        let way = target - last;
        if way.square() <= self.step_n.square {
            return (target, peak);
        }
        let (step, slew) = shorten(way, &self.step_n, Flags::SLEW_LIMITED);
        // Both ends lie in the ball of the peak, so does what lies between, up to rounding.
        let next = last + step;
        let next = if A::ROUNDING_N > 0.0 {
            shorten(next, &self.peak_n, Flags::NONE).0
        } else {
            next
        };
        (next, peak.and(slew))
    }
}

/// A vector no longer than a bound, and a flag where it was longer; none for an error.
#[inline(always)]
fn shorten<A: Arithmetic>(
    v: Four<A, Newton>,
    bound: &Bound<A>,
    longer: Flags,
) -> (Four<A, Newton>, Flags) {
    let square = v.square();
    if square <= bound.square {
        (v, Flags::NONE)
    } else if A::is_sane(square) {
        let shrink = Number::<A, Unit>(A::over_root(bound.longest.0, square));
        (v.scaled(shrink), longer)
    } else {
        (Four::ZERO, Flags::NONE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::norm;

    #[test]
    fn a_spike_is_cut_in_peak_and_slew_and_a_nan_is_no_force() {
        let limiter = Limiter::<Float>::new(&crate::Config::default().limits, 1000.0);
        let (a, limited) = limiter.step([0.0; 3], [0.0, 0.0, 100.0]);
        assert!(limited.contains(Flags::PEAK_LIMITED) && limited.contains(Flags::SLEW_LIMITED));
        assert!(norm(a) <= 2.0 && norm(a) > 1.999);
        let (b, _) = limiter.step(a, [0.0, 0.0, 100.0]);
        assert!(norm(b) <= 3.3 && norm(b) > 3.299);
        let (c, _) = limiter.step(b, [f32::NAN, 0.0, f32::INFINITY]);
        assert!(norm(c) < 1.301);
    }
}

//! Peak and slew of the total force.

use crate::{
    Flags,
    lanes::F4,
    math::{Vec3, min, rsqrt},
};

/// The limits a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limiter {
    peak_n: Bound,
    step_n: Bound,
}

/// A length, and its square.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Bound {
    longest: f32,
    squared: f32,
}

impl Bound {
    const fn new(longest: f32) -> Self {
        Self {
            longest,
            squared: longest * longest,
        }
    }
}

/// Forces beyond this are errors, not forces, N.
const SANE_N: f32 = 1e15;
/// Keeps rounding of the approximated root from exceeding a limit.
const MARGIN: f32 = 1.0 - 2e-6;

impl Limiter {
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
    pub fn step(&self, last: Vec3, wanted: Vec3) -> (Vec3, Flags) {
        let (next, limited) = self.advance(F4::vec3(last), F4::vec3(wanted));
        (next.xyz(), limited)
    }

    /// [`Limiter::step`] on lanes; the fourth ones are zero.
    #[inline(always)]
    pub(crate) fn advance(&self, last: F4, wanted: F4) -> (F4, Flags) {
        let (target, peak) = shorten(wanted, &self.peak_n, Flags::PEAK_LIMITED);
        let (step, slew) = shorten(target - last, &self.step_n, Flags::SLEW_LIMITED);
        // Both ends lie in the ball of the peak, so does what lies between.
        (last + step, peak.and(slew))
    }
}

/// A vector no longer than a bound, and a flag where it was longer; none for an error.
#[inline(always)]
fn shorten(v: F4, bound: &Bound, longer: Flags) -> (F4, Flags) {
    let squared = v.dot3(v);
    if squared <= bound.squared {
        (v, Flags::NONE)
    } else if squared <= SANE_N * SANE_N {
        let shrink = min(bound.longest * MARGIN * rsqrt(squared), 1.0);
        (v * F4::splat(shrink), longer)
    } else {
        (F4::ZERO, Flags::NONE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::norm;

    #[test]
    fn a_spike_is_cut_in_peak_and_slew_and_a_nan_is_no_force() {
        let limiter = Limiter::new(&crate::Config::default().limits, 1000.0);
        let (a, limited) = limiter.step([0.0; 3], [0.0, 0.0, 100.0]);
        assert!(limited.contains(Flags::PEAK_LIMITED) && limited.contains(Flags::SLEW_LIMITED));
        assert!(norm(a) <= 2.0 && norm(a) > 1.999);
        let (b, _) = limiter.step(a, [0.0, 0.0, 100.0]);
        assert!(norm(b) <= 3.3 && norm(b) > 3.299);
        let (c, _) = limiter.step(b, [f32::NAN, 0.0, f32::INFINITY]);
        assert!(norm(c) < 1.301);
    }
}

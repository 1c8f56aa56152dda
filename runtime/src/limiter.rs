//! Peak and slew of the total force.

use crate::{
    lanes::F4,
    math::{Vec3, min, rsqrt},
};

/// The limits a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limiter {
    peak_n: f32,
    step_n: f32,
}

/// What the limiter had to do.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Limited {
    /// The wanted force was above the peak.
    pub peak: bool,
    /// The step to it was above the slew limit.
    pub slew: bool,
}

/// Forces beyond this are errors, not forces, N: their squares are not finite.
const SANE_N: f32 = 1e15;
/// Keeps rounding of the approximated root from exceeding a limit.
const MARGIN: f32 = 1.0 - 2e-6;

impl Limiter {
    /// Limits of a device at a servo rate.
    #[must_use]
    pub fn new(limits: &crate::Limits, servo_rate_hz: f32) -> Self {
        Self {
            peak_n: limits.peak_n,
            step_n: limits.slew_n_s / servo_rate_hz,
        }
    }

    /// From `last` towards `wanted`, both N. Vectors are shortened, not turned.
    /// Anything that is not finite counts as no force.
    #[inline]
    #[must_use]
    pub fn step(&self, last: Vec3, wanted: Vec3) -> (Vec3, Limited) {
        let (next, limited) = self.advance(F4::vec3(last), F4::vec3(wanted));
        (next.xyz(), limited)
    }

    /// [`Limiter::step`] on lanes; the fourth ones are zero.
    #[inline(always)]
    pub(crate) fn advance(&self, last: F4, wanted: F4) -> (F4, Limited) {
        let wanted = if wanted.is_within(SANE_N) {
            wanted
        } else {
            F4::ZERO
        };
        let (target, peak) = shorten(wanted, self.peak_n);
        let (step, slew) = shorten(target - last, self.step_n);
        // Both ends lie in the ball of the peak, so does what lies between.
        (last + step, Limited { peak, slew })
    }
}

/// A vector at most `longest` long, and whether it was longer.
#[inline(always)]
fn shorten(v: F4, longest: f32) -> (F4, bool) {
    let squared = v.dot3(v);
    if squared > longest * longest {
        let shrink = min(longest * MARGIN * rsqrt(squared), 1.0);
        (v * F4::splat(shrink), true)
    } else {
        (v, false)
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
        assert!(limited.peak && limited.slew);
        assert!(norm(a) <= 2.0 && norm(a) > 1.999);
        let (b, _) = limiter.step(a, [0.0, 0.0, 100.0]);
        assert!(norm(b) <= 3.3 && norm(b) > 3.299);
        let (c, _) = limiter.step(b, [f32::NAN, 0.0, f32::INFINITY]);
        assert!(norm(c) < 1.301);
    }
}

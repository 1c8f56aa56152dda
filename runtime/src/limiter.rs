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
        let (last, wanted) = (F4::vec3(last), F4::vec3(wanted));
        let wanted = if wanted.is_within(SANE_N) {
            wanted
        } else {
            F4::splat(0.0)
        };
        let squared = wanted.dot3(wanted);
        let peak = squared > self.peak_n * self.peak_n;
        let shrink = min(self.peak_n * MARGIN * rsqrt(squared), 1.0);
        let target = wanted * F4::splat(if peak { shrink } else { 1.0 });
        let step = target - last;
        let squared = step.dot3(step);
        let slew = squared > self.step_n * self.step_n;
        let shrink = min(self.step_n * MARGIN * rsqrt(squared), 1.0);
        // Both ends lie in the ball of the peak, so does what lies between.
        let next = (last + step * F4::splat(if slew { shrink } else { 1.0 })).xyz();
        (next, Limited { peak, slew })
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

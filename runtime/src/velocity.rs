//! Velocity from positions: backward difference and second-order low-pass.

use crate::math::{Vec3, cos_pi, sin_pi};

/// Butterworth low-pass of second order by the bilinear transform, in transposed
/// direct form II:
///
/// `y = b0·x + s1`, `s1 = 2·b0·x − a1·y + s2`, `s2 = b0·x − a2·y`, with b1 = 2·b0 and
/// b2 = b0. Unit gain at DC; delay at low frequency √2/(2π f_c).
#[derive(Debug, Clone, Copy)]
pub struct LowPass2 {
    b0: f32,
    a1: f32,
    a2: f32,
}

/// State of one channel of a [`LowPass2`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LowPass2State {
    s1: f32,
    s2: f32,
}

impl LowPass2 {
    /// A filter with cut-off `cutoff_hz` (−3 dB) at `rate_hz`; 0 < cut-off < rate/2.
    #[must_use]
    pub fn new(cutoff_hz: f32, rate_hz: f32) -> Self {
        let x = cutoff_hz / rate_hz;
        let k = sin_pi(x) / cos_pi(x);
        let norm = 1.0 / (1.0 + core::f32::consts::SQRT_2 * k + k * k);
        Self {
            b0: k * k * norm,
            a1: 2.0 * (k * k - 1.0) * norm,
            a2: (1.0 - core::f32::consts::SQRT_2 * k + k * k) * norm,
        }
    }

    /// One step.
    #[inline]
    pub fn step(&self, state: &mut LowPass2State, x: f32) -> f32 {
        let bx = self.b0 * x;
        let y = bx + state.s1;
        state.s1 = 2.0 * bx - self.a1 * y + state.s2;
        state.s2 = bx - self.a2 * y;
        y
    }

    /// One step of three channels.
    #[inline]
    pub fn step3(&self, states: &mut [LowPass2State; 3], x: Vec3) -> Vec3 {
        let [sx, sy, sz] = states;
        [
            self.step(sx, x[0]),
            self.step(sy, x[1]),
            self.step(sz, x[2]),
        ]
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    #[test]
    fn a_ramp_is_followed_with_the_stated_delay() {
        let (rate_hz, cutoff_hz) = (1000.0, 20.0);
        let filter = LowPass2::new(cutoff_hz, rate_hz);
        let mut state = LowPass2State::default();
        let mut y = 0.0;
        for n in 0..1000 {
            y = filter.step(&mut state, n as f32);
        }
        let delay_s = (999.0 - y) / rate_hz;
        let stated_s = core::f32::consts::SQRT_2 / (core::f32::consts::TAU * cutoff_hz);
        assert!((delay_s - stated_s).abs() < 1e-4, "{delay_s} {stated_s}");
    }
}

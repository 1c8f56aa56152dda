//! Velocity from positions: backward difference and second-order low-pass.

use crate::{
    arithmetic::{
        Arithmetic, Float, Four,
        units::{MetrePerSecond, Unit},
    },
    math::{cos_pi, sin_pi},
};

/// Channels filtered side by side: the three of a velocity, and the normal one.
pub const CHANNELS: usize = 4;

/// Butterworth low-passes of second order by the bilinear transform, in transposed
/// direct form II, each channel with a cut-off of its own:
///
/// `y = b0·x + s1`, `s1 = 2·b0·x − a1·y + s2`, `s2 = b0·x − a2·y`, with b1 = 2·b0 and
/// b2 = b0. Unit gain at DC; delay at low frequency √2/(2π f_c).
#[derive(Debug, Clone, Copy)]
pub struct LowPass2<A: Arithmetic = Float> {
    b0: Four<A, Unit>,
    a1: Four<A, Unit>,
    a2: Four<A, Unit>,
}

/// State of a [`LowPass2`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LowPass2State<A: Arithmetic = Float> {
    s1: Four<A, MetrePerSecond>,
    s2: Four<A, MetrePerSecond>,
}

impl<A: Arithmetic> LowPass2State<A> {
    /// At rest.
    pub const REST: Self = Self {
        s1: Four::ZERO,
        s2: Four::ZERO,
    };
}

impl<A: Arithmetic> LowPass2<A> {
    /// Filters with cut-offs `cutoffs_hz` (−3 dB) at `rate_hz`; 0 < cut-off < rate/2.
    #[must_use]
    pub fn new(cutoffs_hz: [f32; CHANNELS], rate_hz: f32) -> Self {
        let k = cutoffs_hz.map(|cutoff_hz| {
            let x = cutoff_hz / rate_hz;
            sin_pi(x) / cos_pi(x)
        });
        let norm = |k: f32| 1.0 / (1.0 + core::f32::consts::SQRT_2 * k + k * k);
        Self {
            b0: Four::of(k.map(|k| k * k * norm(k))),
            a1: Four::of(k.map(|k| 2.0 * (k * k - 1.0) * norm(k))),
            a2: Four::of(k.map(|k| (1.0 - core::f32::consts::SQRT_2 * k + k * k) * norm(k))),
        }
    }

    /// One step of every channel.
    #[inline]
    pub fn step(
        &self,
        state: &mut LowPass2State<A>,
        x: [A::Scalar<MetrePerSecond>; CHANNELS],
    ) -> [A::Scalar<MetrePerSecond>; CHANNELS] {
        self.advance(state, Four::load(&x)).to_array()
    }

    /// [`LowPass2::step`] on lanes.
    #[inline(always)]
    pub(crate) fn advance(
        &self,
        state: &mut LowPass2State<A>,
        x: Four<A, MetrePerSecond>,
    ) -> Four<A, MetrePerSecond> {
        let bx = self.b0.times(x);
        let y = bx + state.s1;
        state.s1 = bx + bx - self.a1.times(y) + state.s2;
        state.s2 = bx - self.a2.times(y);
        y
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    #[test]
    fn a_ramp_is_followed_with_the_stated_delay() {
        let rate_hz = 1000.0;
        let cutoffs_hz = [20.0, 5.0, 40.0, 100.0];
        let filter = LowPass2::<Float>::new(cutoffs_hz, rate_hz);
        let mut state = LowPass2State::REST;
        let mut y = [0.0; CHANNELS];
        for n in 0..2000 {
            y = filter.step(&mut state, [n as f32; CHANNELS]);
        }
        for (y, cutoff_hz) in y.into_iter().zip(cutoffs_hz) {
            let delay_s = (1999.0 - y) / rate_hz;
            let stated_s = core::f32::consts::SQRT_2 / (core::f32::consts::TAU * cutoff_hz);
            assert!((delay_s - stated_s).abs() < 2e-4, "{delay_s} {stated_s}");
        }
    }
}

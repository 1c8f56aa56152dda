//! Velocity from motion: backward difference and second-order low-pass.

use crate::{
    arithmetic::{
        Arithmetic, Float, Four,
        units::{FASTEST_M_S, Hertz, Metre, MetrePerSecond, Unit},
    },
    math::{cos_pi, sin_pi},
};

/// Channels side by side: the three of a velocity, and the normal one.
pub const CHANNELS: usize = 4;

/// Butterworth low-passes of second order by the bilinear transform, in transposed
/// direct form II, each channel with a cut-off of its own. For a motion Δ over n periods
///
/// `u = b0·Δ·rate/n`, `v = u + s1`, `s1 = 2u − a1·v + s2`, `s2 = u − a2·v`,
///
/// since b1 = 2·b0 and b2 = b0. Unit gain at DC; delay at low frequency √2/(2π f_c).
#[derive(Debug, Clone, Copy)]
pub struct VelocityEstimator<A: Arithmetic = Float> {
    /// b0 periods per second over 0 (never), 1, 2 and 3 elapsed ones.
    gains_hz: [Four<A, Hertz>; 4],
    /// The largest u, m/s, where numbers have a range.
    largest_m_s: Four<A, MetrePerSecond>,
    a1: Four<A, Unit>,
    a2: Four<A, Unit>,
}

/// State of a [`VelocityEstimator`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VelocityState<A: Arithmetic = Float> {
    s1: Four<A, MetrePerSecond>,
    s2: Four<A, MetrePerSecond>,
}

impl<A: Arithmetic> VelocityState<A> {
    /// At rest.
    pub const REST: Self = Self {
        s1: Four::ZERO,
        s2: Four::ZERO,
    };
}

impl<A: Arithmetic> VelocityEstimator<A> {
    /// Filters with cut-offs `cutoffs_hz` (−3 dB) at `rate_hz`; 0 < cut-off < rate/2.
    #[must_use]
    pub fn new(cutoffs_hz: [f32; CHANNELS], rate_hz: f32) -> Self {
        let k = cutoffs_hz.map(|cutoff_hz| {
            let x = cutoff_hz / rate_hz;
            sin_pi(x) / cos_pi(x)
        });
        let norm = |k: f32| 1.0 / (1.0 + core::f32::consts::SQRT_2 * k + k * k);
        let b0 = k.map(|k| k * k * norm(k));
        let rates_hz = [rate_hz, rate_hz, rate_hz / 2.0, rate_hz / 3.0];
        Self {
            gains_hz: rates_hz.map(|rate_hz| Four::of(b0.map(|b0| b0 * rate_hz))),
            largest_m_s: Four::of(b0.map(|b0| b0 * FASTEST_M_S)),
            a1: Four::of(k.map(|k| 2.0 * (k * k - 1.0) * norm(k))),
            a2: Four::of(k.map(|k| (1.0 - core::f32::consts::SQRT_2 * k + k * k) * norm(k))),
        }
    }

    /// One step of every channel: velocities, m/s, after motions over `elapsed_ticks` (1 to 3)
    /// periods, m.
    #[inline]
    pub fn step(
        &self,
        state: &mut VelocityState<A>,
        motion_m: [A::Scalar<Metre>; CHANNELS],
        elapsed_ticks: u32,
    ) -> [A::Scalar<MetrePerSecond>; CHANNELS] {
        let motion_m = Four::load(&motion_m);
        self.advance(state, motion_m, elapsed_ticks).to_array()
    }

    /// [`VelocityEstimator::step`] on lanes.
    #[inline(always)]
    pub(crate) fn advance(
        &self,
        state: &mut VelocityState<A>,
        motion_m: Four<A, Metre>,
        elapsed_ticks: u32,
    ) -> Four<A, MetrePerSecond> {
        let gain_hz = self.gains_hz[elapsed_ticks as usize % 4];
        let u = motion_m.times_within(gain_hz, self.largest_m_s);
        let v = u + state.s1;
        state.s1 = u + u - self.a1.times(v) + state.s2;
        state.s2 = u - self.a2.times(v);
        v
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
        let filter = VelocityEstimator::<Float>::new(cutoffs_hz, rate_hz);
        let mut state = VelocityState::REST;
        let mut y = [0.0; CHANNELS];
        for n in 0..2000 {
            y = filter.step(&mut state, [n as f32 / rate_hz; CHANNELS], 1);
        }
        for (y, cutoff_hz) in y.into_iter().zip(cutoffs_hz) {
            let delay_s = (1999.0 - y) / rate_hz;
            let stated_s = core::f32::consts::SQRT_2 / (core::f32::consts::TAU * cutoff_hz);
            assert!((delay_s - stated_s).abs() < 2e-4, "{delay_s} {stated_s}");
        }
    }
}

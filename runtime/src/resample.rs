//! Tap traces from their source rate to the servo rate, once, at load.
//!
//! Every source sample is an impulse of a·T_source into a continuous-time low-pass,
//! whose output is sampled at the servo period. The low-pass is a Chebyshev type II
//! of order 7, 50 dB down from half the lower of the two rates upwards; with the images of
//! the source's own rate, aliases stay more than 40 dB down; −3 dB at 0.69 of that; delay 1.51 ms at 1 kHz. It is
//! causal, so nothing precedes the impact. What truncation and the stop band leave
//! of ∫a dt is given back along the filter's own response, so the impulse is exact
//! within rounding.

use crate::math::{cos_pi, exp, sin_pi};

/// Poles with Im ≥ 0 (rad per rad/s of stop edge) and residues of the prototype
/// with unit gain at DC: `scipy.signal.cheb2ap(7, 50)`, `scipy.signal.residue`.
const POLES: [(Complex, Complex); 4] = [
    (
        Complex::new(-0.113_746_65, 0.685_925_7),
        Complex::new(0.126_536_16, 0.110_951_51),
    ),
    (
        Complex::new(-0.381_229_6, 0.657_971_74),
        Complex::new(-0.526_114_17, 0.538_351_86),
    ),
    (
        Complex::new(-0.729_280_8, 0.483_387_32),
        Complex::new(-0.969_563_66, -1.664_926),
    ),
    (
        Complex::new(-0.945_731_9, 0.0),
        Complex::new(2.760_419_4, 0.0),
    ),
];

/// Ticks behind the last source sample, for the filter's response to fade below
/// 1 % of its peak.
pub(crate) const TAIL_TICKS: usize = 16;

#[derive(Debug, Clone, Copy)]
struct Complex {
    re: f32,
    im: f32,
}

impl Complex {
    const fn new(re: f32, im: f32) -> Self {
        Self { re, im }
    }

    fn times(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }

    fn plus(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }

    /// e^(self·x) for Re ≤ 0 and |Im·x| ≤ π.
    fn exp(self, x: f32) -> Self {
        let magnitude = exp(crate::math::max(self.re * x, -80.0));
        let half_turns = crate::math::min(self.im * x * core::f32::consts::FRAC_1_PI, 1.0);
        Self::new(
            magnitude * cos_pi(half_turns),
            magnitude * sin_pi(half_turns),
        )
    }
}

/// A conversion from `source_hz` to `servo_hz`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Resampler {
    source_hz: f64,
    servo_hz: f64,
    stop_rad_s: f32,
}

impl Resampler {
    pub(crate) fn new(source_hz: f32, servo_hz: f32) -> Self {
        let lower = if source_hz < servo_hz {
            source_hz
        } else {
            servo_hz
        };
        Self {
            source_hz: f64::from(source_hz),
            servo_hz: f64::from(servo_hz),
            stop_rad_s: core::f32::consts::PI * lower,
        }
    }

    fn is_identity(&self) -> bool {
        self.source_hz == self.servo_hz
    }

    /// Ticks that `samples` source samples become.
    pub(crate) fn ticks(&self, samples: usize) -> usize {
        if self.is_identity() || samples == 0 {
            return samples;
        }
        let span = (samples - 1) as f64 * self.servo_hz / self.source_hz;
        // The tail is counted in periods of the lower rate.
        let stretch = if self.source_hz < self.servo_hz {
            self.servo_hz / self.source_hz
        } else {
            1.0
        };
        (span + TAIL_TICKS as f64 * stretch) as usize + 1
    }

    /// Converts a trace into `out`, whose length is [`Resampler::ticks`].
    pub(crate) fn convert(
        &self,
        trace: impl ExactSizeIterator<Item = f32> + Clone,
        out: &mut [f32],
    ) {
        if self.is_identity() {
            for (out, a) in out.iter_mut().zip(trace) {
                *out = a;
            }
            return;
        }
        let wanted = trace.clone().fold(0.0, |sum, a| sum + f64::from(a)) / self.source_hz;
        self.filter(trace, out);
        let given = out.iter().fold(0.0, |sum, &a| sum + f64::from(a)) / self.servo_hz;
        self.give_back(((wanted - given) * self.servo_hz) as f32, out);
    }

    /// y(nT) = Σ_i T_source·x_i·h(nT − iT_source), by one complex state a pole, which
    /// moves from source sample to source sample; silence follows the last one.
    fn filter(&self, trace: impl Iterator<Item = f32>, out: &mut [f32]) {
        /// A sample this close to a tick belongs to it, s.
        const ROUNDING_S: f64 = 1e-9;
        let period_s = 1.0 / self.source_hz;
        let gain = period_s as f32 * self.stop_rad_s;
        let step = POLES.map(|(pole, _)| pole.exp(self.stop_rad_s * period_s as f32));
        let mut state = [Complex::new(0.0, 0.0); POLES.len()];
        let mut samples = trace.chain(core::iter::repeat(0.0));
        let mut next_s = 0.0;
        let mut taken = 0_u32;
        for (n, out) in out.iter_mut().enumerate() {
            let now_s = n as f64 / self.servo_hz;
            while next_s <= now_s + ROUNDING_S {
                let a = samples.next().unwrap_or_default();
                for (state, step) in state.iter_mut().zip(&step) {
                    *state = state.times(*step).plus(Complex::new(a, 0.0));
                }
                taken += 1;
                next_s = f64::from(taken) * period_s;
            }
            let age_s = now_s - (next_s - period_s);
            let mut y = 0.0;
            for (state, (pole, residue)) in state.iter().zip(&POLES) {
                let now = if age_s > ROUNDING_S {
                    state.times(pole.exp(age_s as f32 * self.stop_rad_s))
                } else {
                    *state
                };
                // A pole with Im > 0 stands for itself and its conjugate.
                let multiplicity = if pole.im > 0.0 { 2.0 } else { 1.0 };
                y += multiplicity * now.times(*residue).re;
            }
            *out = gain * y;
        }
    }

    /// Adds `sum` over all ticks in the shape of the response to one impulse.
    fn give_back(&self, sum: f32, out: &mut [f32]) {
        let ticks = out.len();
        let tick_s = (1.0 / self.servo_hz) as f32;
        // Two passes over a recursion instead of a buffer: first its sum, then it.
        let response = || {
            let mut state = POLES.map(|(_, residue)| residue);
            let decay = POLES.map(|(pole, _)| pole.exp(self.stop_rad_s * tick_s));
            (0..ticks).map(move |_| {
                let mut h = 0.0;
                for (state, ((pole, _), decay)) in state.iter_mut().zip(POLES.iter().zip(&decay)) {
                    h += if pole.im > 0.0 { 2.0 } else { 1.0 } * state.re;
                    *state = state.times(*decay);
                }
                h
            })
        };
        let total: f32 = response().sum();
        let share = if total != 0.0 { sum / total } else { 0.0 };
        for (out, h) in out.iter_mut().zip(response()) {
            *out += share * h;
        }
    }
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests run on the host")]
mod tests {
    extern crate std;
    use super::*;
    use std::vec::Vec;

    fn convert(trace: &[f32], source_hz: f32, servo_hz: f32) -> Vec<f32> {
        let resampler = Resampler::new(source_hz, servo_hz);
        let mut out = std::vec![0.0; resampler.ticks(trace.len())];
        resampler.convert(trace.iter().copied(), &mut out);
        out
    }

    /// Amplitude of a long tone after conversion, in dB re its own.
    fn tone_db(frequency_hz: f32, source_hz: f32, servo_hz: f32) -> f32 {
        let trace: Vec<f32> = (0..1000)
            .map(|i| (core::f32::consts::TAU * frequency_hz * i as f32 / source_hz).sin())
            .collect();
        let out = convert(&trace, source_hz, servo_hz);
        let middle = &out[out.len() / 3..out.len() * 2 / 3];
        let power = middle.iter().map(|y| y * y).sum::<f32>() / middle.len() as f32;
        10.0 * (2.0 * power).log10()
    }

    #[test]
    fn tones_above_half_the_servo_rate_do_not_alias() {
        for frequency_hz in [530.0, 700.0, 1100.0, 2300.0, 4100.0] {
            let db = tone_db(frequency_hz, 10_000.0, 1000.0);
            assert!(db < -40.0, "{frequency_hz}: {db}");
        }
        for frequency_hz in [40.0, 120.0, 200.0] {
            assert!(
                tone_db(frequency_hz, 10_000.0, 1000.0).abs() < 0.5,
                "{frequency_hz}"
            );
        }
        assert!(tone_db(130.0, 1000.0, 10_000.0).abs() < 0.5);
    }

    #[test]
    fn the_impulse_is_kept() {
        for (source_hz, servo_hz, samples) in [
            (10_000.0, 1000.0, 100),
            (10_000.0, 1000.0, 7),
            (10_000.0, 5000.0, 100),
            (44_100.0, 1000.0, 900),
            (1000.0, 10_000.0, 30),
            (8000.0, 3000.0, 64),
            (1000.0, 1000.0, 5),
        ] {
            let trace: Vec<f32> = (0..samples)
                .map(|i| 300.0 * (-0.04 * i as f32).exp() * (0.2 * i as f32).sin())
                .collect();
            let before: f64 =
                trace.iter().map(|&a| f64::from(a)).sum::<f64>() / f64::from(source_hz);
            let out = convert(&trace, source_hz, servo_hz);
            let after: f64 = out.iter().map(|&a| f64::from(a)).sum::<f64>() / f64::from(servo_hz);
            assert!(
                (after / before - 1.0).abs() < 1e-4,
                "{source_hz} {servo_hz}: {before} {after}"
            );
        }
    }

    #[test]
    fn the_delay_is_below_two_milliseconds() {
        let mut trace = std::vec![0.0_f32; 40];
        trace[0] = 1.0;
        let out = convert(&trace, 10_000.0, 1000.0);
        let sum: f32 = out.iter().sum();
        let centroid: f32 = out
            .iter()
            .enumerate()
            .map(|(n, a)| n as f32 * a)
            .sum::<f32>()
            / sum;
        assert!((1.0..2.0).contains(&centroid), "{centroid}");
    }
}

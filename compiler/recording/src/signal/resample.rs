//! From the clock of a channel to another one: band-limited interpolation.

use super::kaiser::{sinc, window};

/// Zero crossings of the interpolating sinc on each side.
const CROSSINGS: usize = 32;
/// Points of the kernel's table between two zero crossings; between them it is linear.
const TABLE_STEP: usize = 64;

/// When the samples of a uniform channel were taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Time of the first sample, s.
    pub start_s: f64,
    /// Samples a second.
    pub rate_hz: f64,
}

impl Clock {
    /// Time of a sample, s.
    #[must_use]
    pub fn time_s(&self, sample: f64) -> f64 {
        self.start_s + sample / self.rate_hz
    }

    /// The sample at a time, with its fraction.
    #[must_use]
    pub fn sample(&self, time_s: f64) -> f64 {
        (time_s - self.start_s) * self.rate_hz
    }
}

/// The signal at the `count` instants of another clock.
///
/// What lies above half the lower of the two rates is removed; the transition begins at 0.46 of
/// that rate. At the ends the signal goes on at its last value.
#[must_use]
pub fn resample(signal: &[f32], from: Clock, to: Clock, count: usize) -> Vec<f64> {
    if signal.is_empty() {
        return vec![0.0; count];
    }
    // Cut-off as a fraction of the channel's own half rate.
    let scale = (to.rate_hz / from.rate_hz).min(1.0);
    let reach = CROSSINGS as f64 / scale;
    let table: Vec<f64> = (0..=CROSSINGS * TABLE_STEP + 1)
        .map(|n| {
            let x = n as f64 / TABLE_STEP as f64;
            sinc(x) * window(x / CROSSINGS as f64)
        })
        .collect();
    let last = signal.len() as i64 - 1;
    (0..count)
        .map(|n| {
            let centre = from.sample(to.time_s(n as f64));
            let (first, end) = (
                (centre - reach).ceil() as i64,
                (centre + reach).floor() as i64,
            );
            let (mut sum, mut weight) = (0.0, 0.0);
            for k in first..=end {
                let place = (k as f64 - centre).abs() * scale * TABLE_STEP as f64;
                let below = place as usize;
                let share = place - below as f64;
                let Some(pair) = table.get(below..below + 2) else {
                    continue;
                };
                let w = pair[0] + share * (pair[1] - pair[0]);
                sum += w * f64::from(signal[k.clamp(0, last) as usize]);
                weight += w;
            }
            sum / weight
        })
        .collect()
}

#[cfg(test)]
#[path = "resample_tests.rs"]
mod laws;

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_tone_keeps_its_phase_through_rates_delays_and_drift() {
        let from = Clock {
            start_s: 0.0123,
            rate_hz: 6403.0,
        };
        let to = Clock {
            start_s: 0.1,
            rate_hz: 1000.0,
        };
        for freq_hz in [3.0, 120.0, 440.0] {
            let signal: Vec<f32> = (0..6403)
                .map(|n| libm::sin(TAU * freq_hz * from.time_s(f64::from(n))) as f32)
                .collect();
            for (n, found) in resample(&signal, from, to, 700).into_iter().enumerate() {
                let expected = libm::sin(TAU * freq_hz * to.time_s(n as f64));
                assert!(
                    (found - expected).abs() < 3e-3,
                    "{freq_hz} Hz: {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn what_would_alias_is_removed() {
        let (from, to) = (
            Clock {
                start_s: 0.0,
                rate_hz: 8000.0,
            },
            Clock {
                start_s: 0.1,
                rate_hz: 1000.0,
            },
        );
        let signal: Vec<f32> = (0..8000)
            .map(|n| libm::sin(TAU * 700.0 * from.time_s(f64::from(n))) as f32)
            .collect();
        assert!(
            resample(&signal, from, to, 700)
                .iter()
                .all(|x| x.abs() < 1e-3)
        );
    }
}

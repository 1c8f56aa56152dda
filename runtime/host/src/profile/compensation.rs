//! A short filter that evens out a device's response.
//!
//! With A(z) the linear predictor of the response's power spectrum, |H|² ≈ g²/|A|². So C = A/g makes
//! C·H flat. Levinson's recursion gives an A whose zeros lie within the unit circle, so C is of
//! minimum phase, whatever the spectrum. A gain then brings the median of the band to the
//! reference.

use core::f64::consts::PI;

use super::response::{BAND_HZ, Response, gain_at};
use super::{Compensation, MOST_TAPS, ProfileError};

/// Gain to which devices are brought, m/s² a newton: a free mass of 45 g.
pub const REFERENCE_M_S2_N: f64 = 1.0 / 0.045;

/// Frequencies of a design.
const GRID: usize = 512;

/// A filter, and what it leaves.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// The filter.
    pub filter: Compensation,
    /// Largest deviation from the reference within the band, dB, without it.
    pub before_db: f64,
    /// The same with it.
    pub after_db: f64,
}

/// Makes the filter of a response.
#[must_use]
pub fn design(response: &Response) -> Design {
    let spectrum: Vec<f64> = (0..GRID).map(|n| power(response, n)).collect();
    let predictor = levinson(&autocorrelation(&spectrum));
    let rate_hz = response.rate_hz;
    // The geometric middle of the largest and the smallest level within the band is the reference.
    let level = |freq_hz: f64, taps: &[f64]| {
        20.0 * libm::log10(
            gain(taps, freq_hz / rate_hz) * gain_at(&response.points, freq_hz) / REFERENCE_M_S2_N,
        )
    };
    let extremes = |taps: &[f64]| {
        band(response).fold(
            (f64::INFINITY, f64::NEG_INFINITY),
            |(low, high), freq_hz| {
                let level = level(freq_hz, taps);
                (low.min(level), high.max(level))
            },
        )
    };
    let (low, high) = extremes(&predictor);
    let scale = libm::exp10(-0.5 * (low + high) / 20.0);
    let taps: Vec<f64> = predictor.iter().map(|tap| tap * scale).collect();
    let deviation = |taps: &[f64]| {
        let (low, high) = extremes(taps);
        low.abs().max(high.abs())
    };
    Design {
        before_db: deviation(&[1.0]),
        after_db: deviation(&taps),
        filter: Compensation {
            rate_hz: rate_hz as f32,
            taps: taps.iter().map(|&tap| tap as f32).collect(),
        },
    }
}

/// Frequencies of the response within the band.
fn band(response: &Response) -> impl Iterator<Item = f64> + '_ {
    let frequencies = response.points.iter().map(|point| point.freq_hz);
    frequencies.filter(|freq_hz| (BAND_HZ.0..=BAND_HZ.1).contains(freq_hz))
}

/// Power of the response on the grid of a design. Outside the band it goes on as at its border: no
/// coefficient is spent there.
fn power(response: &Response, n: usize) -> f64 {
    let freq_hz = (n as f64 + 0.5) / GRID as f64 * 0.5 * response.rate_hz;
    let gain = gain_at(&response.points, freq_hz.clamp(BAND_HZ.0, BAND_HZ.1));
    gain * gain
}

fn autocorrelation(spectrum: &[f64]) -> [f64; MOST_TAPS] {
    std::array::from_fn(|lag| {
        let terms = spectrum.iter().enumerate();
        terms
            .map(|(n, power)| power * libm::cos(PI * lag as f64 * (n as f64 + 0.5) / GRID as f64))
            .sum::<f64>()
            / GRID as f64
    })
}

/// The linear predictor, 1 first.
fn levinson(r: &[f64; MOST_TAPS]) -> Vec<f64> {
    let mut a = vec![1.0];
    // A floor 70 dB down keeps the recursion well-conditioned.
    let mut error = r[0] * (1.0 + 1e-7);
    for order in 1..MOST_TAPS {
        if error.is_nan() || error <= 0.0 {
            break;
        }
        let sum: f64 = (0..order).map(|k| a[k] * r[order - k]).sum();
        let reflection = (-sum / error).clamp(-0.999, 0.999);
        let last = a.clone();
        a.push(0.0);
        for k in 1..=order {
            a[k] = last.get(k).copied().unwrap_or(0.0) + reflection * last[order - k];
        }
        error *= 1.0 - reflection * reflection;
    }
    a
}

/// Gain of a filter at a fraction of the rate.
fn gain(taps: &[f64], turns: f64) -> f64 {
    let (mut re, mut im) = (0.0, 0.0);
    for (k, tap) in taps.iter().enumerate() {
        let angle = 2.0 * PI * turns * k as f64;
        re += tap * libm::cos(angle);
        im -= tap * libm::sin(angle);
    }
    libm::sqrt(re * re + im * im)
}

/// Whether every zero of a filter lies within the unit circle: the reflection coefficients of its
/// monic form are all below 1.
fn is_minimum_phase(taps: &[f64]) -> bool {
    let mut a = taps.to_vec();
    while a.len() > 1 {
        let last = a.len() - 1;
        let reflection = a[last] / a[0];
        if reflection.is_nan() || reflection.abs() >= 1.0 {
            return false;
        }
        let rest = 1.0 - reflection * reflection;
        a = (0..last)
            .map(|k| (a[k] - reflection * a[last - k]) / rest)
            .collect();
    }
    true
}

/// Checks a filter of a file.
pub(super) fn check(filter: &Compensation, file: &str) -> Result<(), ProfileError> {
    let taps: Vec<f64> = filter.taps.iter().map(|&tap| f64::from(tap)).collect();
    let rule = if taps.is_empty() || taps.len() > MOST_TAPS {
        "it has one to eight coefficients"
    } else if !taps.iter().all(|tap| tap.abs() <= 100.0) || taps[0] == 0.0 {
        "each coefficient is a number of at most 100, and the first is not 0"
    } else if !(filter.rate_hz >= 100.0 && filter.rate_hz <= 20_000.0) {
        "`rate_hz` is 100 to 20000 Hz"
    } else if !is_minimum_phase(&taps) {
        "the filter must be of minimum phase"
    } else {
        return Ok(());
    };
    Err(ProfileError::Filter {
        file: file.into(),
        rule,
    })
}

#[cfg(test)]
mod tests {
    use super::super::response::{ResponseError, estimate};
    use super::super::sweep::Sweep;
    use super::*;

    const RATE_HZ: f64 = 1000.0;

    /// A device that answers with a second-order section, a gain and a delay, and an accelerometer
    /// with noise.
    #[derive(Clone, Copy)]
    struct Device {
        gain_m_s2_n: f64,
        /// Frequency, Hz, and radius of its poles.
        poles: (f64, f64),
        /// The same of its zeros.
        zeros: (f64, f64),
        delay: usize,
        noise_m_s2: f64,
    }

    impl Device {
        fn answer(&self, force_n: &[f64]) -> Vec<f64> {
            let section = |(freq_hz, radius): (f64, f64)| {
                let turn = libm::cos(2.0 * PI * freq_hz / RATE_HZ);
                [1.0, -2.0 * radius * turn, radius * radius]
            };
            let (b, a) = (section(self.zeros), section(self.poles));
            let mut random = 12_345_u64;
            let mut noise = || {
                random = random
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1);
                (random >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
            };
            let at = |signal: &[f64], n: usize, back: usize| {
                n.checked_sub(back).map_or(0.0, |n| signal[n])
            };
            let mut clean: Vec<f64> = Vec::new();
            for n in 0..force_n.len() {
                let driven: f64 = (0..3).map(|k| b[k] * at(force_n, n, k + self.delay)).sum();
                let own: f64 = (1..3).map(|k| a[k] * at(&clean, n, k)).sum();
                clean.push(driven - own);
            }
            clean
                .iter()
                .map(|x| self.gain_m_s2_n * x + self.noise_m_s2 * noise())
                .collect()
        }
    }

    /// Three devices whose levels differ by ±12 dB, with their own colours.
    fn devices() -> [Device; 3] {
        [
            Device {
                gain_m_s2_n: 22.0,
                poles: (150.0, 0.85),
                zeros: (380.0, 0.3),
                delay: 0,
                noise_m_s2: 0.05,
            },
            Device {
                gain_m_s2_n: 88.0,
                poles: (60.0, 0.8),
                zeros: (300.0, 0.5),
                delay: 1,
                noise_m_s2: 0.05,
            },
            Device {
                gain_m_s2_n: 5.5,
                poles: (250.0, 0.9),
                zeros: (90.0, 0.6),
                delay: 3,
                noise_m_s2: 0.05,
            },
        ]
    }

    fn band_of(response: &Response) -> Vec<super::super::response::Point> {
        let in_band = |freq_hz: f64| (BAND_HZ.0..=BAND_HZ.1).contains(&freq_hz);
        let points = response.points.iter().copied();
        points.filter(|point| in_band(point.freq_hz)).collect()
    }

    #[test]
    fn devices_that_differ_by_24_db_agree_within_3_db() {
        let force = Sweep::standard(RATE_HZ, 0.5).force_n();
        let noise: Vec<f64> = Device {
            gain_m_s2_n: 0.0,
            noise_m_s2: 0.5,
            ..devices()[0]
        }
        .answer(&vec![0.0; force.len()]);
        for (n, device) in devices().iter().enumerate() {
            let response = estimate(&force, &device.answer(&force), RATE_HZ).expect("a response");
            let design = design(&response);
            let taps: Vec<f64> = design
                .filter
                .taps
                .iter()
                .map(|&tap| f64::from(tap))
                .collect();
            assert!(taps.len() == MOST_TAPS && is_minimum_phase(&taps), "{n}");
            assert!(check(&design.filter, "here").is_ok(), "{n}");
            println!(
                "device {n}: {:.1} dB before, {:.2} dB after",
                design.before_db, design.after_db
            );
            assert!(
                design.before_db > 6.0 && design.after_db < 3.0,
                "{n}: {design:?}"
            );

            // Measured anew, on white noise through filter and device.
            let filtered: Vec<f64> = (0..noise.len())
                .map(|n| {
                    (0..taps.len().min(n + 1))
                        .map(|k| taps[k] * noise[n - k])
                        .sum()
                })
                .collect();
            let again = estimate(&noise, &device.answer(&filtered), RATE_HZ).expect("a response");
            for point in band_of(&again) {
                let off_db = 20.0 * libm::log10(point.gain_m_s2_n / REFERENCE_M_S2_N);
                assert!(
                    off_db.abs() < 3.0,
                    "{n}: {off_db:.2} dB at {:.0} Hz",
                    point.freq_hz
                );
            }
        }
    }

    #[test]
    fn gain_resonance_delay_and_coherence_are_found() {
        let force = Sweep::standard(RATE_HZ, 0.5).force_n();
        for delay in [0, 2, 5] {
            let device = Device {
                gain_m_s2_n: 20.0,
                poles: (200.0, 0.95),
                zeros: (0.0, 0.0),
                delay,
                noise_m_s2: 0.01,
            };
            let response = estimate(&force, &device.answer(&force), RATE_HZ).expect("a response");
            assert!(
                (response.resonance_hz - 200.0).abs() < 8.0,
                "{}",
                response.resonance_hz
            );
            assert!(
                response.resonance_db > 10.0 && response.worst_coherence > 0.9,
                "{response:?}"
            );
        }
        let plain = |delay| Device {
            gain_m_s2_n: 20.0,
            poles: (0.0, 0.0),
            zeros: (0.0, 0.0),
            delay,
            noise_m_s2: 0.0,
        };
        for delay in [0, 2, 5] {
            let response =
                estimate(&force, &plain(delay).answer(&force), RATE_HZ).expect("a response");
            assert!(
                (response.delay_s - 1e-3 * delay as f64).abs() < 1e-4,
                "{delay}: {}",
                response.delay_s
            );
            for point in band_of(&response) {
                assert!((point.gain_m_s2_n / 20.0 - 1.0).abs() < 0.05, "{point:?}");
            }
        }
        let deaf = Device {
            gain_m_s2_n: 0.0,
            noise_m_s2: 1.0,
            ..plain(0)
        };
        let response = estimate(&force, &deaf.answer(&force), RATE_HZ).expect("a response");
        assert!(
            response.worst_coherence < 0.2,
            "noise follows from no force"
        );
    }

    #[test]
    fn signals_that_tell_nothing_are_refused() {
        let force = Sweep::standard(RATE_HZ, 0.5).force_n();
        let refused = |force: &[f64], accel: &[f64], rate_hz| {
            estimate(force, accel, rate_hz).expect_err("refused")
        };
        assert!(matches!(
            refused(&force, &force[1..], RATE_HZ),
            ResponseError::Lengths { .. }
        ));
        assert!(matches!(
            refused(&force[..100], &force[..100], RATE_HZ),
            ResponseError::TooShort { .. }
        ));
        assert!(matches!(
            refused(&force, &force, 500.0),
            ResponseError::Rate { .. }
        ));
        let silent = vec![0.0; force.len()];
        assert!(matches!(
            refused(&silent, &force, RATE_HZ),
            ResponseError::Silent { .. }
        ));
        let mut broken = force.clone();
        broken[77] = f64::NAN;
        assert!(matches!(
            refused(&force, &broken, RATE_HZ),
            ResponseError::NotFinite { at: 77 }
        ));
    }
}

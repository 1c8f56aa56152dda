//! Three devices with their own colours, and what the filters make of them.

use super::whitening::{gain, is_minimum_phase};
use super::*;
use crate::profile::response::{ResponseError, estimate};
use crate::profile::sweep::Sweep;
use core::f64::consts::PI;

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
        let at =
            |signal: &[f64], n: usize, back: usize| n.checked_sub(back).map_or(0.0, |n| signal[n]);
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

fn band_of(response: &Response) -> Vec<crate::profile::response::Point> {
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
        let response = estimate(&force, &plain(delay).answer(&force), RATE_HZ).expect("a response");
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

#[test]
fn a_filter_keeps_its_gain_at_other_rates_and_with_fewer_coefficients() {
    let force = Sweep::standard(RATE_HZ, 0.5).force_n();
    let response = estimate(&force, &devices()[0].answer(&force), RATE_HZ).expect("a response");
    let filter = design(&response).filter;
    let own: Vec<f64> = filter.taps.iter().map(|&tap| f64::from(tap)).collect();
    assert_eq!(taps_at(&filter, RATE_HZ, MOST_TAPS), own);
    for (rate_hz, most, within_db) in [(800.0, 8, 1.5), (2000.0, 8, 3.0), (1000.0, 6, 3.0)] {
        let taps = taps_at(&filter, rate_hz, most);
        assert!(
            taps.len() == most && is_minimum_phase(&taps),
            "{rate_hz} Hz"
        );
        for freq_hz in (40..=360).map(f64::from) {
            let off_db =
                20.0 * libm::log10(gain(&taps, freq_hz / rate_hz) / gain(&own, freq_hz / RATE_HZ));
            assert!(
                off_db.abs() < within_db,
                "{rate_hz} Hz, {most}: {off_db:.2} dB at {freq_hz} Hz"
            );
        }
    }
}

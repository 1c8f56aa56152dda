//! Tap transients for a source that has none: impacts whose contact time follows the texture.
//!
//! A surface that vibrates at higher frequencies taps harder: the contact lasts half a period of
//! the texture's frequency. Everything else follows [`impact`] for a material of that contact time:
//! the time falls with the impact speed, and the centroid rises. Nothing says how the surface rings,
//! so it has no modes. All of it is a guess at the material, so such a bank is marked synthetic.
//!
//! ```
//! use asperity_texture::model::{defaults, tap_synthesis};
//!
//! let bank = tap_synthesis::bank(200.0, &defaults::gains());
//! assert_eq!(bank.traces.len(), tap_synthesis::SPEEDS);
//! ```

pub use crate::signal::impact::{SAMPLE_RATE_HZ, SAMPLES, SPEED_STEP_M_S, SPEEDS};

use crate::model::{Gains, ModelGrid, TapBank, TapTrace, VertexKind};
use crate::signal::impact::{self, Impact, Mode};
use crate::signal::spectrum::ArmaModel;

/// ∫a dt per impact speed, so that J = m_eff·∫a dt is 5 % of the momentum m_eff·v.
/// The wall returns the rest.
pub const IMPULSE_PER_SPEED: f64 = 0.05;
/// Range of the frequency, Hz: perceived hardness peaks near 300 Hz.
pub const FREQ_RANGE_HZ: (f64, f64) = (80.0, 350.0);
/// Loss factor of a material of which nothing is known.
const LOSS_FACTOR: f64 = 0.1;
/// Fraction of the device's force that the strongest tap may take.
const PEAK_SHARE: f64 = 0.9;

/// Frequency of the synthesised taps, Hz: 1.5 times the mean spectral centroid above
/// 40 Hz over the interior vertices, within [`FREQ_RANGE_HZ`].
#[must_use]
pub fn frequency_hz(grid: &ModelGrid) -> f64 {
    let centroids: Vec<f64> = grid
        .vertices
        .iter()
        .filter(|vertex| vertex.kind == VertexKind::Interior)
        .filter_map(|vertex| ArmaModel::at_vertex(grid, vertex).vibration())
        .map(|vibration| vibration.centroid_hz)
        .collect();
    let (low, high) = FREQ_RANGE_HZ;
    if centroids.is_empty() {
        return low;
    }
    let mean = centroids.iter().sum::<f64>() / centroids.len() as f64;
    (1.5 * mean).clamp(low, high)
}

/// A bank of [`SPEEDS`] traces of [`SAMPLES`] samples whose impulse is
/// [`IMPULSE_PER_SPEED`]·v after truncation, or less where `m_eff·a` would exceed
/// nine tenths of `f_max`.
#[must_use]
pub fn bank(freq_hz: f64, gains: &Gains) -> TapBank {
    let modulus_mpa = Impact::modulus_mpa(0.5 / freq_hz);
    let material = Impact::of_material(modulus_mpa, LOSS_FACTOR);
    let impact = Impact {
        modes: material.modes.map(|mode| Mode { share: 0.0, ..mode }),
        ..material
    };
    let peak_m_s2 = if gains.effective_mass_kg > 0.0 {
        PEAK_SHARE * gains.f_max_n / gains.effective_mass_kg
    } else {
        f64::INFINITY
    };
    let traces = impact::bank(&impact, IMPULSE_PER_SPEED, peak_m_s2);
    TapBank {
        sample_rate_hz: SAMPLE_RATE_HZ,
        traces: impact::speeds_m_s()
            .into_iter()
            .zip(traces)
            .map(|(speed_m_s, trace)| TapTrace {
                speed_m_s,
                accel_m_s2: trace.to_vec(),
            })
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gains() -> Gains {
        Gains {
            vib_s2_m: 0.05 / 3.3,
            effective_mass_kg: 0.05,
            f_max_n: 3.3,
        }
    }

    #[test]
    fn the_impulse_is_as_stated_after_truncation() {
        for freq_hz in [80.0, 150.0, 350.0] {
            for trace in bank(freq_hz, &gains()).traces {
                let expected = IMPULSE_PER_SPEED * trace.speed_m_s;
                let found = trace.accel_m_s2.iter().sum::<f64>() / SAMPLE_RATE_HZ;
                assert!((found / expected - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn no_tap_exceeds_the_device_and_a_weak_device_gets_weaker_taps() {
        for f_max_n in [0.1, 3.3] {
            let gains = Gains { f_max_n, ..gains() };
            let peak = bank(350.0, &gains)
                .traces
                .iter()
                .flat_map(|trace| trace.accel_m_s2.iter())
                .fold(0.0_f64, |peak, a| peak.max(a.abs()));
            assert!(gains.effective_mass_kg * peak <= PEAK_SHARE * f_max_n * (1.0 + 1e-12));
        }
    }

    #[test]
    fn a_brighter_bank_has_a_higher_centroid() {
        let centroid = |freq_hz| {
            let bank = bank(freq_hz, &gains());
            crate::signal::spectrum::trace_centroid_hz(&bank.traces[12].accel_m_s2, SAMPLE_RATE_HZ)
                .unwrap()
        };
        assert!(centroid(100.0) < centroid(200.0) && centroid(200.0) < centroid(350.0));
    }

    #[test]
    fn a_faster_tap_has_a_higher_centroid() {
        for freq_hz in [80.0, 150.0, 350.0] {
            let centroids: Vec<f64> = bank(freq_hz, &gains())
                .traces
                .iter()
                .map(|trace| {
                    crate::signal::spectrum::trace_centroid_hz(&trace.accel_m_s2, SAMPLE_RATE_HZ)
                        .unwrap()
                })
                .collect();
            assert!(
                centroids.is_sorted_by(|slow, fast| slow < fast),
                "{centroids:?}"
            );
        }
    }
}

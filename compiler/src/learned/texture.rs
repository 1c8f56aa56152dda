//! Builds a texture from what a latent decodes to.

use super::{
    description::{GridDescription, ModelDescription},
    edges,
    friction::{self, Neighbour},
    model::{Decoded, DecodedGrid, Latent},
};
use asperity_texture::model::triangulate;
use asperity_texture::{
    model::{
        Friction, FrictionAnchor, Gains, GridVertex, ModelGrid, Numerator, Provenance, TapBank,
        TapTrace, TextureModel, VertexKind, Wall, defaults,
    },
    signal::{level::nyquist_rms, lsf},
};
use std::f64::consts::PI;

/// Neighbouring LSFs keep at least this distance, rad: twice what an asset demands.
const LEAST_GAP_RAD: f64 = 0.01;
/// Largest RMS gain of a filter, twice that of trained materials. Very different models of a
/// larger gain that take turns within a stroke can ring.
const LARGEST_GAIN: f64 = 8.0;
/// Widest range of |A(e^jω)|: a quarter of what the runtime loads, so that it holds after a reduction as well.
const WIDEST_RANGE: f64 = 2.5e4;
/// Range of the level of a bin, dB re 1 m/s², whatever a decoder says. At the default gain, 20 dB
/// are 0.5 N RMS.
pub(crate) const LEVEL_RANGE_DB: (f64, f64) = (-60.0, 20.0);
/// Largest level of an edge model, dB re 1 m/s². Levels grow towards fast and hard strokes with
/// the powers that the bins show, and those of a far latent may be anything.
const LARGEST_EDGE_DB: f64 = 32.0;
/// Samples of a trace stay below this fraction of the device's force over `m_eff`.
const TAP_SHARE: f64 = 0.95;

/// The texture of decoded parameters, and the friction anchors that are nearest to `z`.
///
/// It is stable and within bounds whatever the parameters: LSFs are sorted and moved apart, and
/// levels and traces are limited.
#[must_use]
pub fn build(
    description: &ModelDescription,
    decoded: &Decoded,
    z: &Latent,
    name: String,
    provenance: Provenance,
) -> (TextureModel, Vec<Neighbour>) {
    let neighbours = friction::neighbours(z, &description.anchors, description.friction);
    let gains = defaults::gains();
    let texture = TextureModel {
        name,
        grid: grid(&description.grid, &decoded.grid),
        taps: taps(description, &decoded.taps_m_s2, &gains),
        friction: Friction {
            mu: friction::mu(&neighbours, &description.anchors),
            anchors: neighbours
                .iter()
                .map(|neighbour| {
                    let anchor = &description.anchors[neighbour.index];
                    FrictionAnchor {
                        name: anchor.name.clone(),
                        mu: anchor.mu,
                        weight: neighbour.weight,
                    }
                })
                .collect(),
            law: None,
        },
        wall: Wall {
            stiffness_n_m: friction::stiffness_n_m(&neighbours, &description.anchors),
            damping_n_s_m: defaults::DAMPING_N_S_M,
        },
        contact: None,
        direction: None,
        gains,
        provenance,
    };
    (texture, neighbours)
}

/// The AR grid of decoded parameters, with its edge models.
#[must_use]
pub fn grid(grid: &GridDescription, decoded: &DecodedGrid) -> ModelGrid {
    let interior = (0..grid.speeds_mm_s.len())
        .map(|bin| {
            let raw = &decoded.lsf_rad[bin * grid.order..(bin + 1) * grid.order];
            let lsf_rad = tamed(spread(raw));
            let (low, high) = LEVEL_RANGE_DB;
            let level_db = f64::from(decoded.level_db[bin]).clamp(low, high);
            GridVertex {
                speed_mm_s: grid.speeds_mm_s[bin],
                force_n: grid.forces_n[bin],
                kind: VertexKind::Interior,
                sigma_m_s2: libm::exp10(level_db / 20.0) / nyquist_rms(&lsf_rad),
                lsf_rad,
                ma_lsf_rad: None,
                gain: 1.0,
            }
        })
        .collect();
    let mut vertices = edges::close(interior, grid.max_speed_mm_s, grid.max_force_n);
    for vertex in &mut vertices {
        let largest = libm::exp10(LARGEST_EDGE_DB / 20.0) / nyquist_rms(&vertex.lsf_rad);
        vertex.sigma_m_s2 = vertex.sigma_m_s2.min(largest);
    }
    ModelGrid {
        sample_rate_hz: grid.sample_rate_hz,
        order: grid.order,
        numerator: Numerator::Nyquist,
        triangles: triangulate::delaunay(&vertices),
        vertices,
    }
}

/// The tap bank of decoded traces, m/s², `speeds × samples`, within what a device of these gains can give.
#[must_use]
pub fn taps(description: &ModelDescription, taps_m_s2: &[f32], gains: &Gains) -> TapBank {
    let taps = &description.taps;
    let limit = TAP_SHARE * (gains.f_max_n / gains.effective_mass_kg);
    TapBank {
        sample_rate_hz: taps.sample_rate_hz,
        traces: taps
            .speeds_m_s
            .iter()
            .zip(taps_m_s2.chunks(taps.samples))
            .map(|(&speed_m_s, trace)| TapTrace {
                speed_m_s,
                accel_m_s2: trace
                    .iter()
                    .map(|&a| f64::from(a).clamp(-limit, limit))
                    .collect(),
            })
            .collect(),
    }
}

/// LSFs moved towards white noise until the gain and the range of |A| are within bounds.
fn tamed(lsf_rad: Vec<f64>) -> Vec<f64> {
    const STEPS: u32 = 20;
    (0..=STEPS)
        .map(|step| lsf::towards_white_noise(&lsf_rad, f64::from(step) / f64::from(STEPS)))
        .find(|mixed| {
            nyquist_rms(mixed) <= LARGEST_GAIN && lsf::magnitude_range(mixed) <= WIDEST_RANGE
        })
        .unwrap_or(lsf_rad)
}

/// The LSFs in order and at least [`LEAST_GAP_RAD`] apart, moved no further than needed.
fn spread(raw: &[f32]) -> Vec<f64> {
    let count = raw.len();
    let mut lsf: Vec<f64> = raw
        .iter()
        .map(|&x| if x.is_nan() { 0.0 } else { f64::from(x) })
        .collect();
    lsf.sort_by(f64::total_cmp);
    for (index, omega) in lsf.iter_mut().enumerate() {
        let below = (index + 1) as f64 * LEAST_GAP_RAD;
        let above = PI - (count - index) as f64 * LEAST_GAP_RAD;
        *omega = omega.clamp(below, above);
    }
    for index in 1..count {
        lsf[index] = lsf[index].max(lsf[index - 1] + LEAST_GAP_RAD);
    }
    for index in (0..count).rev() {
        let next = lsf.get(index + 1).copied().unwrap_or(PI);
        lsf[index] = lsf[index].min(next - LEAST_GAP_RAD);
    }
    lsf
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hostile_frequencies_come_out_ordered_and_apart() {
        let hostile: [&[f32]; 5] = [
            &[3.0, 2.0, 1.0],
            &[0.0, 0.0, 0.0],
            &[9.0, 9.0, -4.0],
            &[f32::NAN, f32::INFINITY, f32::NEG_INFINITY],
            &[1.0, 1.0, 1.0],
        ];
        for raw in hostile {
            let lsf = spread(raw);
            assert!(
                lsf::smallest_gap(&lsf) > 0.99 * LEAST_GAP_RAD,
                "{raw:?} {lsf:?}"
            );
        }
    }

    #[test]
    fn good_frequencies_stay() {
        let raw = [0.2_f32, 0.5, 2.0];
        for (found, expected) in spread(&raw).iter().zip(raw) {
            assert_eq!(*found, f64::from(expected));
        }
    }
}

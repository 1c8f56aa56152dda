//! The built-in texture: grit under a stylus, made from a small model of its physics. It needs no file and no learned
//! model, so examples and tests begin with it.
//!
//! Grains at a distance λ pass the tip `v/λ` times a second. Their impacts give a spectral line at
//! that frequency and a weaker harmonic, both widened by the irregular spacing. The stylus adds a
//! resonance, and a broad floor falls with frequency. The level grows with powers of speed and force
//! below one, as that of real textures does. No recording went into it.
//!
//! ```
//! use asperity::sources::builtin;
//!
//! let texture = builtin::texture();
//! assert_eq!(texture.name, "Built-in Grit");
//! assert_eq!(texture, builtin::texture()); // the same on every call
//! ```

use crate::{
    pipeline::{Pass, Pipeline, Request},
    sources::{Source, SourceOutput, Tools},
};
use asperity_io::diagnostic::Failure;
use asperity_texture::{
    model::{
        Friction, FrictionAnchor, GridVertex, ModelGrid, Numerator, Provenance, TextureModel,
        VertexKind, defaults, tap_synthesis, triangulate,
    },
    signal::{levinson, lsf},
};
use std::f64::consts::PI;

/// Rate of every model, Hz.
const SAMPLE_RATE_HZ: f64 = 1000.0;
/// AR order; B = 1 + z⁻¹.
const ORDER: usize = 20;
/// Borders of the grid.
const MAX_SPEED_MM_S: f64 = 240.0;
const MAX_FORCE_N: f64 = 3.2;
/// Speeds and forces of the 6 × 3 interior points, before they are staggered.
const SPEEDS_MM_S: [f64; 6] = [25.0, 60.0, 100.0, 140.0, 180.0, 218.0];
const FORCES_N: [f64; 3] = [0.5, 1.4, 2.5];

/// Mean distance of the grains, mm.
const GRAIN_SPACING_MM: f64 = 0.9;
/// Relative width of the line that the grains make.
const SPACING_SPREAD: f64 = 0.16;
/// Power of the second harmonic relative to the first.
const SECOND_HARMONIC: f64 = 0.15;
/// Resonance of the stylus, Hz, its quality factor, and its power relative to the line.
const STYLUS_HZ: f64 = 330.0;
const STYLUS_Q: f64 = 5.0;
const STYLUS_SHARE: f64 = 0.04;
/// Broad floor at 100 Hz, relative to the line.
const FLOOR: f64 = 0.01;
/// RMS acceleration at 100 mm/s and 1 N, m/s², and how it grows.
const LEVEL_M_S2: f64 = 1.6;
const SPEED_EXPONENT: f64 = 0.8;
const FORCE_EXPONENT: f64 = 0.5;
/// Coefficient of kinetic friction.
const MU: f64 = 0.72;

/// The built-in texture as a source.
#[derive(Debug, Clone, Copy)]
pub struct Builtin;

impl Source for Builtin {
    fn model(
        &self,
        _: &Request,
        _: &Tools<'_>,
        pipeline: &mut Pipeline,
    ) -> Result<SourceOutput, Failure> {
        Ok(SourceOutput::new(pipeline.run(Pass::Generate, texture)))
    }
}

/// The built-in texture; the same on every call.
#[must_use]
pub fn texture() -> TextureModel {
    let vertices = vertices();
    let triangles = triangulate::delaunay(&vertices);
    let grid = ModelGrid {
        sample_rate_hz: SAMPLE_RATE_HZ,
        order: ORDER,
        numerator: Numerator::Nyquist,
        vertices,
        triangles,
    };
    let gains = defaults::gains();
    let name = "Built-in Grit";
    TextureModel {
        name: name.into(),
        taps: tap_synthesis::bank(tap_synthesis::frequency_hz(&grid), &gains),
        grid,
        friction: Friction {
            mu: MU,
            anchors: vec![FrictionAnchor {
                name: name.into(),
                mu: MU,
                weight: 1.0,
            }],
            law: None,
        },
        wall: defaults::wall(),
        contact: None,
        direction: None,
        gains,
        provenance: Provenance {
            generator: format!("asperity {} builtin", env!("CARGO_PKG_VERSION")),
            source: "generated".into(),
            source_crc32: 0,
            prompt: None,
            seed: 0,
            fidelity: "full".into(),
            taps_synthetic: true,
            lsf_error_db: 0.0,
            notes: "Everything is synthetic: a model of grit under a stylus. Wall, gains and \
                masses are unconfirmed defaults."
                .into(),
        },
    }
}

/// 18 interior points and the edge models that close the rectangle.
fn vertices() -> Vec<GridVertex> {
    let interior: Vec<GridVertex> = FORCES_N
        .iter()
        .enumerate()
        .flat_map(|(row, &force_n)| {
            SPEEDS_MM_S.iter().enumerate().map(move |(column, &speed)| {
                // Measured points never lie on a lattice, so these do not either.
                let speed_mm_s = speed + [6.0, -5.0, 2.0][(row + column) % 3];
                let force_n = force_n * [1.0, 1.12, 0.9][(row + 2 * column) % 3];
                interior_vertex(speed_mm_s, force_n)
            })
        })
        .collect();
    let columns = SPEEDS_MM_S.len();
    let edge = |speed_mm_s: f64, force_n: f64, like: &GridVertex| GridVertex {
        speed_mm_s,
        force_n,
        kind: VertexKind::Edge,
        // Nothing vibrates at rest or without touch.
        sigma_m_s2: if speed_mm_s == 0.0 || force_n == 0.0 {
            0.0
        } else {
            like.sigma_m_s2
        },
        ..like.clone()
    };
    let (first_row, last_row) = (&interior[..columns], &interior[interior.len() - columns..]);
    let mut all = interior.clone();
    for vertex in first_row {
        all.push(edge(vertex.speed_mm_s, 0.0, vertex));
    }
    for vertex in last_row {
        all.push(edge(vertex.speed_mm_s, MAX_FORCE_N, vertex));
    }
    for row in interior.chunks(columns) {
        let (slowest, fastest) = (&row[0], &row[columns - 1]);
        all.push(edge(0.0, slowest.force_n, slowest));
        all.push(edge(MAX_SPEED_MM_S, fastest.force_n, fastest));
    }
    for (row, force_n) in [(first_row, 0.0), (last_row, MAX_FORCE_N)] {
        all.push(edge(0.0, force_n, &row[0]));
        all.push(edge(MAX_SPEED_MM_S, force_n, &row[columns - 1]));
    }
    all
}

fn interior_vertex(speed_mm_s: f64, force_n: f64) -> GridVertex {
    let shape = |omega: f64| {
        let freq_hz = omega / (2.0 * PI) * SAMPLE_RATE_HZ;
        spectrum(freq_hz, speed_mm_s)
    };
    let (monic, unscaled_sigma) = levinson::all_pole(ORDER, shape);
    // The mean of |1 + z⁻¹|²·shape over frequency is the variance at the unscaled σ.
    const POINTS: usize = 2048;
    let variance = (0..POINTS)
        .map(|point| (point as f64 + 0.5) * PI / POINTS as f64)
        .map(|omega| (2.0 + 2.0 * libm::cos(omega)) * shape(omega))
        .sum::<f64>()
        / POINTS as f64;
    let rms_m_s2 = LEVEL_M_S2
        * libm::pow(speed_mm_s / 100.0, SPEED_EXPONENT)
        * libm::pow(force_n, FORCE_EXPONENT);
    GridVertex {
        speed_mm_s,
        force_n,
        kind: VertexKind::Interior,
        // Levinson's recursion gives |r| < 1 for a positive spectrum.
        lsf_rad: lsf::from_polynomial(&monic).unwrap_or_default(),
        ma_lsf_rad: None,
        gain: 1.0,
        sigma_m_s2: unscaled_sigma * rms_m_s2 / variance.sqrt(),
    }
}

/// Power spectrum of grit at a speed, without the zero at half the rate; the line has
/// a peak of one.
fn spectrum(freq_hz: f64, speed_mm_s: f64) -> f64 {
    let grains_hz = speed_mm_s / GRAIN_SPACING_MM;
    let line = |center_hz: f64| {
        // Slow strokes, too, give a line of some width.
        let width_hz = (SPACING_SPREAD * center_hz).max(12.0);
        let offset = (freq_hz - center_hz) / width_hz;
        1.0 / (1.0 + offset * offset * offset * offset)
    };
    let ratio = freq_hz / STYLUS_HZ;
    let detuning = 1.0 - ratio * ratio;
    let damping = ratio / STYLUS_Q;
    let stylus = STYLUS_SHARE / (detuning * detuning + damping * damping) / (STYLUS_Q * STYLUS_Q);
    let floor = FLOOR / (1.0 + freq_hz / 100.0);
    line(grains_hz) + SECOND_HARMONIC * line(2.0 * grains_hz) + stylus + floor
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_texture::{model::mesh, signal::spectrum::ArmaModel};

    #[test]
    fn the_grid_has_18_interior_points_and_tiles_its_rectangle() {
        let grid = texture().grid;
        let interior = |v: &&GridVertex| v.kind == VertexKind::Interior;
        assert_eq!(grid.vertices.iter().filter(interior).count(), 18);
        assert_eq!(mesh::check(&grid), Ok(()));
        assert_eq!(mesh::corner(&grid), (MAX_SPEED_MM_S, MAX_FORCE_N));
    }

    #[test]
    fn every_model_is_stable_and_follows_the_grains() {
        let grid = texture().grid;
        for vertex in grid
            .vertices
            .iter()
            .filter(|v| v.kind == VertexKind::Interior)
        {
            assert_eq!(vertex.lsf_rad.len(), ORDER);
            assert!(lsf::is_ordered(&vertex.lsf_rad));
            let grains_hz = vertex.speed_mm_s / GRAIN_SPACING_MM;
            let model = ArmaModel::at_vertex(&grid, vertex);
            // The line stands well above what lies an octave and a half away from it.
            let beside = model.power((2.9 * grains_hz).min(480.0));
            assert!(model.power(grains_hz) > 4.0 * beside, "{grains_hz} Hz");
        }
    }

    #[test]
    fn level_grows_with_speed_and_force_and_is_as_designed() {
        let quiet = interior_vertex(50.0, 1.0);
        let loud = interior_vertex(200.0, 2.0);
        let grid = texture().grid;
        let rms = |vertex: &GridVertex| {
            let model = ArmaModel::at_vertex(&grid, vertex);
            let sum: f64 = (0..5000)
                .map(|n| model.power(f64::from(n) / 10.0 + 0.05))
                .sum();
            (sum / 5000.0).sqrt()
        };
        assert!((rms(&quiet) / (LEVEL_M_S2 * 0.5_f64.powf(SPEED_EXPONENT)) - 1.0).abs() < 0.02);
        assert!(rms(&loud) > 2.0 * rms(&quiet));
    }
}

//! Objective attributes of a texture: what rough, sharp, hard and slippery mean here.
//!
//! They describe the vibration that a grid mixes at one stated stroke, the fastest tap trace, and friction. Reports,
//! sliders and the grammar of prompts all refer to these numbers.
//!
//! ```
//! use asperity_texture::model::attributes;
//! # use asperity_texture::model::{
//! #     Friction, GridVertex, ModelGrid, Numerator, Provenance, TapBank, TextureModel, VertexKind, defaults,
//! # };
//! # let texture = |sigma_m_s2: f64| {
//! #     let corner = |speed_mm_s: f64, force_n: f64| GridVertex {
//! #         speed_mm_s,
//! #         force_n,
//! #         kind: VertexKind::Edge,
//! #         lsf_rad: vec![0.4, 0.9],
//! #         ma_lsf_rad: None,
//! #         gain: 1.0,
//! #         sigma_m_s2,
//! #     };
//! #     TextureModel {
//! #         name: "buzz".into(),
//! #         grid: ModelGrid {
//! #             sample_rate_hz: 1000.0,
//! #             order: 2,
//! #             numerator: Numerator::None,
//! #             vertices: vec![corner(0.0, 0.0), corner(200.0, 0.0), corner(200.0, 2.0), corner(0.0, 2.0)],
//! #             triangles: vec![[0, 1, 2], [0, 2, 3]],
//! #         },
//! #         taps: TapBank::default(),
//! #         friction: Friction { mu: 0.5, anchors: Vec::new(), law: None },
//! #         wall: defaults::wall(),
//! #         contact: None,
//! #         direction: None,
//! #         gains: defaults::gains(),
//! #         provenance: Provenance::default(),
//! #     }
//! # };
//!
//! // Two textures without taps: one resonance, excited with 0.1 and with 1 m/s².
//! let (quiet, loud) = (attributes::of(&texture(0.1)), attributes::of(&texture(1.0)));
//! let change_db = loud.rough_db.expect("a vibration") - quiet.rough_db.expect("a vibration");
//! assert!((change_db - 20.0).abs() < 1e-6);
//! assert_eq!((loud.hard_hz, loud.mu), (None, 0.5));
//! ```

use crate::{
    model::{
        ModelGrid, TapBank, TextureModel, mesh,
        mixture::{BarycentricPoint, Field},
    },
    signal::spectrum::{TraceBand, Vibration, VibrationBand},
};
use serde::Serialize;

/// Speed of the stroke at which the vibration is described, mm/s.
pub const SPEED_MM_S: f64 = 100.0;
/// Force of that stroke, N.
pub const FORCE_N: f64 = 1.0;
/// Lowest rate of a trace whose centroid counts as hardness, Hz.
const MIN_TAP_RATE_HZ: f64 = 5000.0;

/// Objective attributes. An attribute is `None` where a texture does not define it, because it
/// has no taps, or is silent at the [stated stroke](stroke).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Attributes {
    /// Level of the vibration above 40 Hz at the [stated stroke](stroke), as the runtime mixes
    /// there: excitation included, before device gain, dB re 1 (m/s²)².
    pub rough_db: Option<f64>,
    /// Power-weighted spectral centroid of the same above 40 Hz, Hz.
    pub sharp_hz: Option<f64>,
    /// Power-weighted spectral centroid of the fastest trace, Hz.
    pub hard_hz: Option<f64>,
    /// Coefficient of kinetic friction; slipperiness is −μ.
    pub mu: f64,
}

impl Attributes {
    /// Those of a texture whose parts were measured.
    #[must_use]
    pub fn of_parts(vibration: Option<Vibration>, hard_hz: Option<f64>, mu: f64) -> Self {
        Self {
            rough_db: vibration.map(|v| 10.0 * libm::log10(v.power)),
            sharp_hz: vibration.map(|v| v.centroid_hz),
            hard_hz,
            mu,
        }
    }
}

/// Speed (mm/s) and force (N) at which the vibration of a grid is described: [`SPEED_MM_S`] and
/// [`FORCE_N`], or the nearest point of the grid's rectangle where that lies beyond it.
#[must_use]
pub fn stroke(grid: &ModelGrid) -> (f64, f64) {
    let (max_speed_mm_s, max_force_n) = mesh::corner(grid);
    (SPEED_MM_S.min(max_speed_mm_s), FORCE_N.min(max_force_n))
}

/// The triangle of a grid at its [stated stroke](stroke), and the weights there.
#[must_use]
pub fn place(grid: &ModelGrid) -> Option<BarycentricPoint> {
    let (speed_mm_s, force_n) = stroke(grid);
    // Where a query lies takes no cosines.
    Field::with_cosines(grid, &[]).locate(speed_mm_s, force_n)
}

/// The attributes of a texture.
#[must_use]
pub fn of(texture: &TextureModel) -> Attributes {
    Meter::default().of(texture)
}

/// Takes the attributes of one texture after the other. What depends on a sample rate alone is
/// computed when the rate changes.
#[derive(Debug, Clone, Default)]
pub struct Meter {
    /// The band of the last texture's models, by their rate.
    vibration: Option<(f64, Option<VibrationBand>)>,
    /// The band of the last texture's taps, by their rate.
    taps: Option<(f64, TraceBand)>,
}

impl Meter {
    /// The attributes of a texture.
    #[must_use]
    pub fn of(&mut self, texture: &TextureModel) -> Attributes {
        let vibration = self.vibration(&texture.grid);
        let hard_hz = self.hard_hz(&texture.taps);
        Attributes::of_parts(vibration, hard_hz, texture.friction.mu)
    }

    /// The vibration of a grid at its [stated stroke](stroke); `None` where it is silent.
    #[must_use]
    pub fn vibration(&mut self, grid: &ModelGrid) -> Option<Vibration> {
        let rate_hz = grid.sample_rate_hz;
        if self.vibration.as_ref().is_none_or(|(of, _)| *of != rate_hz) {
            self.vibration = Some((rate_hz, VibrationBand::new(rate_hz)));
        }
        let (_, band) = self.vibration.as_ref()?;
        let place = place(grid)?;
        // The cosines of the three models that are mixed, and of no other one.
        let around = ModelGrid {
            vertices: place.vertices.map(|v| grid.vertices[v].clone()).into(),
            triangles: Vec::new(),
            ..*grid
        };
        let weights = place.weights;
        let vertices = [0, 1, 2];
        let model = Field::new(&around).model(&BarycentricPoint { vertices, weights });
        band.as_ref()?.vibration(&model)
    }

    /// The centroid of a bank's fastest trace, Hz; `None` without one, or at too low a rate.
    #[must_use]
    pub fn hard_hz(&mut self, taps: &TapBank) -> Option<f64> {
        let rate_hz = taps.sample_rate_hz;
        let fastest = taps.traces.last()?;
        if rate_hz.is_nan() || rate_hz < MIN_TAP_RATE_HZ {
            return None;
        }
        if self.taps.as_ref().is_none_or(|(of, _)| *of != rate_hz) {
            self.taps = Some((rate_hz, TraceBand::new(rate_hz)));
        }
        let (_, band) = self.taps.as_ref()?;
        band.centroid_hz(&fastest.accel_m_s2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        model::{GridVertex, Numerator, VertexKind},
        signal::spectrum::ArmaModel,
    };

    /// A grid of 200 mm/s and 2 N whose four corners differ.
    fn corners() -> ModelGrid {
        let vertex = |speed_mm_s, force_n, lsf_rad: [f64; 2], sigma_m_s2| GridVertex {
            speed_mm_s,
            force_n,
            kind: VertexKind::Interior,
            lsf_rad: lsf_rad.to_vec(),
            ma_lsf_rad: None,
            gain: 1.0,
            sigma_m_s2,
        };
        ModelGrid {
            sample_rate_hz: 1000.0,
            order: 2,
            numerator: Numerator::Nyquist,
            vertices: vec![
                vertex(0.0, 0.0, [0.4, 0.9], 0.1),
                vertex(200.0, 0.0, [0.9, 1.4], 1.0),
                vertex(0.0, 2.0, [0.6, 2.1], 0.3),
                vertex(200.0, 2.0, [1.2, 2.4], 4.0),
            ],
            triangles: vec![[0, 1, 3], [0, 3, 2]],
        }
    }

    fn at_the_stroke(grid: &ModelGrid) -> Vibration {
        Meter::default().vibration(grid).expect("it sounds")
    }

    #[test]
    fn where_vertices_lie_does_not_count() {
        let plain = corners();
        let expected = at_the_stroke(&plain);
        // A vertex that says what is mixed there anyway, in every triangle.
        for (speed_mm_s, force_n) in [(120.0, 0.5), (40.0, 1.1), (150.0, 1.2)] {
            let field = Field::new(&plain);
            let place = field.locate(speed_mm_s, force_n).expect("a triangle");
            let mixture = field.mixture(&place);
            let mut finer = plain.clone();
            let new = finer.vertices.len();
            finer.vertices.push(GridVertex {
                speed_mm_s,
                force_n,
                lsf_rad: mixture.ar_cosines.iter().map(|&c| libm::acos(c)).collect(),
                sigma_m_s2: mixture.level_m_s2,
                ..plain.vertices[0].clone()
            });
            let whole = |t: &[usize; 3]| t.iter().all(|v| place.vertices.contains(v));
            finer.triangles.retain(|triangle| !whole(triangle));
            for k in 0..3 {
                let (a, b) = (place.vertices[k], place.vertices[(k + 1) % 3]);
                finer.triangles.push([a, b, new]);
            }
            let found = at_the_stroke(&finer);
            assert!((found.power / expected.power - 1.0).abs() < 1e-9);
            assert!((found.centroid_hz / expected.centroid_hz - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_grid_that_ends_before_is_described_at_its_border() {
        let mut small = corners();
        for vertex in &mut small.vertices {
            vertex.speed_mm_s *= 0.25;
            vertex.force_n *= 0.25;
        }
        assert_eq!(stroke(&small), (50.0, 0.5));
        let fastest = ArmaModel::at_vertex(&small, &small.vertices[3]);
        let expected = fastest.vibration().expect("it sounds");
        let found = at_the_stroke(&small);
        assert!((found.power / expected.power - 1.0).abs() < 1e-9);
    }

    #[test]
    fn silence_there_is_undefined() {
        let mut silent = corners();
        silent.vertices[0].sigma_m_s2 = 0.0;
        silent.vertices[3].sigma_m_s2 = 0.0;
        assert_eq!(Meter::default().vibration(&silent), None);
    }
}

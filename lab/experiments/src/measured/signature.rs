//! The band levels that a prediction is judged by.

use asperity::{
    model::{ModelGrid, mixture::Field},
    signal::spectrum::ArmaModel,
};
use std::array;

/// Speeds of the strokes, mm/s.
pub const SPEEDS_MM_S: [f64; 3] = [50.0, 100.0, 150.0];
/// Forces of the strokes, N.
pub const FORCES_N: [f64; 3] = [0.5, 1.0, 2.0];
/// Strokes: every speed at every force.
pub const STROKES: usize = SPEEDS_MM_S.len() * FORCES_N.len();
/// Third octaves, 31.5 to 400 Hz.
pub const BANDS: usize = 12;
/// The stroke at 100 mm/s and 1 N.
pub const MIDDLE: usize = 4;
/// Number of the lowest third octave: its centre is 10^(n/10) Hz (IEC 61260-1).
const LOWEST: usize = 15;
/// Spacing of the frequencies that powers are summed over, Hz.
const STEP_HZ: f64 = 0.5;
/// Level of a silent band, dB.
const SILENT_DB: f64 = -90.0;

/// Centre of a third octave, Hz.
#[must_use]
pub fn centre_hz(band: usize) -> f64 {
    libm::exp10((LOWEST + band) as f64 / 10.0)
}

/// Level of each third octave in each stroke, dB re 1 (m/s²)²; strokes by speed, then force.
#[derive(Debug, Clone, PartialEq)]
pub struct Signature(pub [[f64; BANDS]; STROKES]);

/// Differences between two signatures, dB.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// RMS over strokes and bands.
    pub whole_db: f64,
    /// Mean over strokes of the absolute difference of the whole band's level.
    pub level_db: f64,
    /// RMS over strokes and bands without the difference of the whole band's level in each stroke.
    pub shape_db: f64,
}

impl Signature {
    /// The signature of a grid as the runtime mixes it. A stroke beyond the grid's rectangle is moved to its border.
    #[must_use]
    pub fn of(grid: &ModelGrid) -> Self {
        let field = Field::new(grid);
        Self(array::from_fn(|stroke| {
            let (speed, force) = (stroke / FORCES_N.len(), stroke % FORCES_N.len());
            let place = field.locate(SPEEDS_MM_S[speed], FORCES_N[force]);
            place.map_or([SILENT_DB; BANDS], |place| bands(&field.model(&place)))
        }))
    }

    /// The mean of some signatures, dB by dB; `None` of none.
    pub fn mean<'a>(signatures: impl IntoIterator<Item = &'a Self>) -> Option<Self> {
        let (mut sum, mut count) = ([[0.0; BANDS]; STROKES], 0.0);
        for Self(levels) in signatures {
            for (sum, level) in sum.as_flattened_mut().iter_mut().zip(levels.as_flattened()) {
                *sum += level;
            }
            count += 1.0;
        }
        (count > 0.0).then(|| Self(sum.map(|stroke| stroke.map(|level| level / count))))
    }

    /// Level of the whole band in a stroke, dB re 1 (m/s²)².
    #[must_use]
    pub fn level_db(&self, stroke: usize) -> f64 {
        let power: f64 = self.0[stroke].iter().map(|db| libm::exp10(db / 10.0)).sum();
        10.0 * libm::log10(power)
    }

    /// Rise of the level from the least to the largest force at 100 mm/s, dB.
    #[must_use]
    pub fn over_force_db(&self) -> f64 {
        self.level_db(MIDDLE + 1) - self.level_db(MIDDLE - 1)
    }

    /// Rise of the level from the least to the largest speed at 1 N, dB.
    #[must_use]
    pub fn over_speed_db(&self) -> f64 {
        let forces = FORCES_N.len();
        self.level_db(MIDDLE + forces) - self.level_db(MIDDLE - forces)
    }

    /// The differences from another signature.
    #[must_use]
    pub fn difference(&self, other: &Self) -> Difference {
        let (mut whole, mut shape, mut level) = (0.0, 0.0, 0.0);
        for stroke in 0..STROKES {
            let apart: [f64; BANDS] = array::from_fn(|n| self.0[stroke][n] - other.0[stroke][n]);
            let level_db = self.level_db(stroke) - other.level_db(stroke);
            whole += apart.iter().map(|x| x * x).sum::<f64>();
            shape += (apart.iter())
                .map(|x| (x - level_db) * (x - level_db))
                .sum::<f64>();
            level += level_db.abs();
        }
        let cells = (STROKES * BANDS) as f64;
        Difference {
            whole_db: (whole / cells).sqrt(),
            level_db: level / STROKES as f64,
            shape_db: (shape / cells).sqrt(),
        }
    }
}

/// Level of each third octave, dB re 1 (m/s²)².
fn bands(model: &ArmaModel) -> [f64; BANDS] {
    array::from_fn(|band| {
        let (centre_hz, half) = (centre_hz(band), libm::exp10(0.05));
        let (from_hz, to_hz) = (centre_hz / half, centre_hz * half);
        let steps = ((to_hz - from_hz) / STEP_HZ).ceil();
        let width_hz = (to_hz - from_hz) / steps;
        let powers =
            (0..steps as usize).map(|n| model.power(from_hz + (n as f64 + 0.5) * width_hz));
        // One-sided density 2·S/fs, integrated.
        let power = powers.sum::<f64>() * width_hz * 2.0 / model.sample_rate_hz;
        (10.0 * libm::log10(power)).max(SILENT_DB)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::model::{GridVertex, Numerator, VertexKind};

    /// The same model in every stroke, excited with 2 m/s².
    fn uniform() -> ModelGrid {
        let corner = |speed_mm_s, force_n| GridVertex {
            speed_mm_s,
            force_n,
            kind: VertexKind::Edge,
            lsf_rad: vec![
                std::f64::consts::FRAC_PI_3,
                2.0 * std::f64::consts::FRAC_PI_3,
            ],
            ma_lsf_rad: None,
            gain: 1.0,
            sigma_m_s2: 2.0,
        };
        ModelGrid {
            sample_rate_hz: 1000.0,
            order: 2,
            numerator: Numerator::None,
            vertices: vec![
                corner(0.0, 0.0),
                corner(200.0, 0.0),
                corner(200.0, 3.0),
                corner(0.0, 3.0),
            ],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
        }
    }

    #[test]
    fn white_noise_has_the_width_of_a_band_as_its_power() {
        let grid = uniform();
        let field = Field::new(&grid);
        let place = field.locate(100.0, 1.0).expect("a triangle");
        let flat = ArmaModel {
            a: vec![1.0],
            ..field.model(&place)
        };
        for (band, db) in bands(&flat).into_iter().enumerate() {
            let width_hz = centre_hz(band) * (libm::exp10(0.05) - libm::exp10(-0.05));
            let expected = 10.0 * libm::log10(4.0 * width_hz / 500.0);
            assert!((db - expected).abs() < 1e-9, "{band}: {db} {expected}");
        }
    }

    #[test]
    fn a_gain_is_a_level_and_no_shape() {
        let quiet = uniform();
        let mut loud = uniform();
        loud.vertices.iter_mut().for_each(|v| v.gain = 10.0);
        let apart = Signature::of(&quiet).difference(&Signature::of(&loud));
        assert!((apart.whole_db - 20.0).abs() < 1e-9 && (apart.level_db - 20.0).abs() < 1e-9);
        assert!(apart.shape_db < 1e-9);
    }

    #[test]
    fn octaves_are_named_as_the_standard_names_them() {
        let named = [
            31.5, 40.0, 50.0, 63.0, 80.0, 100.0, 125.0, 160.0, 200.0, 250.0, 315.0, 400.0,
        ];
        for (band, named_hz) in named.into_iter().enumerate() {
            assert!((centre_hz(band) / named_hz - 1.0).abs() < 0.02);
        }
    }
}

//! Statistics of a whole texture, by which the generator is calibrated.

use crate::{Corpus, Instance};
use asperity::level::nyquist_rms;
use asperity::{
    model::{GridVertex, ModelGrid, Numerator, VertexKind},
    reflection,
    spectrum::{ArmaModel, VIBRATION_FLOOR_HZ},
};

/// Names and units of [`Statistics::values`].
pub const NAMES: [&str; 8] = [
    "level, dB re 1 m/s²",
    "level at 100 mm/s and 1 N, dB re 1 m/s²",
    "speed exponent",
    "force exponent",
    "spectral centroid, Hz",
    "bandwidth, Hz",
    "largest pole radius",
    "μ",
];

/// Statistics of one texture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statistics {
    /// In the order of [`NAMES`].
    pub values: [f64; 8],
}

/// Statistics over the interior vertices of a grid that vibrate.
///
/// `None` for fewer than four, which do not determine the exponents.
#[must_use]
pub fn of_grid(grid: &ModelGrid, mu: f64) -> Option<Statistics> {
    let mut rows = Vec::new();
    let mut radius = 0.0_f64;
    for vertex in &grid.vertices {
        let placed = vertex.speed_mm_s > 0.0 && vertex.force_n > 0.0;
        if vertex.kind != VertexKind::Interior || vertex.sigma_m_s2 <= 0.0 || !placed {
            continue;
        }
        let model = ArmaModel::at_vertex(grid, vertex);
        let (level_db, centroid_hz, bandwidth_hz) = moments(&model);
        radius = radius.max(pole_radius(&model.a));
        rows.push([
            libm::log10(vertex.speed_mm_s / 100.0) * 20.0,
            libm::log10(vertex.force_n) * 20.0,
            level_db,
            centroid_hz,
            bandwidth_hz,
        ]);
    }
    if rows.len() < 4 {
        return None;
    }
    let mean = |k: usize| rows.iter().map(|row| row[k]).sum::<f64>() / rows.len() as f64;
    let (speed_exponent, force_exponent) = exponents(&rows);
    Some(Statistics {
        values: [
            mean(2),
            mean(2) - speed_exponent * mean(0) - force_exponent * mean(1),
            speed_exponent,
            force_exponent,
            mean(3),
            mean(4),
            radius,
            mu,
        ],
    })
}

/// The grid of an instance, for queries as of a texture.
#[must_use]
pub fn grid_of(instance: &Instance, corpus: &Corpus) -> ModelGrid {
    let vertices = corpus
        .grid
        .bins
        .iter()
        .enumerate()
        .map(|(bin, place)| {
            let lsf_rad: Vec<f64> = instance.lsf_rad[bin]
                .iter()
                .map(|&x| f64::from(x))
                .collect();
            let rms = libm::exp10(f64::from(instance.level_db[bin]) / 20.0);
            GridVertex {
                speed_mm_s: place.speed_mm_s,
                force_n: place.force_n,
                kind: VertexKind::Interior,
                sigma_m_s2: rms / nyquist_rms(&lsf_rad),
                lsf_rad,
                ma_lsf_rad: None,
                gain: 1.0,
            }
        })
        .collect();
    ModelGrid {
        sample_rate_hz: crate::SAMPLE_RATE_HZ,
        order: crate::ORDER,
        numerator: Numerator::Nyquist,
        vertices,
        triangles: Vec::new(),
    }
}

/// Level, centroid and bandwidth (its standard deviation) above 40 Hz.
fn moments(model: &ArmaModel) -> (f64, f64, f64) {
    const STEPS: usize = 460;
    let width = (0.5 * model.sample_rate_hz - VIBRATION_FLOOR_HZ) / STEPS as f64;
    let (mut sum, mut first, mut second) = (0.0, 0.0, 0.0);
    for step in 0..STEPS {
        let freq_hz = VIBRATION_FLOOR_HZ + (step as f64 + 0.5) * width;
        let power = model.power(freq_hz);
        sum += power;
        first += power * freq_hz;
        second += power * freq_hz * freq_hz;
    }
    let centroid = first / sum;
    let power = sum * width * 2.0 / model.sample_rate_hz;
    let variance = (second / sum - centroid * centroid).max(0.0);
    (10.0 * libm::log10(power), centroid, variance.sqrt())
}

/// Largest radius of a root of a monic polynomial: the smallest r for which A(r·z) is
/// still stable, by bisection.
fn pole_radius(monic: &[f64]) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..30 {
        let middle: f64 = 0.5 * (low + high);
        let mut scale = 1.0;
        let scaled: Vec<f64> = monic
            .iter()
            .map(|a| {
                let value = a * scale;
                scale /= middle;
                value
            })
            .collect();
        if reflection::step_down(&scaled).is_some() {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// Least squares of level over 20·log₁₀ of speed and force.
fn exponents(rows: &[[f64; 5]]) -> (f64, f64) {
    let mean = |k: usize| rows.iter().map(|row| row[k]).sum::<f64>() / rows.len() as f64;
    let means = [mean(0), mean(1), mean(2)];
    let product = |i: usize, j: usize| -> f64 {
        rows.iter()
            .map(|row| (row[i] - means[i]) * (row[j] - means[j]))
            .sum()
    };
    let (vv, ff, vf) = (product(0, 0), product(1, 1), product(0, 1));
    let determinant = vv * ff - vf * vf;
    if determinant.abs() <= f64::MIN_POSITIVE {
        return (0.0, 0.0);
    }
    (
        (product(0, 2) * ff - product(1, 2) * vf) / determinant,
        (product(1, 2) * vv - product(0, 2) * vf) / determinant,
    )
}

/// The value below which a fraction of the sorted values lies, with linear interpolation.
#[must_use]
pub fn percentile(values: &mut [f64], share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let position = share * (values.len().saturating_sub(1)) as f64;
    let below = position.floor() as usize;
    let above = (below + 1).min(values.len() - 1);
    values[below] + (position - below as f64) * (values[above] - values[below])
}

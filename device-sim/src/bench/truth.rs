//! What came back, held against the texture that was touched.

use asperity::{
    model::{ModelGrid, TapBank, TextureModel, mixture::Field},
    recording::Analysis,
    spectrum::log_spectral_distance_db,
};
use serde::Serialize;
use std::collections::BTreeMap;

use super::{perform::Performance, sensors::tap_at};

/// Size of a cell of the plane, mm/s and N, and the ticks in contact that make it visited.
const CELL: (f64, f64) = (25.0, 0.3);
const VISITED: usize = 300;
/// Slowest stroke that counts, mm/s.
const SLOWEST_MM_S: f64 = 10.0;
/// Band of taps, Hz, and how far below its strongest third octave a band still counts, dB.
const TAP_BAND_HZ: (f64, f64) = (60.0, 1600.0);
const TAP_DEPTH_DB: f64 = 20.0;

/// How far a texture is from the truth.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// RMS of the log spectra over 10–450 Hz at every visited cell, level included, dB.
    pub cells_db: Vec<f64>,
    /// Difference of the levels at every visited cell, dB.
    pub levels_db: Vec<f64>,
    /// Relative error of μ; `None` where it was not recorded.
    pub mu: Option<f64>,
    /// RMS over third octaves at every recorded impact speed, dB.
    pub taps_db: Vec<f64>,
}

/// Compares an analysis with the texture that was touched.
#[must_use]
pub fn compare(truth: &TextureModel, performance: &Performance, analysis: &Analysis) -> Comparison {
    let visits = performance.records.iter().map(|record| {
        let output = &record.output;
        (output.speed_mm_s, output.normal_force_n)
    });
    compare_at(truth, visits, analysis)
}

/// The same for the speed, mm/s, and the load, N, of every millisecond.
#[must_use]
pub fn compare_at(
    truth: &TextureModel,
    visits: impl IntoIterator<Item = (f32, f32)>,
    analysis: &Analysis,
) -> Comparison {
    let (found, exact) = (Field::new(&analysis.fit.grid), Field::new(&truth.grid));
    let (mut cells_db, mut levels_db) = (Vec::new(), Vec::new());
    for (speed_mm_s, force_n) in visited(&truth.grid, visits) {
        let at = |field: &Field<'_>| Some(field.model(&field.locate(speed_mm_s, force_n)?));
        let (Some(model), Some(true_model)) = (at(&found), at(&exact)) else {
            continue;
        };
        let (Some(level), Some(true_level)) = (model.vibration(), true_model.vibration()) else {
            continue;
        };
        cells_db.push(log_spectral_distance_db(&model, &true_model));
        levels_db.push(10.0 * libm::log10(level.power / true_level.power));
    }
    let taps_db = analysis
        .transients
        .iter()
        .filter_map(|t| tap_db(&truth.taps, t.speed_m_s, &t.accel_m_s2, 10_000.0))
        .collect();
    Comparison {
        cells_db,
        levels_db,
        mu: analysis
            .friction
            .as_ref()
            .map(|friction| friction.mu / truth.friction.mu - 1.0),
        taps_db,
    }
}

/// Middle of the visits of every cell that was visited long enough.
fn visited(grid: &ModelGrid, visits: impl IntoIterator<Item = (f32, f32)>) -> Vec<(f64, f64)> {
    let (width, height) = asperity::mesh::corner(grid);
    let mut cells: BTreeMap<(u32, u32), (usize, f64, f64)> = BTreeMap::new();
    for (speed, force) in visits {
        let (speed, force) = (f64::from(speed), f64::from(force));
        if force <= 0.0 || speed < SLOWEST_MM_S || speed > width || force > height {
            continue;
        }
        let cell = cells
            .entry(((speed / CELL.0) as u32, (force / CELL.1) as u32))
            .or_default();
        *cell = (cell.0 + 1, cell.1 + speed, cell.2 + force);
    }
    cells
        .into_values()
        .filter(|cell| cell.0 >= VISITED)
        .map(|(n, speed, force)| (speed / n as f64, force / n as f64))
        .collect()
}

/// RMS difference of the third octaves of a transient and of the truth at its speed, dB.
fn tap_db(truth: &TapBank, speed_m_s: f64, found: &[f64], rate_hz: f64) -> Option<f64> {
    let exact = third_octaves(&tap_at(truth, speed_m_s)?, truth.sample_rate_hz);
    let found = third_octaves(found, rate_hz);
    let strongest = exact.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let squares: Vec<f64> = exact
        .iter()
        .zip(&found)
        .filter(|(e, _)| **e > strongest - TAP_DEPTH_DB)
        .map(|(e, f)| (e - f).powi(2))
        .collect();
    (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}

/// Energy of a transient in third octaves over [`TAP_BAND_HZ`], dB.
fn third_octaves(trace: &[f64], rate_hz: f64) -> Vec<f64> {
    let mut bands = Vec::new();
    let mut low = TAP_BAND_HZ.0;
    while low < TAP_BAND_HZ.1 {
        let high = low * libm::cbrt(2.0);
        let energy: f64 = (0..8)
            .map(|n| {
                let omega = std::f64::consts::TAU
                    * (low + (high - low) * (f64::from(n) + 0.5) / 8.0)
                    / rate_hz;
                let (mut re, mut im) = (0.0, 0.0);
                for (k, x) in trace.iter().enumerate() {
                    let (sin, cos) = libm::sincos(omega * k as f64);
                    re += x * cos;
                    im += x * sin;
                }
                (re * re + im * im) / (rate_hz * rate_hz)
            })
            .sum();
        bands.push(10.0 * libm::log10((energy / 8.0).max(1e-30)));
        low = high;
    }
    bands
}

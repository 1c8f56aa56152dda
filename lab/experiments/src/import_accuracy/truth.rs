//! Comparison of an imported texture with the one that was touched.

use asperity::{
    model::{ModelGrid, TapBank, TextureModel, mixture::Field},
    signal::spectrum::log_spectral_distance_db,
    sources::recording::Analysis,
};
use serde::Serialize;
use std::collections::BTreeMap;

use asperity_recording::timeline::RATE_HZ;

use super::{
    perform::Performance,
    sensors::{Sensors, tap_at},
};

/// Size of a cell of the plane, mm/s and N, and the ticks in contact that make it visited.
const CELL: (f64, f64) = (25.0, 0.3);
const VISITED: usize = 300;
/// Slowest stroke that counts, mm/s.
const SLOWEST_MM_S: f64 = 10.0;
/// Band of taps, Hz, and how far below its strongest third octave a band still counts, dB.
const TAP_BAND_HZ: (f64, f64) = (60.0, 1600.0);
const TAP_DEPTH_DB: f64 = 20.0;

/// A visited part of the plane, and how far the texture is from the truth in the middle of its visits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Cell {
    /// Mean speed of the visits, mm/s.
    pub speed_mm_s: f64,
    /// Mean force of the visits, N.
    pub force_n: f64,
    /// Time in contact, s.
    pub seconds: f64,
    /// Time in strokes that the import used, s.
    pub used_s: f64,
    /// True level over the noise of the accelerometer's three axes, dB.
    pub over_noise_db: f64,
    /// RMS of the log spectra over 10–450 Hz, level included, dB.
    pub error_db: f64,
    /// Level found over the true one, dB.
    pub level_db: f64,
}

/// Errors of a texture against the truth.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// Every visited cell.
    pub cells: Vec<Cell>,
    /// Relative error of μ; `None` where it was not recorded.
    pub mu: Option<f64>,
    /// RMS over third octaves at every recorded impact speed, dB.
    pub taps_db: Vec<f64>,
}

/// Compares an analysis with the texture that was touched by `sensors`.
#[must_use]
pub fn compare(
    truth: &TextureModel,
    performance: &Performance,
    sensors: &Sensors,
    analysis: &Analysis,
) -> Comparison {
    let visits = performance.records.iter().map(|record| {
        let output = &record.output;
        (output.speed_mm_s, output.normal_force_n)
    });
    compare_at(truth, visits, sensors.accel_noise, analysis)
}

/// The same for the speed, mm/s, and the load, N, of every millisecond, and the density of the noise
/// of each axis of the accelerometer, m/s²/√Hz.
#[must_use]
pub fn compare_at(
    truth: &TextureModel,
    visits: impl IntoIterator<Item = (f32, f32)>,
    accel_noise: f64,
    analysis: &Analysis,
) -> Comparison {
    let (found, exact) = (Field::new(&analysis.fit.grid), Field::new(&truth.grid));
    let used = used_time(analysis);
    let noise = 3.0 * accel_noise.powi(2) * 0.5 * truth.grid.sample_rate_hz;
    let mut cells = Vec::new();
    for (place, visit) in visited(&truth.grid, visits) {
        let at =
            |field: &Field<'_>| Some(field.model(&field.locate(visit.speed_mm_s, visit.force_n)?));
        let (Some(model), Some(true_model)) = (at(&found), at(&exact)) else {
            continue;
        };
        let (Some(level), Some(true_level)) = (model.vibration(), true_model.vibration()) else {
            continue;
        };
        cells.push(Cell {
            speed_mm_s: visit.speed_mm_s,
            force_n: visit.force_n,
            seconds: visit.seconds,
            used_s: used.get(&place).copied().unwrap_or(0.0),
            over_noise_db: 10.0 * libm::log10(true_level.power / noise.max(1e-30)),
            error_db: log_spectral_distance_db(&model, &true_model),
            level_db: 10.0 * libm::log10(level.power / true_level.power),
        });
    }
    let taps_db = analysis
        .transients
        .iter()
        .filter_map(|t| tap_db(&truth.taps, t.speed_m_s, &t.accel_m_s2, 10_000.0))
        .collect();
    Comparison {
        cells,
        mu: analysis
            .friction
            .as_ref()
            .map(|friction| friction.mu / truth.friction.mu - 1.0),
        taps_db,
    }
}

/// Column and row of a cell.
type CellIndex = (u32, u32);

fn place(speed_mm_s: f64, force_n: f64) -> CellIndex {
    ((speed_mm_s / CELL.0) as u32, (force_n / CELL.1) as u32)
}

/// The visits of a cell.
struct Visit {
    speed_mm_s: f64,
    force_n: f64,
    seconds: f64,
}

/// The cells that were visited long enough.
fn visited(
    grid: &ModelGrid,
    visits: impl IntoIterator<Item = (f32, f32)>,
) -> Vec<(CellIndex, Visit)> {
    let (width, height) = asperity::model::mesh::corner(grid);
    let mut cells: BTreeMap<CellIndex, (usize, f64, f64)> = BTreeMap::new();
    for (speed, force) in visits {
        let (speed, force) = (f64::from(speed), f64::from(force));
        if force <= 0.0 || speed < SLOWEST_MM_S || speed > width || force > height {
            continue;
        }
        let cell = cells.entry(place(speed, force)).or_default();
        *cell = (cell.0 + 1, cell.1 + speed, cell.2 + force);
    }
    cells
        .into_iter()
        .filter(|(_, cell)| cell.0 >= VISITED)
        .map(|(place, (n, speed, force))| {
            let visit = Visit {
                speed_mm_s: speed / n as f64,
                force_n: force / n as f64,
                seconds: n as f64 / RATE_HZ,
            };
            (place, visit)
        })
        .collect()
}

/// Time that the segments of an analysis spend in every cell, s.
fn used_time(analysis: &Analysis) -> BTreeMap<CellIndex, f64> {
    let mut cells: BTreeMap<CellIndex, f64> = BTreeMap::new();
    let mut end = 0;
    for segment in &analysis.strokes.segments {
        let last = segment.start + segment.length;
        // Neighbours overlap.
        let new = last.saturating_sub(segment.start.max(end));
        *cells
            .entry(place(segment.speed_mm_s, segment.force_n.max(0.0)))
            .or_default() += new as f64 / RATE_HZ;
        end = end.max(last);
    }
    cells
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

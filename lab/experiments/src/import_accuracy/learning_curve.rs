//! A learning curve: how well textures come back after so many seconds.

use asperity::{model::TextureModel, pipeline::Pipeline, sources::recording};
use rayon::prelude::*;
use serde::Serialize;

use super::{
    error::ImportAccuracyError,
    perform::{Strokes, Until, perform},
    sensors::{Sensors, record},
    truth::{Cell, Comparison, compare},
};

/// A texture after some seconds of strokes.
#[derive(Debug, Clone, Serialize)]
pub struct LearningCurvePoint {
    /// The texture.
    pub name: String,
    /// Seconds of strokes.
    pub seconds: f64,
    /// Errors against the truth; `None` where the import refused the recording.
    pub comparison: Option<Comparison>,
    /// Why it was refused.
    pub refused: Option<String>,
    /// Measured vertices and AR order.
    pub vertices: usize,
    /// AR order.
    pub order: usize,
}

/// Records every texture for some seconds of strokes, beside air and taps, and imports what the sensors wrote. `alter`
/// changes the usual sensors.
///
/// # Errors
/// [`ImportAccuracyError`] of the first texture that cannot be rendered or recorded.
pub fn learn(
    textures: &[TextureModel],
    strokes: Strokes,
    seconds: f64,
    seed: u64,
    alter: impl Fn(&mut Sensors) + Sync,
    done: impl Fn() + Sync,
) -> Result<Vec<LearningCurvePoint>, ImportAccuracyError> {
    textures
        .par_iter()
        .enumerate()
        .map(|(index, texture)| {
            let seed = seed.wrapping_mul(1000).wrapping_add(index as u64);
            let performance = perform(texture, strokes, Until::Strokes(seconds), seed)?;
            let folder = tempfile::tempdir()?;
            let mut sensors = Sensors::seeded(seed);
            alter(&mut sensors);
            record(&performance, texture, &sensors, seed, folder.path())?;
            let analysis = recording::analyse(folder.path(), false, &mut Pipeline::default());
            done();
            Ok(match analysis {
                Ok(analysis) => LearningCurvePoint {
                    name: texture.name.clone(),
                    seconds,
                    comparison: Some(compare(texture, &performance, &sensors, &analysis)),
                    refused: None,
                    vertices: analysis.fit.facts.len(),
                    order: analysis.fit.chosen.order,
                },
                Err(error) => LearningCurvePoint {
                    name: texture.name.clone(),
                    seconds,
                    comparison: None,
                    refused: Some(error.to_string()),
                    vertices: 0,
                    order: 0,
                },
            })
        })
        .collect()
}

/// Largest error that a cell should have, dB RMS.
pub const GOAL_DB: f64 = 3.0;
/// Power over the noise of the accelerometer's three axes from which a cell counts as loud, dB.
pub const LOUD_DB: f64 = 10.0;

/// Figures over all textures of one length.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Figures {
    /// Seconds of strokes.
    pub seconds: f64,
    /// Textures that came back.
    pub imported: usize,
    /// Textures that were refused.
    pub refused: usize,
    /// Median and 95 % quantile over textures of the mean over their cells, dB RMS.
    pub texture_db: (f64, f64),
    /// Median over textures of their median cell, dB RMS.
    pub median_db: f64,
    /// Visited cells of all textures.
    pub cells: usize,
    /// 95 % quantile over all cells, dB RMS.
    pub p95_db: f64,
    /// Cells within [`GOAL_DB`], percent.
    pub within_percent: f64,
    /// Cells at least [`LOUD_DB`] over the accelerometer's noise, percent.
    pub loud_percent: f64,
    /// 95 % quantile over these, dB RMS.
    pub loud_p95_db: f64,
    /// Median over textures of the mean size of the level's error, dB.
    pub level_db: f64,
    /// 95 % quantile over all cells of the same, dB.
    pub level_p95_db: f64,
    /// Median and 95 % quantile of the error of μ, percent.
    pub mu_percent: (f64, f64),
    /// Median and 95 % quantile of the taps, dB RMS over third octaves.
    pub taps_db: (f64, f64),
    /// Median number of measured vertices.
    pub vertices: f64,
}

/// The figures of rows of one length.
#[must_use]
pub fn summary(rows: &[LearningCurvePoint]) -> Figures {
    use asperity_recording::signal::quantile::{mean, median, quantile};
    let came: Vec<&Comparison> = rows
        .iter()
        .filter_map(|row| row.comparison.as_ref())
        .collect();
    let levels = |c: &Comparison| {
        c.cells
            .iter()
            .map(|c| c.level_db.abs())
            .collect::<Vec<f64>>()
    };
    let both = |values: Vec<f64>| {
        (
            median(values.iter().copied()),
            quantile(values.iter().copied(), 0.95),
        )
    };
    let cells: Vec<Cell> = came.iter().flat_map(|c| c.cells.iter().copied()).collect();
    let loud: Vec<f64> = cells
        .iter()
        .filter(|c| c.over_noise_db >= LOUD_DB)
        .map(|c| c.error_db)
        .collect();
    let within = cells.iter().filter(|c| c.error_db <= GOAL_DB).count();
    let percent = |part: usize| 100.0 * part as f64 / cells.len().max(1) as f64;
    Figures {
        seconds: rows.first().map_or(0.0, |row| row.seconds),
        imported: came.len(),
        refused: rows.len() - came.len(),
        texture_db: both(
            came.iter()
                .map(|c| mean(&c.cells.iter().map(|c| c.error_db).collect::<Vec<f64>>()))
                .collect(),
        ),
        median_db: median(
            came.iter()
                .map(|c| median(c.cells.iter().map(|c| c.error_db))),
        ),
        cells: cells.len(),
        p95_db: quantile(cells.iter().map(|c| c.error_db), 0.95),
        within_percent: percent(within),
        loud_percent: percent(loud.len()),
        loud_p95_db: quantile(loud, 0.95),
        level_db: median(came.iter().map(|c| mean(&levels(c)))),
        level_p95_db: quantile(came.iter().flat_map(|c| levels(c)), 0.95),
        mu_percent: both(
            came.iter()
                .filter_map(|c| c.mu)
                .map(|mu| 100.0 * mu.abs())
                .collect(),
        ),
        taps_db: both(
            came.iter()
                .flat_map(|c| c.taps_db.iter().copied())
                .collect(),
        ),
        vertices: median(
            rows.iter()
                .filter(|row| row.comparison.is_some())
                .map(|row| row.vertices as f64),
        ),
    }
}

//! Trends over all materials: spectra, slopes over force and speed, friction. Of a small folder it is not reported,
//! because a mean over a few materials would reveal each.

use super::{
    material::{Material, Vibration},
    score::{Figure, figure, names},
    signature::{BANDS, MIDDLE, centre_hz},
};
use asperity::signal::quantile::{mean, median, rank_correlation};
use serde::Serialize;
use std::array;

/// Fewest materials that a trend is reported of.
pub const FEWEST: usize = 20;

/// Mean and standard deviation over materials.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub deviation: f64,
}

/// The same figure of measured models and of what is predicted of them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Beside<T> {
    /// Measured.
    pub measured: T,
    /// Compiled by name.
    pub compiled: T,
    /// By the generator, names left out; `None` where fewer than [`FEWEST`] are known to it.
    pub generated: Option<T>,
}

/// Trends over all materials.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Trends {
    /// Centre of each third octave, Hz.
    pub bands_hz: [f64; BANDS],
    /// Mean level of each at 100 mm/s and 1 N, dB re 1 (m/s²)².
    pub spectrum_db: Beside<[f64; BANDS]>,
    /// Level of the whole band there.
    pub level_db: Beside<Spread>,
    /// Rise of that level from 0.5 to 2 N.
    pub over_force_db: Beside<Spread>,
    /// Rise of that level from 50 to 150 mm/s.
    pub over_speed_db: Beside<Spread>,
    /// Friction.
    pub friction: Friction,
}

/// Errors of μ.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Friction {
    /// Median of μ.
    pub mu: Beside<f64>,
    /// Mean of |Δμ|.
    pub error: Errors,
    /// Spearman's rank correlation with the measured μ.
    pub correlation: Errors,
}

/// A figure of each prediction of μ.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Errors {
    /// By the prompt.
    pub prompt: Figure,
    /// By the generator, names left out.
    pub generated: Option<Figure>,
    /// By a constant, the median of all materials of other names.
    pub constant: Option<Figure>,
}

/// The trends; `None` of fewer than [`FEWEST`] materials.
#[must_use]
pub fn trends(materials: &[Material]) -> Option<Trends> {
    if materials.len() < FEWEST {
        return None;
    }
    let known: Vec<&Vibration> = (materials.iter())
        .filter_map(|m| m.generated.as_ref()?.left_out.as_ref())
        .collect();
    let beside = Columns {
        measured: materials.iter().map(|m| &m.measured).collect(),
        compiled: materials.iter().map(|m| &m.compiled).collect(),
        generated: (known.len() >= FEWEST).then_some(known),
    };
    let spread_of = |of: fn(&Vibration) -> f64| beside.each(|all| spread(&each(all, of)));
    Some(Trends {
        bands_hz: array::from_fn(centre_hz),
        spectrum_db: beside
            .each(|all| array::from_fn(|band| mean(&each(all, |v| v.signature.0[MIDDLE][band])))),
        level_db: spread_of(|v| v.signature.level_db(MIDDLE)),
        over_force_db: spread_of(|v| v.signature.over_force_db()),
        over_speed_db: spread_of(|v| v.signature.over_speed_db()),
        friction: friction(materials, &beside),
    })
}

/// The textures to compare.
struct Columns<'a> {
    measured: Vec<&'a Vibration>,
    compiled: Vec<&'a Vibration>,
    generated: Option<Vec<&'a Vibration>>,
}

impl Columns<'_> {
    fn each<T>(&self, of: impl Fn(&[&Vibration]) -> T) -> Beside<T> {
        Beside {
            measured: of(&self.measured),
            compiled: of(&self.compiled),
            generated: self.generated.as_deref().map(of),
        }
    }
}

fn friction(materials: &[Material], beside: &Columns<'_>) -> Friction {
    let constant = |of: &Material| {
        let others = materials.iter().filter(|m| m.prompt != of.prompt);
        median(others.map(|m| m.measured.mu))
    };
    // Measured and predicted.
    let rows = |predicted: &dyn Fn(&Material) -> Option<f64>| -> Vec<(usize, [f64; 2])> {
        (names(materials).into_iter().zip(materials))
            .filter_map(|(name, m)| Some((name, [m.measured.mu, predicted(m)?])))
            .collect()
    };
    let prompt = rows(&|m| Some(m.compiled.mu));
    let generated = (beside.generated.as_ref())
        .map(|_| rows(&|m| Some(m.generated.as_ref()?.left_out.as_ref()?.mu)));
    Friction {
        mu: beside.each(|all| median(each(all, |v| v.mu))),
        error: Errors {
            prompt: mean_error(&prompt),
            generated: generated.as_deref().map(mean_error),
            constant: Some(mean_error(&rows(&|m| Some(constant(m))))),
        },
        correlation: Errors {
            prompt: correlation(&prompt),
            generated: generated.as_deref().map(correlation),
            constant: None,
        },
    }
}

fn mean_error(rows: &[(usize, [f64; 2])]) -> Figure {
    figure(
        rows,
        |row| row.0,
        |some| {
            let errors = some
                .iter()
                .map(|(_, [measured, found])| (measured - found).abs());
            mean(&errors.collect::<Vec<_>>())
        },
    )
}

fn correlation(rows: &[(usize, [f64; 2])]) -> Figure {
    figure(
        rows,
        |row| row.0,
        |some| {
            let column = |n: usize| some.iter().map(|row| row.1[n]).collect::<Vec<_>>();
            rank_correlation(&column(0), &column(1)).unwrap_or_default()
        },
    )
}

fn each(all: &[&Vibration], of: impl Fn(&Vibration) -> f64) -> Vec<f64> {
    all.iter().map(|vibration| of(vibration)).collect()
}

fn spread(values: &[f64]) -> Spread {
    let mean = mean(values);
    let square = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>();
    Spread {
        mean,
        deviation: (square / values.len() as f64).sqrt(),
    }
}

//! Trends over all materials: spectra, slopes over force and speed, friction. Of a small folder it is not reported,
//! because a mean over a few materials would reveal each.

use super::{
    material::{Material, Vibration},
    score::{Figure, figure, names},
    signature::{BANDS, MIDDLE, centre_hz},
};
use asperity_recording::signal::quantile::{mean, median};
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

/// The same figure of measured models and of the textures of their names.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Both<T> {
    /// Measured.
    pub measured: T,
    /// Compiled by name.
    pub compiled: T,
}

/// Trends over all materials.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Trends {
    /// Centre of each third octave, Hz.
    pub bands_hz: [f64; BANDS],
    /// Mean level of each at 100 mm/s and 1 N, dB re 1 (m/s²)².
    pub spectrum_db: Both<[f64; BANDS]>,
    /// Level of the whole band there.
    pub level_db: Both<Spread>,
    /// Rise of that level from 0.5 to 2 N.
    pub over_force_db: Both<Spread>,
    /// Rise of that level from 50 to 150 mm/s.
    pub over_speed_db: Both<Spread>,
    /// Friction.
    pub friction: Friction,
}

/// Errors of μ.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Friction {
    /// Median of μ.
    pub mu: Both<f64>,
    /// Mean of |Δμ| by the prompt.
    pub prompt: Figure,
    /// The same of a constant: the median of all materials of other names.
    pub constant: Figure,
    /// Spearman's rank correlation of the prompt's μ with the measured one.
    pub correlation: Figure,
}

/// The trends; `None` of fewer than [`FEWEST`] materials.
#[must_use]
pub fn trends(materials: &[Material]) -> Option<Trends> {
    if materials.len() < FEWEST {
        return None;
    }
    let spectrum = |of: &dyn Fn(&Material) -> &Vibration| {
        array::from_fn(|band| mean(&each(materials, |m| of(m).signature.0[MIDDLE][band])))
    };
    let both = |of: fn(&Vibration) -> f64| Both {
        measured: spread(&each(materials, |m| of(&m.measured))),
        compiled: spread(&each(materials, |m| of(&m.compiled))),
    };
    Some(Trends {
        bands_hz: array::from_fn(centre_hz),
        spectrum_db: Both {
            measured: spectrum(&|m| &m.measured),
            compiled: spectrum(&|m| &m.compiled),
        },
        level_db: both(|v| v.signature.level_db(MIDDLE)),
        over_force_db: both(|v| v.signature.over_force_db()),
        over_speed_db: both(|v| v.signature.over_speed_db()),
        friction: friction(materials),
    })
}

fn friction(materials: &[Material]) -> Friction {
    let constant = |of: &Material| {
        let others = materials.iter().filter(|m| m.prompt != of.prompt);
        median(others.map(|m| m.measured.mu))
    };
    let rows: Vec<(usize, [f64; 3])> = names(materials)
        .into_iter()
        .zip(materials)
        .map(|(name, m)| (name, [m.measured.mu, m.compiled.mu, constant(m)]))
        .collect();
    let of = |statistic: &dyn Fn(&[[f64; 3]]) -> f64| {
        figure(
            &rows,
            |row| row.0,
            |some| statistic(&some.iter().map(|row| row.1).collect::<Vec<_>>()),
        )
    };
    let error = |column: usize| {
        of(&move |rows| {
            let errors: Vec<f64> = rows.iter().map(|mu| (mu[column] - mu[0]).abs()).collect();
            mean(&errors)
        })
    };
    Friction {
        mu: Both {
            measured: median(rows.iter().map(|row| row.1[0])),
            compiled: median(rows.iter().map(|row| row.1[1])),
        },
        prompt: error(1),
        constant: error(2),
        correlation: of(&|rows| {
            let column = |n: usize| rows.iter().map(|mu| mu[n]).collect::<Vec<_>>();
            rank_correlation(&column(0), &column(1))
        }),
    }
}

fn each(materials: &[Material], of: impl Fn(&Material) -> f64) -> Vec<f64> {
    materials.iter().map(of).collect()
}

fn spread(values: &[f64]) -> Spread {
    let mean = mean(values);
    let square = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>();
    Spread {
        mean,
        deviation: (square / values.len() as f64).sqrt(),
    }
}

/// Spearman's ρ: the correlation of mid-ranks.
fn rank_correlation(x: &[f64], y: &[f64]) -> f64 {
    let ranks = |of: &[f64]| -> Vec<f64> {
        let below = |x: &f64, or_equal: bool| {
            let count = of
                .iter()
                .filter(|y| *y < x || (or_equal && *y == x))
                .count();
            count as f64
        };
        of.iter()
            .map(|x| 0.5 * (below(x, false) + below(x, true)))
            .collect()
    };
    let (x, y) = (ranks(x), ranks(y));
    let (of_x, of_y) = (spread(&x), spread(&y));
    let along: f64 = (x.iter().zip(&y))
        .map(|(x, y)| (x - of_x.mean) * (y - of_y.mean))
        .sum();
    along / (x.len() as f64 * of_x.deviation * of_y.deviation)
}

#[cfg(test)]
mod tests {
    use super::rank_correlation;

    #[test]
    fn any_rising_law_has_the_rank_correlation_one() {
        let x: [f64; 5] = [3.0, 1.0, 4.0, 1.5, 9.0];
        assert!((rank_correlation(&x, &x.map(|x| x * x * x)) - 1.0).abs() < 1e-12);
        assert!((rank_correlation(&x, &x.map(|x| -x)) + 1.0).abs() < 1e-12);
        // Ties share their mean rank.
        let tied = rank_correlation(&[1.0, 2.0, 3.0], &[1.0, 2.0, 2.0]);
        assert!((tied - 0.75_f64.sqrt()).abs() < 1e-12, "{tied}");
    }
}

//! Summaries of numbers.

use serde::{Deserialize, Serialize};

/// A mean and how far values lie about it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Their mean.
    pub mean: f64,
    /// Their standard deviation (n − 1); zero for fewer than two.
    pub deviation: f64,
}

impl Spread {
    /// Computes the spread of values; zero for none.
    #[must_use]
    pub fn of(values: &[f64]) -> Self {
        let centre = mean(values);
        let square: f64 = values.iter().map(|x| (x - centre) * (x - centre)).sum();
        let deviation = if values.len() < 2 {
            0.0
        } else {
            (square / (values.len() - 1) as f64).sqrt()
        };
        Self {
            mean: centre,
            deviation,
        }
    }
}

/// A proportion, with Wilson's 95 % interval.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Share {
    /// Successes.
    pub hits: usize,
    /// Trials.
    pub of: usize,
    /// Successes over trials; zero without a trial.
    pub share: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

impl Share {
    /// Counts.
    #[must_use]
    pub fn of(trials: impl IntoIterator<Item = bool>) -> Self {
        let (mut hits, mut of) = (0, 0);
        for trial in trials {
            of += 1;
            hits += usize::from(trial);
        }
        if of == 0 {
            return Self {
                high: 1.0,
                ..Self::default()
            };
        }
        const Z: f64 = 1.959_964;
        let n = of as f64;
        let share = hits as f64 / n;
        let scale = 1.0 + Z * Z / n;
        let centre = (share + 0.5 * Z * Z / n) / scale;
        let reach = Z / scale * (share * (1.0 - share) / n + 0.25 * Z * Z / (n * n)).sqrt();
        Self {
            hits,
            of,
            share,
            low: (centre - reach).max(0.0),
            high: (centre + reach).min(1.0),
        }
    }
}

/// Arithmetic mean; zero for none.
pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// The middle value; zero for none.
pub(crate) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    match sorted.len() {
        0 => 0.0,
        count if count % 2 == 1 => sorted[middle],
        _ => 0.5 * (sorted[middle - 1] + sorted[middle]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilsons_interval_is_the_published_one() {
        // Newcombe (1998), table I: 81 of 263.
        let share = Share::of((0..263).map(|n| n < 81));
        assert!((share.low - 0.2553).abs() < 1e-4 && (share.high - 0.3662).abs() < 1e-4);
    }

    #[test]
    fn an_even_count_has_its_median_in_the_middle() {
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
        assert_eq!(Spread::of(&[1.0, 3.0]).deviation, 2.0_f64.sqrt());
    }
}

//! Percentiles, and the level of a model.

use asperity::signal::spectrum::ArmaModel;

/// Frequencies over which a power is summed.
const POINTS: u32 = 1024;

/// RMS of a model's vibration over all frequencies, m/s².
#[must_use]
pub fn model_rms(model: &ArmaModel) -> f64 {
    let step = 0.5 * model.sample_rate_hz / f64::from(POINTS);
    let sum: f64 = (0..POINTS)
        .map(|n| model.power((f64::from(n) + 0.5) * step))
        .sum();
    (sum / f64::from(POINTS)).sqrt()
}

/// The value that a fraction of a list does not exceed, by nearest rank.
///
/// NaN counts as the largest value. `None` for an empty list.
#[must_use]
pub fn percentile(values: &[f64], fraction: f64) -> Option<f64> {
    let mut sorted: Vec<f64> = values
        .iter()
        .map(|v| if v.is_nan() { f64::INFINITY } else { *v })
        .collect();
    sorted.sort_by(f64::total_cmp);
    let rank = (fraction * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.max(1) - 1).copied()
}

/// Median, 95th percentile and largest of some errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Half of the errors are no larger.
    pub median: f64,
    /// 95 % of the errors are no larger.
    pub p95: f64,
    /// The largest error.
    pub max: f64,
}

impl Spread {
    /// The spread of a list; `None` for an empty one.
    #[must_use]
    pub fn of(values: &[f64]) -> Option<Self> {
        Some(Self {
            median: percentile(values, 0.5)?,
            p95: percentile(values, 0.95)?,
            max: percentile(values, 1.0)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_are_nearest_and_nan_is_worst() {
        let values: Vec<f64> = (1..=100).map(f64::from).collect();
        let spread = Spread::of(&values).unwrap();
        assert_eq!((spread.median, spread.p95, spread.max), (50.0, 95.0, 100.0));
        assert_eq!(percentile(&[f64::NAN, 1.0], 1.0), Some(f64::INFINITY));
        assert_eq!(percentile(&[], 0.5), None);
    }

    #[test]
    fn white_noise_has_its_level() {
        let model = ArmaModel {
            sample_rate_hz: 1000.0,
            a: vec![1.0],
            b: vec![1.0, 1.0],
            level_m_s2: 3.0,
        };
        assert!((model_rms(&model) - 3.0 * 2.0_f64.sqrt()).abs() < 1e-9);
    }
}

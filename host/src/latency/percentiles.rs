//! Percentiles reported of a distribution.

use hdrhistogram::Histogram;
use serde::{Deserialize, Serialize};

/// Quantiles with their names in tables.
pub const QUANTILES: [(f64, &str); 6] = [
    (0.5, "50"),
    (0.9, "90"),
    (0.99, "99"),
    (0.999, "99.9"),
    (0.9999, "99.99"),
    (0.99999, "99.999"),
];

/// Returns true if `count` values support a quantile: at least one of them lies beyond it.
#[must_use]
pub fn carries(count: u64, quantile: f64) -> bool {
    // A hair less, since 1 − 0.999 is no round number.
    (1.0 - quantile) * count as f64 > 1.0 - 1e-9
}

/// Percentiles of one stage, ns. Values have three significant digits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Percentiles {
    /// Number of values, including those added to a corrected distribution.
    pub count: u64,
    /// The mean.
    pub mean: f64,
    /// Half of the values are no larger.
    pub p50: u64,
    /// 90 %.
    pub p90: u64,
    /// 99 %.
    pub p99: u64,
    /// 99.9 %; of fewer than 1,000 values the largest.
    pub p99_9: u64,
    /// 99.99 %; `None` of fewer than 10,000 values.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub p99_99: Option<u64>,
    /// 99.999 %; `None` of fewer than 100,000 values.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub p99_999: Option<u64>,
    /// The largest.
    pub max: u64,
}

impl Percentiles {
    /// Those of a histogram; all 0 of an empty one.
    #[must_use]
    pub fn of(histogram: &Histogram<u64>) -> Self {
        let [p50, p90, p99, p99_9, p99_99, p99_999] =
            QUANTILES.map(|(quantile, _)| histogram.value_at_quantile(quantile));
        let count = histogram.len();
        Self {
            count,
            mean: histogram.mean(),
            p50,
            p90,
            p99,
            p99_9,
            p99_99: carries(count, 0.9999).then_some(p99_99),
            p99_999: carries(count, 0.99999).then_some(p99_999),
            // In the resolution of the others.
            max: histogram.value_at_quantile(1.0),
        }
    }

    /// The values of [`QUANTILES`], in order; `None` where the count does not carry one.
    #[must_use]
    pub fn values(&self) -> [Option<u64>; 6] {
        let carried = |quantile, value| carries(self.count, quantile).then_some(value);
        [
            carried(0.5, self.p50),
            carried(0.9, self.p90),
            carried(0.99, self.p99),
            carried(0.999, self.p99_9),
            self.p99_99,
            self.p99_999,
        ]
    }
}

//! Which percentiles of a distribution are reported.

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

/// Percentiles of one stage, ns. Values have three significant digits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Percentiles {
    /// How many values there are; of a corrected distribution, those that were added as well.
    pub count: u64,
    /// The mean.
    pub mean: f64,
    /// Half of the values are no larger.
    pub p50: u64,
    /// 90 %.
    pub p90: u64,
    /// 99 %.
    pub p99: u64,
    /// 99.9 %.
    pub p99_9: u64,
    /// 99.99 %.
    pub p99_99: u64,
    /// 99.999 %.
    pub p99_999: u64,
    /// The largest.
    pub max: u64,
}

impl Percentiles {
    /// Those of a histogram; all 0 of an empty one.
    #[must_use]
    pub fn of(histogram: &Histogram<u64>) -> Self {
        let [p50, p90, p99, p99_9, p99_99, p99_999] =
            QUANTILES.map(|(quantile, _)| histogram.value_at_quantile(quantile));
        Self {
            count: histogram.len(),
            mean: histogram.mean(),
            p50,
            p90,
            p99,
            p99_9,
            p99_99,
            p99_999,
            // In the resolution of the others.
            max: histogram.value_at_quantile(1.0),
        }
    }

    /// The values of [`QUANTILES`], in order.
    #[must_use]
    pub fn values(&self) -> [u64; 6] {
        [
            self.p50,
            self.p90,
            self.p99,
            self.p99_9,
            self.p99_99,
            self.p99_999,
        ]
    }
}

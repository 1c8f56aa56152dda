//! Percentile distributions (`.hgrm`), as HdrHistogram's own tools plot them.

use hdrhistogram::Histogram;
use std::fmt::Write as _;

/// Steps of the percentile in each half of the distance to 100 %.
const STEPS: u32 = 5;
/// Nanoseconds of the unit of the file, µs.
const UNIT_NS: f64 = 1e3;
/// Cells of a histogram of three digits that share a power of two.
const SUB_BUCKETS: u32 = 2048;

/// The text of a `.hgrm` file; values in µs.
#[must_use]
pub fn percentile_distribution(histogram: &Histogram<u64>) -> String {
    let us = |ns: u64| ns as f64 / UNIT_NS;
    let mut text = format!(
        "{:>12} {:>14} {:>10} {:>14}\n\n",
        "Value", "Percentile", "TotalCount", "1/(1-Percentile)"
    );
    let mut total = 0;
    for step in histogram.iter_quantiles(STEPS) {
        total += step.count_since_last_iteration();
        let (value, quantile) = (us(step.value_iterated_to()), step.quantile_iterated_to());
        // Writing to a string does not fail.
        let _ = write!(text, "{value:12.3} {quantile:2.12} {total:10}");
        let _ = if quantile < 1.0 {
            writeln!(text, " {:14.2}", 1.0 / (1.0 - quantile))
        } else {
            writeln!(text)
        };
    }
    let (mean, deviation) = (histogram.mean() / UNIT_NS, histogram.stdev() / UNIT_NS);
    let _ = write!(
        text,
        "#[Mean    = {mean:12.3}, StdDeviation   = {deviation:12.3}]\n\
         #[Max     = {:12.3}, Total count    = {:12}]\n\
         #[Buckets = {:12}, SubBuckets     = {SUB_BUCKETS:12}]\n",
        us(histogram.max()),
        histogram.len(),
        histogram.buckets(),
    );
    text
}

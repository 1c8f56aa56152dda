//! The percentiles of a run as CSV: `stage,kind,percentile,value_ns`.

use asperity_host::latency::{Percentiles, QUANTILES, Run, Wakeups};
use asperity_host::servo::Stage;
use std::fmt::Write as _;

/// Every stage, raw and corrected, in the percentiles that its count carries, and cyclictest's
/// wake-ups where there are some.
#[must_use]
pub fn percentiles(run: &Run, cyclictest: Option<&Wakeups>) -> String {
    let mut text = String::from("stage,kind,percentile,value_ns\n");
    let mut rows = |stage: &str, kind: &str, percentiles: &Percentiles| {
        let values = QUANTILES.iter().zip(percentiles.values());
        let values = values.filter_map(|((_, name), value)| Some((*name, value?)));
        for (name, value) in values.chain([("max", percentiles.max)]) {
            // Writing to a string does not fail.
            let _ = writeln!(text, "{stage},{kind},{name},{value}");
        }
    };
    for stage in Stage::ALL {
        rows(stage.name(), "raw", &run.percentiles(stage));
        let corrected = Percentiles::of(&run.corrected(stage));
        rows(stage.name(), "corrected", &corrected);
    }
    if let Some(wakeups) = cyclictest {
        let mut percentiles = Percentiles::of(&wakeups.counts.histogram());
        percentiles.max = wakeups.max_ns;
        rows("wakeup", "cyclictest", &percentiles);
    }
    text
}

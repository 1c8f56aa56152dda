//! When the tool lands: the load before it is smoothed.

use crate::{signal::quantile::median, timeline::Timeline};

/// Time in the air before an impact, samples of the timeline.
const IN_AIR: usize = 40;
/// Least load of a landing, N, and the same as a multiple of the load's noise in the air.
const LEAST: (f64, f64) = (0.06, 8.0);
/// RMS of Gaussian noise over the median of its size.
const RMS_OF_MEDIAN: f64 = 1.4826;

/// Samples of the timeline at which the load begins after a time in the air.
pub(super) fn landings(timeline: &Timeline) -> Vec<usize> {
    let load = &timeline.unsmoothed_load_n;
    let in_air = || {
        load.iter()
            .zip(&timeline.contact)
            .filter(|(_, touches)| !**touches)
            .map(|(load, _)| *load)
    };
    let rest = median(in_air());
    let noise = RMS_OF_MEDIAN * median(in_air().map(|load| (load - rest).abs()));
    let threshold = rest + LEAST.0.max(LEAST.1 * noise);
    let mut air = 0;
    let mut found = Vec::new();
    for (n, &load) in load.iter().enumerate() {
        if load > threshold {
            if air >= IN_AIR && timeline.good[n] {
                found.push(n);
            }
            air = 0;
        } else {
            air += 1;
        }
    }
    found
}

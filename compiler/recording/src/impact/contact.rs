//! When the tool lands: the load before it is smoothed.

use crate::{
    signal::quantile::{RMS_OF_MEDIAN, median},
    timeline::Timeline,
};

/// Time in the air before an impact, samples of the timeline.
const IN_AIR: usize = 40;
/// Least load of a landing, N, and the same as a multiple of the load's noise in the air.
const LEAST: (f64, f64) = (0.06, 8.0);

/// Whether the load before it is smoothed shows a contact.
pub(crate) fn touches(timeline: &Timeline) -> Vec<bool> {
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
    load.iter().map(|load| *load > threshold).collect()
}

/// Samples of the timeline at which a contact begins after a time in the air.
pub(super) fn landings(timeline: &Timeline, touches: &[bool]) -> Vec<usize> {
    let mut air = 0;
    let mut found = Vec::new();
    for (n, touches) in touches.iter().enumerate() {
        if *touches {
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

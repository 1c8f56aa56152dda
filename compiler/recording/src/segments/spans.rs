//! Where the stretches lie: steady ones, those in which speed and load change, and those in the air.

use crate::timeline::Timeline;

/// Bounds on the length of a stretch and on the change of speed and load in it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    /// Shortest and longest stretch, samples.
    lengths: (usize, usize),
    /// Speed may differ from the middle of its range by this fraction, or by so many mm/s.
    speed: (f64, f64),
    /// The same of the load, N.
    load: (f64, f64),
}

/// A steady stretch.
pub(super) const STEADY: Bounds = Bounds {
    lengths: (100, 800),
    speed: (0.15, 5.0),
    load: (0.15, 0.08),
};
/// A stretch in which speed and load change. Under its window the standard deviation of a speed that changes evenly is
/// 0.28 of the fraction, so a power of v² comes out at most 0.2 dB too high.
pub(super) const CHANGING: Bounds = Bounds {
    lengths: (100, 160),
    speed: (0.6, 5.0),
    load: (0.6, 0.08),
};
/// Length of a stretch in the air, samples.
pub(super) const IN_AIR: usize = 250;
/// Slowest stroke, mm/s.
const SLOWEST_MM_S: f64 = 8.0;
/// Time in contact before a stretch, in which a landing rings out, samples.
const SETTLE: usize = 60;

/// Samples of a stroke that has settled.
pub(super) fn usable(timeline: &Timeline) -> Vec<bool> {
    let mut settled = 0;
    (0..timeline.len())
        .map(|n| {
            settled = if timeline.contact[n] { settled + 1 } else { 0 };
            settled > SETTLE && timeline.good[n] && timeline.speed_mm_s[n] > SLOWEST_MM_S
        })
        .collect()
}

/// Usable samples that no span covers.
pub(super) fn outside(usable: &[bool], spans: &[(usize, usize)]) -> Vec<bool> {
    let mut outside = usable.to_vec();
    for &(start, length) in spans {
        outside[start..start + length].fill(false);
    }
    outside
}

/// Stretches of usable samples in which speed and load stay within bounds; neighbours overlap by half.
pub(super) fn spans(timeline: &Timeline, usable: &[bool], bounds: Bounds) -> Vec<(usize, usize)> {
    let (shortest, longest) = bounds.lengths;
    let mut spans = Vec::new();
    let within = |low: f64, high: f64, (fraction, least): (f64, f64)| {
        high - low < (fraction * (high + low)).max(2.0 * least)
    };
    let mut start = 0;
    while start + shortest <= timeline.len() {
        let (mut speeds, mut loads) = ((f64::INFINITY, 0.0_f64), (f64::INFINITY, 0.0_f64));
        let mut length = 0;
        while length < longest && start + length < timeline.len() && usable[start + length] {
            let (speed, load) = (
                timeline.speed_mm_s[start + length],
                timeline.load_n[start + length],
            );
            speeds = (speeds.0.min(speed), speeds.1.max(speed));
            loads = (loads.0.min(load), loads.1.max(load));
            if !within(speeds.0, speeds.1, bounds.speed) || !within(loads.0, loads.1, bounds.load) {
                break;
            }
            length += 1;
        }
        if length >= shortest {
            spans.push((start, length));
            start += length / 2;
        } else {
            start += 10;
        }
    }
    spans
}

/// Stretches in the air. A hand that taps gives short ones.
pub(super) fn in_air(timeline: &Timeline) -> Vec<(usize, usize)> {
    let length = IN_AIR;
    let mut found = Vec::new();
    let mut start = 0;
    while start + length <= timeline.len() {
        let blocked = (start..start + length)
            .rev()
            .find(|&n| timeline.contact[n] || !timeline.good[n]);
        match blocked {
            // A tap rings on in the air.
            Some(last) => start = last + 100,
            None => {
                found.push((start, length));
                start += length / 2;
            }
        }
    }
    found
}

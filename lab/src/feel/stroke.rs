//! Strokes: the speed and force that were wanted and reached, friction and vibration.

use asperity_runtime::Flags;
use serde::Serialize;

use super::recording::{Recording, Span};
use super::statistics::{mean, rms};
use asperity_sim::hand::Motion;
use asperity_sim::session::Record;

/// A stroke over its steady part.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StrokeReport {
    /// When its steady part starts and ends, s.
    pub steady_s: (f64, f64),
    /// Speed the script asked for, mm/s.
    pub scripted_mm_s: f64,
    /// Mean true speed, mm/s.
    pub true_mm_s: f64,
    /// Mean speed as the renderer estimated it, mm/s.
    pub estimated_mm_s: f64,
    /// Normal force the script asked for, N.
    pub wanted_n: f64,
    /// Mean normal force k·δ, N.
    pub normal_n: f64,
    /// Mean friction, N.
    pub friction_n: f64,
    /// RMS of the vibration, m/s².
    pub vib_m_s2: f64,
}

/// Every stroke that ran and was in contact at its steady speed.
#[must_use]
pub fn strokes(recording: &Recording) -> Vec<StrokeReport> {
    recording.spans().into_iter().filter_map(report).collect()
}

/// The ticks at which the target moves at full speed and hand and velocity filter have settled.
///
/// They are given 0.1 s after the ramp to settle.
pub(super) fn steady_part<'a>(span: &Span<'a>) -> &'a [Record] {
    let Motion::Stroke { speed_m_s, .. } = span.motion else {
        return &[];
    };
    let full = |r: &Record| {
        let [x, y, _] = r.intent.target_m_s;
        r.intent.in_body && x.hypot(y) > 0.999 * speed_m_s
    };
    let Some(first) = span.records.iter().position(full) else {
        return &[];
    };
    let count = span.records[first..].iter().take_while(|r| full(r)).count();
    let part = &span.records[first..first + count];
    let settled = part.iter().position(|r| r.t_s - part[0].t_s >= 0.1);
    settled.map_or(&[], |skip| &part[skip..])
}

fn report(span: Span<'_>) -> Option<StrokeReport> {
    let Motion::Stroke {
        speed_m_s, force_n, ..
    } = span.motion
    else {
        return None;
    };
    let part = steady_part(&span);
    let (first, last) = (part.first()?, part.last()?);
    let touching = part
        .iter()
        .filter(|r| r.output.flags.contains(Flags::CONTACT));
    let average = |value: fn(&Record) -> f64| mean(touching.clone().map(value));
    Some(StrokeReport {
        steady_s: (first.t_s, last.t_s),
        scripted_mm_s: speed_m_s * 1e3,
        true_mm_s: average(|r| 1e3 * r.true_m_s[0].hypot(r.true_m_s[1])),
        estimated_mm_s: average(|r| f64::from(r.output.speed_mm_s)),
        wanted_n: force_n,
        normal_n: average(|r| f64::from(r.output.normal_force_n)),
        friction_n: average(|r| f64::from(r.output.friction_n)),
        vib_m_s2: rms(touching.clone().map(|r| f64::from(r.output.vib_m_s2))),
    })
}

//! Taps: what the script asked for, what the stylus did, what was rendered.

use asperity_runtime::Flags;
use serde::Serialize;

use super::recording::Recording;
use super::statistics::peak;
use asperity_sim::hand::Motion;

/// A scripted tap.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TapReport {
    /// When the surface was truly met, s; `None` if it never was.
    pub impact_s: Option<f64>,
    /// Speed the script asked for, m/s.
    pub scripted_m_s: f64,
    /// True speed on meeting the surface, m/s.
    pub true_m_s: f64,
    /// Time from the true impact to the start of the transient, s; `None` if none played.
    pub delay_s: Option<f64>,
    /// Largest tap force, N.
    pub peak_n: f64,
}

/// All taps of a recording.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Taps {
    /// The scripted ones that ran.
    pub scripted: Vec<TapReport>,
    /// Start times of transients that belong to no scripted tap, s.
    pub others_s: Vec<f64>,
}

/// Matches rendered taps with scripted ones.
#[must_use]
pub fn taps(recording: &Recording) -> Taps {
    let mut taps = Taps::default();
    for span in recording.spans() {
        let started = span
            .records
            .iter()
            .filter(|r| r.output.flags.contains(Flags::TAP_STARTED));
        let Motion::Tap { speed_m_s } = span.motion else {
            taps.others_s.extend(started.map(|r| r.t_s));
            continue;
        };
        let met = span.records.windows(2).find_map(|pair| {
            let [before, after] = pair else { return None };
            let (above_m, below_m) = (before.true_m[2], after.true_m[2]);
            (above_m > 0.0 && below_m <= 0.0).then(|| {
                let fraction = above_m / (above_m - below_m);
                (
                    before.t_s + fraction * (after.t_s - before.t_s),
                    -before.true_m_s[2],
                )
            })
        });
        let mut report = TapReport {
            impact_s: met.map(|(impact_s, _)| impact_s),
            scripted_m_s: speed_m_s,
            true_m_s: met.map_or(0.0, |(_, true_m_s)| true_m_s),
            delay_s: None,
            peak_n: peak(span.records.iter().map(|r| f64::from(r.output.tap_n))),
        };
        for record in started {
            match report.impact_s {
                Some(impact_s) if report.delay_s.is_none() && record.t_s >= impact_s => {
                    report.delay_s = Some(record.t_s - impact_s);
                }
                _ => taps.others_s.push(record.t_s),
            }
        }
        taps.scripted.push(report);
    }
    taps
}

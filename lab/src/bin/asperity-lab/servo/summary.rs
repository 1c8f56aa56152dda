//! Summary of a session, as text and as JSON.

use std::path::PathBuf;

use asperity_host::servo::{End, Report};
use asperity_io::output::display;
use asperity_io::shown::counted;
use asperity_lab::servo_session::Surface;
use serde_json::{Value, json};

/// A session that is over.
pub(super) struct ServoSummary<'s> {
    pub(super) report: Report,
    pub(super) surface: &'s Surface,
    pub(super) device: &'s str,
    pub(super) rate_hz: u32,
    /// For a replay: forces compared with the recording, and those that differ.
    pub(super) repeated: Option<(u64, u64)>,
}

/// The session's losses, reloads and output.
pub(super) struct SessionOutcome {
    /// Records that were lost.
    pub(super) lost: u64,
    /// Textures that were loaded anew.
    pub(super) reloads: u64,
    /// Name and origin of the texture that plays, where it is not the first one.
    pub(super) playing: Option<(String, String)>,
    /// The record, and the ticks in it.
    pub(super) recorded: Option<(PathBuf, u64)>,
}

fn end(report: &Report) -> &'static str {
    match report.end {
        End::Asked => "asked to",
        End::Over => "time is over",
        End::Overrun => "a period was missed",
        End::Rounding => "the processor no longer rounded to nearest",
    }
}

/// Name and origin of what played last.
fn playing<'s>(session: &'s ServoSummary<'_>, outcome: &'s SessionOutcome) -> (&'s str, &'s str) {
    let surface = session.surface;
    let first = (surface.name.as_str(), surface.origin.as_str());
    let last = outcome.playing.as_ref();
    last.map_or(first, |(name, origin)| (name, origin))
}

pub(super) fn json(session: &ServoSummary<'_>, outcome: &SessionOutcome) -> Value {
    let ServoSummary {
        report,
        device,
        rate_hz,
        repeated,
        ..
    } = session;
    let (name, origin) = playing(session, outcome);
    let repeated =
        repeated.map(|(forces, different)| json!({ "forces": forces, "different": different }));
    json!({
        "texture": name, "origin": origin, "device": device,
        "rate_hz": rate_hz, "end": end(report), "ticks": report.ticks, "missed": report.missed,
        "caught_up": report.caught_up, "paused": report.paused, "stale": report.stale,
        "read_faults": report.read_faults, "write_faults": report.write_faults,
        "faults": report.episodes,
        "recoveries": report.recoveries, "recovered": report.recovered,
        "eased_forces": report.eased, "longest_gap_ns": report.longest_gap_ns,
        "ended_without_force": report.ended_without_force,
        "safe_states": report.counters.faults, "taps": report.counters.taps,
        "peak_limited": report.counters.peak_limited,
        "slew_limited": report.counters.slew_limited,
        "lost_records": outcome.lost, "reloads": outcome.reloads,
        "recorded_ticks": outcome.recorded.as_ref().map(|(_, ticks)| ticks),
        "replay": repeated,
    })
}

pub(super) fn text(session: &ServoSummary<'_>, outcome: &SessionOutcome) -> String {
    let ServoSummary {
        report,
        device,
        rate_hz,
        repeated,
        ..
    } = session;
    let (name, origin) = playing(session, outcome);
    let mut text = format!(
        "surface    {}, {}\ndevice     {device}\nloop       {rate_hz} Hz, {}, {} missed, longest gap {:.3} ms\n",
        name,
        origin,
        counted(report.ticks, "tick", "ticks"),
        report.missed,
        1e-6 * report.longest_gap_ns as f64,
    );
    text += &format!(
        "faults     {}; {} without a new position; {} and {} failed; {} of {} succeeded\n",
        report.episodes,
        counted(report.stale, "tick", "ticks"),
        counted(report.read_faults, "read", "reads"),
        counted(report.write_faults, "write", "writes"),
        report.recovered,
        counted(report.recoveries, "recovery", "recoveries")
    );
    text += &format!(
        "runtime    {}; safe state entered {}; {} at the peak limit, {} at the slew limit\n",
        counted(report.counters.taps, "tap", "taps"),
        counted(report.counters.faults, "time", "times"),
        counted(report.counters.peak_limited, "tick", "ticks"),
        report.counters.slew_limited
    );
    match repeated {
        Some((forces, 0)) => {
            text += &format!("replay     {forces} forces, all bit-identical to the recording\n");
        }
        Some((forces, different)) => {
            text += &format!(
                "replay     {forces} forces, {different} of them different from the recording\n"
            );
        }
        None => {}
    }
    if let Some((path, ticks)) = &outcome.recorded {
        let ticks = counted(*ticks, "tick", "ticks");
        text += &format!("record     {}, {ticks}\n", display(path));
    }
    let zero = if report.ended_without_force {
        "the force is zero"
    } else {
        "THE DEVICE DID NOT ACCEPT THE FINAL FORCE OF ZERO"
    };
    text + &format!("end        {}; {zero}\n", end(report))
}

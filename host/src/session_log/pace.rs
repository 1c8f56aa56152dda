//! Periods between the readings of a recording, for a servo loop that plays it.

use super::{Entry, SessionLog};
use crate::servo::Pace;

/// The pace of a recording as a device. A sample says how many periods passed since the one before,
/// so a reading without one counts as one period, and the next sample gives the rest.
///
/// The last ticks of a session, in which the loop let the force go, are left out unless the
/// recording repeats: the loop that plays it lets go by itself.
#[must_use]
pub fn pace(recording: &SessionLog, repeats: bool) -> Pace {
    let entries = &recording.entries;
    let without_sample = |entry: &&Entry| entry.sample.elapsed_ticks == 0;
    let let_go = entries
        .iter()
        .rev()
        .take_while(|entry| without_sample(entry) && entry.read_fault.is_none())
        .count();
    let played = if repeats { 0 } else { let_go };
    let mut since = 0;
    let periods = entries[..entries.len() - played].iter().map(|entry| {
        if without_sample(&entry) {
            since += 1;
            return 1;
        }
        let before = std::mem::take(&mut since);
        entry.sample.elapsed_ticks.saturating_sub(before).max(1)
    });
    Pace::Recorded {
        periods: periods.collect(),
        repeats,
    }
}

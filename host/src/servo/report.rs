//! Summary of a servo loop's run.

use asperity_runtime::Counters;

/// Why a loop ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// Somebody asked for it.
    Asked,
    /// Its time was over.
    Over,
    /// Periods were missed, and its policy is to stop.
    Overrun,
    /// The processor no longer rounded to nearest: code of a device changed it.
    Rounding,
}

/// Summary of a servo loop's run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// Why it ended.
    pub end: End,
    /// Ticks.
    pub ticks: u64,
    /// Periods without a tick of their own time: skipped, or made up for later.
    pub missed: u64,
    /// Missed periods made up for.
    pub caught_up: u64,
    /// Periods without a tick because a recovery was under way.
    pub paused: u64,
    /// Ticks in which the device gave nothing new.
    pub stale: u64,
    /// Ticks in which reading failed, implausible positions included.
    pub read_faults: u64,
    /// Ticks in which writing failed.
    pub write_faults: u64,
    /// Attempted recoveries.
    pub recoveries: u64,
    /// Successful recoveries.
    pub recovered: u64,
    /// Faults of the device, each counted once however long it lasted.
    pub episodes: u64,
    /// Forces that went to the device by way of the slew limit, since it held an older one.
    pub eased: u64,
    /// Longest time from one wake-up to the next, ns.
    pub longest_gap_ns: u64,
    /// The last force was zero and reached the device.
    pub ended_without_force: bool,
    /// Counts of the runtime; its safe states are those before the device was let go.
    pub counters: Counters,
}

impl Report {
    pub(super) fn new() -> Self {
        Self {
            end: End::Asked,
            ticks: 0,
            missed: 0,
            caught_up: 0,
            paused: 0,
            stale: 0,
            read_faults: 0,
            write_faults: 0,
            recoveries: 0,
            recovered: 0,
            episodes: 0,
            eased: 0,
            longest_gap_ns: 0,
            ended_without_force: false,
            counters: Counters::default(),
        }
    }
}

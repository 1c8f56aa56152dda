//! Counts of events.

use crate::sized::sized;
use asperity_runtime::Counters;

/// Counts of events since the state was made. They saturate. Set `struct_size`, or begin with
/// `ASPERITY_COUNTERS_INIT`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AsperityCounters {
    /// `sizeof(AsperityCounters)`, from the caller.
    pub struct_size: u32,
    /// Ticks.
    pub ticks: u32,
    /// Bad samples: stale, not finite, out of reach.
    pub bad_samples: u32,
    /// Servo periods that the caller reported as missed: overruns.
    pub missed_ticks: u32,
    /// Times the safe state was entered.
    pub faults: u32,
    /// Taps.
    pub taps: u32,
    /// Ticks whose force was cut to the peak.
    pub peak_limited: u32,
    /// Ticks whose force was held back by the slew limit.
    pub slew_limited: u32,
}

sized!(AsperityCounters, first version ends with slew_limited, lacking fields are AsperityCounters {
    struct_size: size_of::<AsperityCounters>() as u32,
    ticks: 0,
    bad_samples: 0,
    missed_ticks: 0,
    faults: 0,
    taps: 0,
    peak_limited: 0,
    slew_limited: 0,
});

impl From<&Counters> for AsperityCounters {
    fn from(found: &Counters) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            ticks: found.ticks,
            bad_samples: found.bad_samples,
            missed_ticks: found.missed_ticks,
            faults: found.faults,
            taps: found.taps,
            peak_limited: found.peak_limited,
            slew_limited: found.slew_limited,
        }
    }
}

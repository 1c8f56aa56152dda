//! Kinds of faults of samples.

use asperity_host::fault_plan;

/// A kind of fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SampleFault {
    /// A coordinate is NaN or infinite.
    NotFinite,
    /// The servo misses its tick; the device keeps the last force.
    Dropped,
    /// The last sample comes again and is marked as old.
    Stale,
    /// The position freezes, and nothing marks it.
    Stuck,
    /// No new sample comes for some ticks, then one with the time that passed.
    Late,
}

/// Number of kinds.
pub(super) const KINDS: usize = 5;

impl fault_plan::FaultKind<KINDS> for SampleFault {
    const ALL: [Self; KINDS] = [
        Self::NotFinite,
        Self::Dropped,
        Self::Stale,
        Self::Stuck,
        Self::Late,
    ];

    fn index(self) -> usize {
        self as usize
    }

    fn name(self) -> &'static str {
        match self {
            Self::NotFinite => "not finite",
            Self::Dropped => "dropped",
            Self::Stale => "stale",
            Self::Stuck => "stuck",
            Self::Late => "late",
        }
    }
}

/// Start rate and duration in ticks of each fault of samples.
pub type FaultPlan = fault_plan::FaultPlan<SampleFault, KINDS>;

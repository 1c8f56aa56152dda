//! Kinds of faults of a device.

use crate::fault_plan::{FaultKind, FaultPlan};

/// A kind of injected fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum InjectedFault {
    /// A reading is lost.
    Lost,
    /// Nothing new comes for some periods.
    Late,
    /// A reading comes twice.
    Duplicate,
    /// The position freezes, and nothing marks it.
    Stuck,
    /// A coordinate is NaN or infinite.
    NotFinite,
    /// A coordinate lies metres away.
    OutOfRange,
    /// A transfer ends early.
    ShortTransfer,
    /// An endpoint refuses transfers.
    Stalled,
    /// The plug is pulled, and put back.
    Unplugged,
    /// A force does not reach the device.
    WriteFailed,
    /// The clock jumps ahead.
    ClockStep,
}

/// Number of kinds.
pub(super) const KINDS: usize = 11;

impl FaultKind<KINDS> for InjectedFault {
    const ALL: [Self; KINDS] = [
        Self::Lost,
        Self::Late,
        Self::Duplicate,
        Self::Stuck,
        Self::NotFinite,
        Self::OutOfRange,
        Self::ShortTransfer,
        Self::Stalled,
        Self::Unplugged,
        Self::WriteFailed,
        Self::ClockStep,
    ];

    fn index(self) -> usize {
        self as usize
    }

    fn name(self) -> &'static str {
        match self {
            Self::Lost => "lost",
            Self::Late => "late",
            Self::Duplicate => "duplicate",
            Self::Stuck => "stuck",
            Self::NotFinite => "not finite",
            Self::OutOfRange => "out of range",
            Self::ShortTransfer => "short transfer",
            Self::Stalled => "stalled transfer",
            Self::Unplugged => "unplugged",
            Self::WriteFailed => "write failed",
            Self::ClockStep => "clock step",
        }
    }
}

/// Start rate and duration of each fault of a device; for a clock step, the most periods that it skips.
pub type Plan = FaultPlan<InjectedFault, KINDS>;

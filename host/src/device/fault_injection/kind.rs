//! Kinds of faults of a device.

/// A kind of injected fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
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

impl InjectedFault {
    /// Every kind.
    pub const ALL: [Self; 11] = [
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

    /// Name for tables.
    #[must_use]
    pub fn name(self) -> &'static str {
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

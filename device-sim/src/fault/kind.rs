//! Kinds of faults of samples.

/// A kind of fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
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

impl SampleFault {
    /// Every kind.
    pub const ALL: [Self; 5] = [
        Self::NotFinite,
        Self::Dropped,
        Self::Stale,
        Self::Stuck,
        Self::Late,
    ];
}

//! Where the time of a tick goes.

/// A part of a servo period.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stage {
    /// From when the tick was due to when the loop ran.
    WakeUp,
    /// Reading the device.
    Read,
    /// The runtime's tick.
    Compute,
    /// Writing the force.
    Write,
    /// From when the tick was due to when the force was written: the sum of the four above.
    Total,
    /// From one wake-up to the next: the period as the device sees it.
    Interval,
}

impl Stage {
    /// Every stage.
    pub const ALL: [Self; 6] = [
        Self::WakeUp,
        Self::Read,
        Self::Compute,
        Self::Write,
        Self::Total,
        Self::Interval,
    ];

    /// The stages that follow each other in a tick.
    pub const PARTS: [Self; 4] = [Self::WakeUp, Self::Read, Self::Compute, Self::Write];

    /// Its name in tables, files and tags.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::WakeUp => "wakeup",
            Self::Read => "read",
            Self::Compute => "compute",
            Self::Write => "write",
            Self::Total => "total",
            Self::Interval => "interval",
        }
    }

    /// The stage of a name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|stage| stage.name() == name)
    }
}

/// The times of one tick on the loop's clock, ns.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Times {
    /// When it was due.
    pub due_ns: u64,
    /// When the loop ran.
    pub woken_ns: u64,
    /// When the device was read.
    pub read_ns: u64,
    /// When the force was known.
    pub computed_ns: u64,
    /// When the force was written.
    pub written_ns: u64,
    /// When the loop ran in the tick before; 0 in the first tick.
    pub woken_before_ns: u64,
}

impl Times {
    /// Returns the duration of a stage, ns; `None` for the interval of the first tick.
    #[must_use]
    pub fn of(&self, stage: Stage) -> Option<u64> {
        Some(match stage {
            Stage::WakeUp => self.woken_ns.saturating_sub(self.due_ns),
            Stage::Read => self.read_ns - self.woken_ns,
            Stage::Compute => self.computed_ns - self.read_ns,
            Stage::Write => self.written_ns - self.computed_ns,
            Stage::Total => self.written_ns.saturating_sub(self.due_ns),
            Stage::Interval if self.woken_before_ns == 0 => return None,
            Stage::Interval => self.woken_ns - self.woken_before_ns,
        })
    }

    /// The part that lasted longest.
    #[must_use]
    pub fn longest(&self) -> Stage {
        Stage::PARTS
            .into_iter()
            .max_by_key(|&stage| self.of(stage))
            .unwrap_or(Stage::WakeUp)
    }
}

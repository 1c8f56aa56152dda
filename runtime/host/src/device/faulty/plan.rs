//! Kinds of faults, how often each starts and how long it lasts.

use thiserror::Error;

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

/// How many kinds there are.
const KINDS: usize = 11;

impl InjectedFault {
    /// Every kind, in the order of [`Plan::rates`].
    pub const ALL: [Self; KINDS] = [
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
    pub const fn name(self) -> &'static str {
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

/// How often a fault starts and how long it lasts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rate {
    /// Probability that it starts in a period without a fault, 0..=1.
    pub probability: f64,
    /// Longest duration, periods; durations are uniform in 1..=this. For a clock step, the most
    /// periods that it skips.
    pub longest_periods: u32,
}

/// The rate of every kind; the default has no faults.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plan {
    /// One rate for each kind, in the order of [`InjectedFault::ALL`].
    pub rates: [Rate; KINDS],
}

impl Default for Plan {
    fn default() -> Self {
        Self {
            rates: [Rate {
                probability: 0.0,
                longest_periods: 1,
            }; KINDS],
        }
    }
}

impl Plan {
    /// Every kind with an equal share of one probability.
    #[must_use]
    pub fn all(probability: f64, longest_periods: u32) -> Self {
        Self {
            rates: [Rate {
                probability: probability / KINDS as f64,
                longest_periods,
            }; KINDS],
        }
    }

    /// The plan with another rate for one kind.
    #[must_use]
    pub fn with(mut self, kind: InjectedFault, probability: f64, longest_periods: u32) -> Self {
        self.rates[kind as usize] = Rate {
            probability,
            longest_periods,
        };
        self
    }

    /// Checks the plan.
    ///
    /// # Errors
    /// [`PlanError`].
    pub fn check(&self) -> Result<(), PlanError> {
        for (kind, rate) in InjectedFault::ALL.into_iter().zip(self.rates) {
            if !(0.0..=1.0).contains(&rate.probability) {
                return Err(PlanError::Probability {
                    kind: kind.name(),
                    value: rate.probability,
                });
            }
            if rate.longest_periods == 0 {
                return Err(PlanError::Empty { kind: kind.name() });
            }
        }
        let value: f64 = self.rates.iter().map(|rate| rate.probability).sum();
        // The margin covers the rounding of equal shares.
        if value > 1.0 + 1e-9 {
            return Err(PlanError::Sum { value });
        }
        Ok(())
    }
}

/// Why a plan is refused.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// A probability outside 0..=1.
    #[error("probability of fault `{kind}` = {value} is outside 0..=1")]
    Probability {
        /// Which fault.
        kind: &'static str,
        /// Its value.
        value: f64,
    },
    /// Probabilities that add up to more than 1.
    #[error("probabilities of all faults add up to {value}, more than 1")]
    Sum {
        /// Their sum.
        value: f64,
    },
    /// A longest duration of 0 periods.
    #[error("fault `{kind}` lasts at most 0 periods; it must be at least 1")]
    Empty {
        /// Which fault.
        kind: &'static str,
    },
}

/// In how many periods each kind ran, in the order of [`InjectedFault::ALL`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts(pub [u64; KINDS]);

impl Counts {
    /// Periods of one kind.
    #[must_use]
    pub fn of(&self, kind: InjectedFault) -> u64 {
        self.0[kind as usize]
    }

    /// Periods of all kinds.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.0.iter().sum()
    }
}

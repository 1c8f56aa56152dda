//! Kinds of faults, how often each starts and how long it lasts.

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

impl SampleFault {
    /// Every kind, in the order of [`FaultPlan::kinds`].
    pub const ALL: [Self; 5] = [
        Self::NotFinite,
        Self::Dropped,
        Self::Stale,
        Self::Stuck,
        Self::Late,
    ];
}

/// How often a fault starts and how long it lasts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaultRate {
    /// Probability that it starts in a tick without a fault, 0..=1.
    pub probability: f64,
    /// Longest duration, ticks; durations are uniform in 1..=this.
    pub longest_ticks: u32,
}

/// The rate of every kind of fault; the default has no faults.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaultPlan {
    /// One rate for each kind, in the order of [`SampleFault::ALL`].
    pub kinds: [FaultRate; 5],
}

impl Default for FaultPlan {
    fn default() -> Self {
        Self {
            kinds: [FaultRate {
                probability: 0.0,
                longest_ticks: 1,
            }; 5],
        }
    }
}

impl FaultPlan {
    /// The plan with another rate for one kind.
    #[must_use]
    pub fn with(mut self, fault: SampleFault, probability: f64, longest_ticks: u32) -> Self {
        self.kinds[fault as usize] = FaultRate {
            probability,
            longest_ticks,
        };
        self
    }

    /// Checks the plan.
    ///
    /// # Errors
    /// [`FaultPlanError`]: a probability outside 0..=1, a sum above 1, a run of 0.
    pub fn check(&self) -> Result<(), FaultPlanError> {
        for (fault, rate) in SampleFault::ALL.into_iter().zip(self.kinds) {
            if !(0.0..=1.0).contains(&rate.probability) {
                return Err(FaultPlanError::Probability {
                    fault,
                    value: rate.probability,
                });
            }
            if rate.longest_ticks == 0 {
                return Err(FaultPlanError::EmptyRun { fault });
            }
        }
        let sum: f64 = self.kinds.iter().map(|rate| rate.probability).sum();
        if sum > 1.0 {
            Err(FaultPlanError::Sum { value: sum })
        } else {
            Ok(())
        }
    }
}

/// Why a plan was refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum FaultPlanError {
    /// A probability outside 0..=1.
    #[error("probability of {fault:?} = {value} is outside 0..=1")]
    Probability {
        /// Which fault.
        fault: SampleFault,
        /// Its value.
        value: f64,
    },
    /// Probabilities that add up to more than 1.
    #[error("probabilities of all faults add up to {value}, more than 1")]
    Sum {
        /// Their sum.
        value: f64,
    },
    /// A longest duration of 0 ticks.
    #[error("longest run of {fault:?} is 0 ticks; it must be at least 1")]
    EmptyRun {
        /// Which fault.
        fault: SampleFault,
    },
}

/// How many ticks each kind took, in the order of [`SampleFault::ALL`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FaultCounts(pub [u64; 5]);

impl FaultCounts {
    /// Ticks of one kind.
    #[must_use]
    pub fn of(&self, fault: SampleFault) -> u64 {
        self.0[fault as usize]
    }

    /// Ticks of all kinds.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.0.iter().sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_plans_are_refused_by_name() {
        let nan = FaultPlan::default().with(SampleFault::Late, f64::NAN, 1);
        assert!(nan.check().expect_err("NaN").to_string().contains("Late"));
        let heavy =
            FaultPlan::default()
                .with(SampleFault::Late, 0.6, 1)
                .with(SampleFault::Stale, 0.6, 1);
        assert!(matches!(heavy.check(), Err(FaultPlanError::Sum { .. })));
        assert!(
            FaultPlan::default()
                .with(SampleFault::Stuck, 0.1, 0)
                .check()
                .is_err()
        );
    }
}

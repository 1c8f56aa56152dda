//! When faults begin and how long they last, seeded, for any set of kinds.
//!
//! At most one fault runs at a time. While none runs, each period starts one with the
//! probabilities of the plan.

use std::marker::PhantomData;

use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use thiserror::Error;

/// A set of `N` kinds of faults.
pub trait FaultKind<const N: usize>: Copy + PartialEq + 'static {
    /// Every kind, in the order of [`FaultKind::index`].
    const ALL: [Self; N];

    /// The place in [`FaultKind::ALL`].
    fn index(self) -> usize;

    /// Name for tables.
    fn name(self) -> &'static str;
}

/// Start probability and duration of a fault.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rate {
    /// Probability that it starts in a period without a fault, 0..=1.
    pub probability: f64,
    /// Longest duration, periods; durations are uniform in 1..=this.
    pub longest_periods: u32,
}

/// The rate of every kind; the default has no faults.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaultPlan<K, const N: usize> {
    /// Rate per kind, in the order of [`FaultKind::ALL`].
    pub rates: [Rate; N],
    of: PhantomData<K>,
}

impl<K, const N: usize> Default for FaultPlan<K, N> {
    fn default() -> Self {
        Self::every(0.0, 1)
    }
}

impl<K, const N: usize> FaultPlan<K, N> {
    fn every(probability: f64, longest_periods: u32) -> Self {
        Self {
            rates: [Rate {
                probability,
                longest_periods,
            }; N],
            of: PhantomData,
        }
    }

    /// Every kind with an equal share of one probability.
    #[must_use]
    pub fn all(probability: f64, longest_periods: u32) -> Self {
        Self::every(probability / N as f64, longest_periods)
    }
}

impl<K: FaultKind<N>, const N: usize> FaultPlan<K, N> {
    /// The plan with another rate for one kind.
    #[must_use]
    pub fn with(mut self, kind: K, probability: f64, longest_periods: u32) -> Self {
        self.rates[kind.index()] = Rate {
            probability,
            longest_periods,
        };
        self
    }

    /// Checks the plan.
    ///
    /// # Errors
    /// [`FaultPlanError`].
    pub fn check(&self) -> Result<(), FaultPlanError> {
        for (kind, rate) in K::ALL.into_iter().zip(self.rates) {
            if !(0.0..=1.0).contains(&rate.probability) {
                return Err(FaultPlanError::Probability {
                    kind: kind.name(),
                    value: rate.probability,
                });
            }
            if rate.longest_periods == 0 {
                return Err(FaultPlanError::Empty { kind: kind.name() });
            }
        }
        let value: f64 = self.rates.iter().map(|rate| rate.probability).sum();
        // The margin covers the rounding of equal shares.
        if value > 1.0 + 1e-9 {
            return Err(FaultPlanError::Sum { value });
        }
        Ok(())
    }
}

/// Why a plan is refused.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum FaultPlanError {
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

/// In how many periods each kind ran, in the order of [`FaultKind::ALL`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FaultCounts<const N: usize>(pub [u64; N]);

impl<const N: usize> FaultCounts<N> {
    /// Periods of one kind.
    #[must_use]
    pub fn of(&self, kind: impl FaultKind<N>) -> u64 {
        self.0[kind.index()]
    }

    /// Periods of all kinds.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.0.iter().sum()
    }
}

/// A plan that is carried out.
#[derive(Debug, Clone)]
pub struct FaultSchedule<K, const N: usize> {
    plan: FaultPlan<K, N>,
    rng: Xoshiro256PlusPlus,
    /// Active fault, and the periods that remain of it.
    running: Option<(K, u32)>,
    counts: FaultCounts<N>,
}

impl<K: FaultKind<N>, const N: usize> FaultSchedule<K, N> {
    /// Carries out a plan.
    ///
    /// # Errors
    /// [`FaultPlanError`], as [`FaultPlan::check`].
    pub fn new(plan: FaultPlan<K, N>, seed: u64) -> Result<Self, FaultPlanError> {
        plan.check()?;
        Ok(Self {
            plan,
            ..Self::by_hand(seed)
        })
    }

    /// Faults that are started by hand alone.
    #[must_use]
    pub fn by_hand(seed: u64) -> Self {
        Self {
            plan: FaultPlan::default(),
            rng: Xoshiro256PlusPlus::seed_from_u64(seed),
            running: None,
            counts: FaultCounts([0; N]),
        }
    }

    /// Starts a fault with the next period; it replaces one that runs.
    pub fn start(&mut self, kind: K, periods: u32) {
        self.running = (periods > 0).then_some((kind, periods));
    }

    /// Ends the fault that runs.
    pub fn stop(&mut self) {
        self.running = None;
    }

    /// Returns the fault that remains active after this period.
    #[must_use]
    pub fn running(&self) -> Option<K> {
        self.running.map(|(kind, _)| kind)
    }

    /// Returns the number of periods with each kind.
    #[must_use]
    pub fn counts(&self) -> FaultCounts<N> {
        self.counts
    }

    /// The fault of the next period, and for how many periods it runs, this one included.
    pub fn draw(&mut self) -> Option<(K, u32)> {
        if self.running.is_none() {
            let mut left = (self.rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
            for (kind, rate) in K::ALL.into_iter().zip(self.plan.rates) {
                if left < rate.probability {
                    let periods = 1 + self.rng.next_u64() % u64::from(rate.longest_periods);
                    self.running = Some((kind, periods as u32));
                    break;
                }
                left -= rate.probability;
            }
        }
        let (kind, periods) = self.running?;
        self.running = (periods > 1).then_some((kind, periods - 1));
        self.counts.0[kind.index()] += 1;
        Some((kind, periods))
    }

    /// A random number below a bound above 0.
    pub fn below(&mut self, bound: u64) -> u64 {
        self.rng.next_u64() % bound
    }
}

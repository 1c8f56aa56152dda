//! When faults begin and how long they last, seeded, for any set of kinds.
//!
//! At most one fault runs at a time. While none runs, each period starts one with the
//! probabilities of the plan.

use std::collections::BTreeMap;

use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Start probability and duration of a kind of fault.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Rate<K> {
    kind: K,
    /// Probability that it starts in a period without a fault.
    probability: f64,
    /// Longest duration, periods; durations are uniform in 1..=this.
    longest_periods: u32,
}

/// The rate of every kind; the default has no faults.
#[derive(Debug, Clone, PartialEq)]
pub struct FaultPlan<K>(Vec<Rate<K>>);

impl<K> Default for FaultPlan<K> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<K: Copy> FaultPlan<K> {
    /// Several kinds with an equal share of one probability.
    #[must_use]
    pub fn all(kinds: &[K], probability: f64, longest_periods: u32) -> Self {
        let share = probability / kinds.len() as f64;
        let each = |plan: Self, kind: &K| plan.with(*kind, share, longest_periods);
        kinds.iter().fold(Self::default(), each)
    }

    /// The plan with one more kind.
    ///
    /// # Panics
    /// If the probabilities are below 0 or add up to more than 1, or if the fault lasts 0 periods.
    #[must_use]
    pub fn with(mut self, kind: K, probability: f64, longest_periods: u32) -> Self {
        self.0.push(Rate {
            kind,
            probability,
            longest_periods,
        });
        let sum: f64 = self.0.iter().map(|rate| rate.probability).sum();
        // The margin covers the rounding of equal shares.
        assert!(probability >= 0.0 && sum <= 1.0 + 1e-9 && longest_periods > 0);
        self
    }
}

/// A plan that is carried out.
#[derive(Debug, Clone)]
pub struct FaultSchedule<K> {
    plan: FaultPlan<K>,
    rng: Xoshiro256PlusPlus,
    /// Active fault, and the periods that remain of it.
    running: Option<(K, u32)>,
    counts: BTreeMap<K, u64>,
}

impl<K: Copy + Ord> FaultSchedule<K> {
    /// Carries out a plan.
    #[must_use]
    pub fn new(plan: FaultPlan<K>, seed: u64) -> Self {
        Self {
            plan,
            rng: Xoshiro256PlusPlus::seed_from_u64(seed),
            running: None,
            counts: BTreeMap::new(),
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

    /// Returns the number of periods with each kind that ran.
    #[must_use]
    pub fn counts(&self) -> &BTreeMap<K, u64> {
        &self.counts
    }

    /// The fault of the next period, and for how many periods it runs, this one included.
    pub fn draw(&mut self) -> Option<(K, u32)> {
        if self.running.is_none() {
            let mut left = (self.rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
            for rate in &self.plan.0 {
                if left < rate.probability {
                    let periods = 1 + self.rng.next_u64() % u64::from(rate.longest_periods);
                    self.running = Some((rate.kind, periods as u32));
                    break;
                }
                left -= rate.probability;
            }
        }
        let (kind, periods) = self.running?;
        self.running = (periods > 1).then_some((kind, periods - 1));
        *self.counts.entry(kind).or_default() += 1;
        Some((kind, periods))
    }

    /// A random number below a bound above 0.
    pub fn below(&mut self, bound: u64) -> u64 {
        self.rng.next_u64() % bound
    }
}

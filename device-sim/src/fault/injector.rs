//! A servo behind faults.

use std::collections::BTreeMap;

use asperity_host::fault_plan::{FaultPlan, FaultSchedule};
use asperity_runtime::{Output, Sample};

use super::kind::SampleFault;
use crate::servo::{Servo, silence};

/// A servo behind faults.
#[derive(Debug, Clone)]
pub struct FaultInjector<S> {
    inner: S,
    schedule: FaultSchedule<SampleFault>,
    /// Last sample that the servo was given without a fault.
    last: Sample,
    output: Output,
    /// Ticks that passed since the servo last saw a fresh sample.
    missed_ticks: u32,
}

impl<S: Servo> FaultInjector<S> {
    /// Puts `inner` behind the faults of `plan`.
    pub fn new(inner: S, plan: FaultPlan<SampleFault>, seed: u64) -> Self {
        Self {
            inner,
            schedule: FaultSchedule::new(plan, seed),
            last: Sample::at([0.0; 3]),
            output: silence(),
            missed_ticks: 0,
        }
    }

    /// Returns the ticks affected so far, per kind of fault.
    #[must_use]
    pub fn counts(&self) -> &BTreeMap<SampleFault, u64> {
        self.schedule.counts()
    }

    /// The servo behind the faults.
    #[must_use]
    pub fn inner(&self) -> &S {
        &self.inner
    }

    /// Starts a fault for `ticks` ticks; it replaces one that runs.
    pub fn start(&mut self, fault: SampleFault, ticks: u32) {
        self.schedule.start(fault, ticks);
    }

    /// The servo, without the faults.
    #[must_use]
    pub fn into_inner(self) -> S {
        self.inner
    }

    /// A coordinate that is NaN or infinite.
    fn not_finite(&mut self) -> f32 {
        [f32::NAN, f32::INFINITY, f32::NEG_INFINITY][self.schedule.below(3) as usize]
    }
}

impl<S: Servo> Servo for FaultInjector<S> {
    fn tick(&mut self, sample: &Sample) -> Output {
        let fresh = |missed: u32| Sample {
            elapsed_ticks: sample.elapsed_ticks.saturating_add(missed),
            ..*sample
        };
        let given = match self.schedule.draw().map(|(fault, _)| fault) {
            None => {
                self.last = fresh(std::mem::take(&mut self.missed_ticks));
                self.last
            }
            Some(SampleFault::NotFinite) => {
                let mut broken = fresh(std::mem::take(&mut self.missed_ticks));
                let axis = self.schedule.below(3) as usize;
                broken.position_m[axis] = self.not_finite();
                broken
            }
            Some(SampleFault::Dropped) => {
                self.missed_ticks = self.missed_ticks.saturating_add(sample.elapsed_ticks);
                return self.output;
            }
            Some(SampleFault::Stale) => Sample {
                elapsed_ticks: 0,
                ..self.last
            },
            Some(SampleFault::Stuck) => Sample {
                position_m: self.last.position_m,
                ..*sample
            },
            Some(SampleFault::Late) => {
                self.missed_ticks = self.missed_ticks.saturating_add(sample.elapsed_ticks);
                Sample {
                    elapsed_ticks: 0,
                    ..self.last
                }
            }
        };
        self.output = self.inner.tick(&given);
        self.output
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Records the samples that it is given.
    #[derive(Debug, Default)]
    struct Recorder(Vec<Sample>);

    impl Servo for Recorder {
        fn tick(&mut self, sample: &Sample) -> Output {
            self.0.push(*sample);
            Output {
                force_n: sample.position_m,
                ..silence()
            }
        }
    }

    fn walk(plan: FaultPlan<SampleFault>, seed: u64, ticks: u32) -> FaultInjector<Recorder> {
        let mut servo = FaultInjector::new(Recorder::default(), plan, seed);
        for n in 1..=ticks {
            servo.tick(&Sample::at([n as f32, 0.5, -0.5]));
        }
        servo
    }

    #[test]
    fn without_faults_every_sample_passes_untouched() {
        let servo = walk(FaultPlan::default(), 1, 100);
        for (n, sample) in servo.inner().0.iter().enumerate() {
            assert_eq!(*sample, Sample::at([n as f32 + 1.0, 0.5, -0.5]));
        }
        assert!(servo.counts().is_empty());
    }

    #[test]
    fn each_fault_is_what_the_table_says() {
        let mut servo = walk(FaultPlan::default(), 1, 5);
        let mut next = 5.0;
        let mut run = |fault, ticks: u32| {
            servo.start(fault, ticks);
            let before = servo.inner().0.len();
            let outputs: Vec<Output> = (0..=ticks)
                .map(|_| {
                    next += 1.0;
                    servo.tick(&Sample::at([next, 0.5, -0.5]))
                })
                .collect();
            (servo.inner().0[before..].to_vec(), outputs)
        };

        let (seen, _) = run(SampleFault::NotFinite, 3);
        assert!(
            seen[..3]
                .iter()
                .all(|s| s.position_m.iter().any(|x| !x.is_finite()))
        );
        assert_eq!(seen[3], Sample::at([9.0, 0.5, -0.5]));

        let (seen, outputs) = run(SampleFault::Dropped, 3);
        assert!(
            outputs[..3].iter().all(|o| o.force_n[0] == 9.0),
            "the last force is held"
        );
        assert_eq!(
            seen,
            [Sample {
                elapsed_ticks: 4,
                ..Sample::at([13.0, 0.5, -0.5])
            }]
        );

        let (seen, _) = run(SampleFault::Stale, 2);
        assert!(
            seen[..2]
                .iter()
                .all(|s| s.elapsed_ticks == 0 && s.position_m[0] == 13.0)
        );
        assert_eq!(seen[2], Sample::at([16.0, 0.5, -0.5]));

        let (seen, _) = run(SampleFault::Stuck, 2);
        assert!(
            seen[..2]
                .iter()
                .all(|s| s.elapsed_ticks == 1 && s.position_m[0] == 16.0)
        );

        let (seen, _) = run(SampleFault::Late, 2);
        assert!(
            seen[..2]
                .iter()
                .all(|s| s.elapsed_ticks == 0 && s.position_m[0] == 19.0)
        );
        assert_eq!(seen[2].elapsed_ticks, 3);
        assert!(servo.counts().values().eq(&[3, 3, 2, 2, 2]));
    }

    #[test]
    fn faults_come_at_their_rate_and_the_same_seed_gives_the_same_ones() {
        let plan = FaultPlan::default()
            .with(SampleFault::NotFinite, 0.01, 1)
            .with(SampleFault::Stale, 0.02, 1)
            .with(SampleFault::Dropped, 0.05, 1);
        let servo = walk(plan.clone(), 7, 100_000);
        for (fault, expected) in [
            (SampleFault::NotFinite, 1000.0),
            (SampleFault::Stale, 2000.0),
            (SampleFault::Dropped, 5000.0),
        ] {
            // The bound is five standard deviations of a binomial count.
            let count = servo.counts()[&fault] as f64;
            assert!(
                (count - expected).abs() < 5.0 * f64::sqrt(expected),
                "{fault:?}: {count}"
            );
        }
        let bits = |servo: &FaultInjector<Recorder>| -> Vec<[u32; 4]> {
            let words = |s: &Sample| {
                let [x, y, z] = s.position_m.map(f32::to_bits);
                [x, y, z, s.elapsed_ticks]
            };
            servo.inner().0.iter().map(words).collect()
        };
        assert_eq!(bits(&servo), bits(&walk(plan.clone(), 7, 100_000)));
        assert_ne!(bits(&servo), bits(&walk(plan, 8, 100_000)));
    }

    #[test]
    fn elapsed_ticks_add_up_whatever_is_dropped_or_late() {
        let plan = FaultPlan::default()
            .with(SampleFault::Dropped, 0.1, 4)
            .with(SampleFault::Late, 0.1, 5);
        let servo = walk(plan, 3, 10_000);
        let elapsed: u32 = servo.inner().0.iter().map(|s| s.elapsed_ticks).sum();
        assert!(elapsed <= 10_000 && elapsed + 10 >= 10_000, "{elapsed}");
    }

    #[test]
    fn injectors_stack() {
        let stale = FaultPlan::default().with(SampleFault::Stale, 1.0, 1);
        let inner = FaultInjector::new(Recorder::default(), stale, 1);
        let dropped = FaultPlan::default().with(SampleFault::Dropped, 0.5, 1);
        let mut outer = FaultInjector::new(inner, dropped, 2);
        for _ in 0..100 {
            outer.tick(&Sample::at([1.0; 3]));
        }
        let seen = &outer.inner().inner().0;
        let dropped: u64 = outer.counts().values().sum();
        assert_eq!(seen.len() as u64 + dropped, 100);
        assert!(seen.iter().all(|s| s.elapsed_ticks == 0));
    }
}

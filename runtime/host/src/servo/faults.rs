//! Runs of device faults: counted tick by tick, reported once, and when to try to recover.

use super::clock::SECOND_NS;
use crate::device::Fault;

/// What a servo loop tells once, apart from its records.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Event {
    /// The device began to fail.
    Failed {
        /// Period since the loop began.
        period: u64,
        /// The first fault.
        fault: Fault,
    },
    /// The device answers again.
    Back {
        /// Period since the loop began.
        period: u64,
        /// Ticks with a fault.
        faulty_ticks: u64,
    },
    /// A recovery was tried and failed.
    NotRecovered {
        /// Period since the loop began.
        period: u64,
        /// Why.
        fault: Fault,
    },
}

/// Readings in a row that are not fresh before the device counts as silent. A device that measures
/// less often than the loop asks is none.
const SILENT_TICKS: u32 = 3;
/// Faulty ticks in a row before recovery is tried: a shorter fault often passes.
const PATIENCE_S: f64 = 0.05;
/// Time between two tries: it doubles from the first to the second, ns.
const PAUSE_NS: (u64, u64) = (SECOND_NS / 10, 16 * SECOND_NS / 10);

/// Runs of faults.
#[derive(Debug, Clone, Copy)]
pub(super) struct Faults {
    patience_ticks: u64,
    /// Faulty ticks of the current run.
    run: u64,
    /// Readings in a row that were not fresh.
    silent: u32,
    pause_ns: u64,
    next_try_ns: u64,
}

impl Faults {
    pub(super) fn new(rate_hz: u32) -> Self {
        Self {
            patience_ticks: (PATIENCE_S * f64::from(rate_hz)) as u64,
            run: 0,
            silent: 0,
            pause_ns: PAUSE_NS.0,
            next_try_ns: 0,
        }
    }

    /// The fault of a reading that is not fresh: none at first, then silence.
    pub(super) fn freshness(&mut self, fresh: bool) -> Option<Fault> {
        self.silent = if fresh {
            0
        } else {
            self.silent.saturating_add(1)
        };
        (self.silent >= SILENT_TICKS).then_some(Fault::TimedOut)
    }

    /// Notes whether a tick had a fault, and says what is to be reported.
    pub(super) fn note(&mut self, period: u64, fault: Option<Fault>) -> Option<Event> {
        match fault {
            Some(fault) => {
                self.run += 1;
                (self.run == 1).then_some(Event::Failed { period, fault })
            }
            None if self.run > 0 => {
                let faulty_ticks = std::mem::take(&mut self.run);
                self.pause_ns = PAUSE_NS.0;
                Some(Event::Back {
                    period,
                    faulty_ticks,
                })
            }
            None => None,
        }
    }

    /// Whether recovery is to be tried now.
    pub(super) fn wants_recovery(&self, now_ns: u64) -> bool {
        self.run > self.patience_ticks && now_ns >= self.next_try_ns
    }

    /// A try has ended.
    pub(super) fn tried(&mut self, now_ns: u64) {
        self.next_try_ns = now_ns + self.pause_ns;
        self.pause_ns = (2 * self.pause_ns).min(PAUSE_NS.1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_of_faults_is_reported_once_and_its_end_too() {
        let mut faults = Faults::new(1000);
        let failed = |period, fault| Some(Event::Failed { period, fault });
        assert_eq!(faults.note(0, None), None);
        assert_eq!(
            faults.note(1, Some(Fault::Stalled)),
            failed(1, Fault::Stalled)
        );
        assert_eq!(faults.note(2, Some(Fault::Disconnected)), None);
        let back = Event::Back {
            period: 3,
            faulty_ticks: 2,
        };
        assert_eq!(faults.note(3, None), Some(back));
        assert_eq!(faults.note(4, None), None);
        assert_eq!(
            faults.note(5, Some(Fault::TimedOut)),
            failed(5, Fault::TimedOut)
        );
    }

    #[test]
    fn recovery_waits_for_a_lasting_fault_and_pauses_longer_and_longer() {
        let mut faults = Faults::new(1000);
        for period in 0..50 {
            faults.note(period, Some(Fault::Disconnected));
            assert!(!faults.wants_recovery(u64::MAX));
        }
        faults.note(50, Some(Fault::Disconnected));
        let mut now_ns = 0;
        let mut pauses = Vec::new();
        for _ in 0..6 {
            assert!(faults.wants_recovery(now_ns));
            faults.tried(now_ns);
            let pause = (1..).find(|ms| faults.wants_recovery(now_ns + ms * 1_000_000));
            pauses.push(pause.unwrap_or(0));
            now_ns += pauses[pauses.len() - 1] * 1_000_000;
        }
        assert_eq!(pauses, [100, 200, 400, 800, 1600, 1600]);
    }

    #[test]
    fn a_device_at_half_the_rate_is_not_silent() {
        let mut faults = Faults::new(1000);
        for fresh in [true, false, true, false, false, true] {
            assert_eq!(faults.freshness(fresh), None);
        }
        assert_eq!(faults.freshness(false), None);
        assert_eq!(faults.freshness(false), None);
        assert_eq!(faults.freshness(false), Some(Fault::TimedOut));
    }
}

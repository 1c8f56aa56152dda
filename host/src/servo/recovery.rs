//! When a device that fails is asked to recover.

use super::clock::SECOND_NS;

/// Time of faulty ticks in a row before recovery is tried, s: a shorter fault often passes.
const PATIENCE_S: f64 = 0.05;
/// Time between two tries: it doubles from the first to the second, ns.
const PAUSE_NS: (u64, u64) = (SECOND_NS / 10, 16 * SECOND_NS / 10);

/// Times of recovery.
#[derive(Debug, Clone, Copy)]
pub(super) struct Recovery {
    patience_ticks: u64,
    /// Faulty ticks of the current run.
    run: u64,
    pause_ns: u64,
    next_try_ns: u64,
}

impl Recovery {
    pub(super) fn new(rate_hz: u32) -> Self {
        Self {
            patience_ticks: (PATIENCE_S * f64::from(rate_hz)) as u64,
            run: 0,
            pause_ns: PAUSE_NS.0,
            next_try_ns: 0,
        }
    }

    /// Notes whether a tick had a fault.
    pub(super) fn note(&mut self, faulty: bool) {
        if faulty {
            self.run += 1;
        } else {
            (self.run, self.pause_ns) = (0, PAUSE_NS.0);
        }
    }

    /// Returns true if a recovery is due.
    pub(super) fn is_due(&self, now_ns: u64) -> bool {
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
    fn recovery_waits_for_a_lasting_fault_and_pauses_longer_and_longer() {
        let mut recovery = Recovery::new(1000);
        for _ in 0..50 {
            recovery.note(true);
            assert!(!recovery.is_due(u64::MAX));
        }
        recovery.note(true);
        let mut now_ns = 0;
        let mut pauses = Vec::new();
        for _ in 0..6 {
            assert!(recovery.is_due(now_ns));
            recovery.tried(now_ns);
            let pause = (1..).find(|ms| recovery.is_due(now_ns + ms * 1_000_000));
            pauses.push(pause.unwrap_or(0));
            now_ns += pauses[pauses.len() - 1] * 1_000_000;
        }
        assert_eq!(pauses, [100, 200, 400, 800, 1600, 1600]);
        recovery.note(false);
        assert!(!recovery.is_due(u64::MAX), "the device is back");
    }
}

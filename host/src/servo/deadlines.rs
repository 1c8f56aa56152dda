//! When ticks are due, and how many were missed.

use super::clock::SECOND_NS;

/// Due times of a servo loop: due\[n\] = start + n/rate, without drift.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Schedule {
    rate_hz: u64,
    /// Start of the current second of the loop, ns.
    second_ns: u64,
    /// Ticks since then, below the rate.
    tick: u64,
}

impl Schedule {
    /// The first tick is due at `start_ns`.
    #[must_use]
    pub fn new(rate_hz: u32, start_ns: u64) -> Self {
        Self {
            rate_hz: u64::from(rate_hz.max(1)),
            second_ns: start_ns,
            tick: 0,
        }
    }

    /// When the next tick is due, ns.
    #[must_use]
    pub fn due_ns(&self) -> u64 {
        self.second_ns + self.tick * SECOND_NS / self.rate_hz
    }

    /// Whole periods that have passed since the next tick was due: 0 in time, 1 if it was missed
    /// and the one after it is due.
    #[must_use]
    pub fn missed(&self, now_ns: u64) -> u64 {
        let late_ns = now_ns.saturating_sub(self.due_ns());
        // The common case needs no wide numbers.
        if late_ns < SECOND_NS / self.rate_hz {
            return 0;
        }
        let periods = u128::from(late_ns) * u128::from(self.rate_hz) / u128::from(SECOND_NS);
        periods as u64
    }

    /// Goes on by so many periods.
    pub fn advance(&mut self, periods: u64) {
        let ticks = self.tick + periods;
        if ticks < self.rate_hz {
            self.tick = ticks;
        } else {
            self.second_ns += ticks / self.rate_hz * SECOND_NS;
            self.tick = ticks % self.rate_hz;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn due_times_do_not_drift_at_any_rate() {
        for rate_hz in [250, 1000, 3000, 7919, 10_000] {
            let mut schedule = Schedule::new(rate_hz, 17);
            for tick in 0..3 * u64::from(rate_hz) {
                let exact = 17 + tick * SECOND_NS / u64::from(rate_hz);
                assert_eq!(schedule.due_ns(), exact, "{rate_hz} Hz, tick {tick}");
                schedule.advance(1);
            }
        }
    }

    #[test]
    fn a_tick_is_missed_once_the_next_one_is_due() {
        let schedule = Schedule::new(1000, 5_000_000);
        for (now_ns, missed) in [
            (0, 0),
            (5_000_000, 0),
            (5_999_999, 0),
            (6_000_000, 1),
            (8_500_000, 3),
        ] {
            assert_eq!(schedule.missed(now_ns), missed, "{now_ns}");
        }
        let mut later = schedule;
        later.advance(2500);
        assert_eq!(later.due_ns(), 2_505_000_000);
        assert_eq!(
            Schedule::new(10_000, 0).missed(u64::MAX),
            184_467_440_737_095
        );
    }
}

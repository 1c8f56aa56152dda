//! From what a device says to the sample of a tick.

use crate::device::{Fault, Reading};
use asperity_runtime::Sample;

/// Makes samples of readings. A period without a fresh reading, or after a force that did not reach
/// the device, gives a stale sample. The next fresh one says how many periods have passed.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sampler {
    /// Periods since the last fresh sample.
    elapsed: u32,
    /// The last force did not reach the device.
    force_lost: bool,
}

impl Sampler {
    /// Periods that passed without a tick.
    pub(super) fn pass(&mut self, periods: u64) {
        let periods = u32::try_from(periods).unwrap_or(u32::MAX);
        self.elapsed = self.elapsed.saturating_add(periods);
    }

    /// The sample of a tick, one period after the last.
    pub(super) fn sample(&mut self, reading: &Result<Reading, Fault>) -> Sample {
        self.pass(1);
        match reading {
            Ok(reading) if reading.fresh && !self.force_lost => Sample {
                position_m: reading.position_m,
                elapsed_ticks: std::mem::take(&mut self.elapsed),
            },
            _ => Sample::STALE,
        }
    }

    /// Whether the force of this tick reached the device.
    pub(super) fn written(&mut self, reached: bool) {
        self.force_lost = !reached;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRESH: Reading = Reading {
        position_m: [1.0, 2.0, 3.0],
        fresh: true,
        buttons: 0,
    };
    const OLD: Reading = Reading {
        fresh: false,
        ..FRESH
    };

    #[test]
    fn a_fresh_sample_says_how_many_periods_have_passed() {
        let mut sampler = Sampler::default();
        let mut elapsed = |reading| sampler.sample(&reading).elapsed_ticks;
        assert_eq!(elapsed(Ok(FRESH)), 1);
        assert_eq!(elapsed(Ok(OLD)), 0);
        assert_eq!(elapsed(Err(Fault::TimedOut)), 0);
        assert_eq!(elapsed(Ok(FRESH)), 3);
        assert_eq!(elapsed(Ok(FRESH)), 1);
        sampler.pass(4);
        assert_eq!(sampler.sample(&Ok(FRESH)).elapsed_ticks, 5);
    }

    #[test]
    fn a_lost_force_makes_the_next_sample_stale() {
        let mut sampler = Sampler::default();
        sampler.sample(&Ok(FRESH));
        sampler.written(false);
        let stale = sampler.sample(&Ok(FRESH));
        assert!(stale.elapsed_ticks == 0 && stale.position_m[0].is_nan());
        sampler.written(true);
        assert_eq!(sampler.sample(&Ok(FRESH)).elapsed_ticks, 2);
    }
}

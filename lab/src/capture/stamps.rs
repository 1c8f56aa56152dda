//! Time stamps of a sensor as they come: counters of 32 bits are unwrapped, and a restarted clock is
//! distinguished from stamps that were damaged on the way.

use std::collections::VecDeque;

/// A counter of 32 bits wraps.
const WRAP: f64 = 4_294_967_296.0;
/// Stamps in a row that do not follow those before, at which the clock has started anew.
const ANEW: usize = 64;

/// The stamps of a sensor, in its own unit.
#[derive(Debug, Default)]
pub(super) struct Stamps {
    /// Offset added by its wraps.
    wrapped: f64,
    /// The newest that follow each other.
    recent: VecDeque<f64>,
    /// True if the run was longer than `recent` holds.
    is_long: bool,
    /// Stamps in a row that follow each other, and not the former.
    rival: Vec<f64>,
    /// Number of the recent stamps that the rival replaces, if it is right.
    takes_back: usize,
}

impl Stamps {
    /// A stamp without its wraps. A damaged one is some number, which [`chain`](super::clock::chain)
    /// leaves out in the end. An error is the stamp before a clock that started anew.
    pub(super) fn take(&mut self, raw: f64) -> Result<f64, f64> {
        let mut stamp = raw + self.wrapped;
        let Some(&last) = self.recent.back() else {
            self.recent.push_back(stamp);
            return Ok(stamp);
        };
        if stamp - last < -0.5 * WRAP {
            stamp += WRAP;
        } else if stamp - last > 0.5 * WRAP {
            stamp -= WRAP;
        }
        if stamp >= last {
            self.wrapped = stamp - raw;
            self.rival.clear();
            self.push(stamp);
            return Ok(stamp);
        }
        if self.rival.last().is_none_or(|last| stamp < *last) {
            let after = self
                .recent
                .iter()
                .rev()
                .take_while(|&&former| former > stamp);
            let after = after.count();
            let is_unknown = after == self.recent.len() && self.is_long;
            self.takes_back = if is_unknown { usize::MAX } else { after };
            self.rival.clear();
        }
        self.rival.push(stamp);
        if self.rival.len() > self.takes_back {
            // One of the former was too large, and kept those out that are right.
            self.recent.truncate(self.recent.len() - self.takes_back);
            self.wrapped = stamp - raw;
            for stamp in std::mem::take(&mut self.rival) {
                self.push(stamp);
            }
        } else if self.rival.len() >= ANEW {
            return Err(last);
        }
        Ok(stamp)
    }

    fn push(&mut self, stamp: f64) {
        if self.recent.len() == ANEW {
            self.recent.pop_front();
            self.is_long = true;
        }
        self.recent.push_back(stamp);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(raw: &[f64]) -> Result<Vec<f64>, f64> {
        let mut stamps = Stamps::default();
        raw.iter().map(|raw| stamps.take(*raw)).collect()
    }

    /// So many stamps 500 apart.
    fn even(from: f64, count: usize) -> Vec<f64> {
        (0..count)
            .map(|n| (from + 500.0 * n as f64) % WRAP)
            .collect()
    }

    #[test]
    fn a_counter_goes_on_over_its_wrap_whatever_is_damaged_beside_it() {
        let true_ones = even(WRAP - 50_000.0, 200);
        let whole = taken(&true_ones).expect("a clock");
        assert_eq!(whole[199] - whole[0], 500.0 * 199.0);
        for at in [0, 1, 98, 99, 100, 101, 198, 199] {
            for wrong in [0.0, 4_294_967_295.0, 2e9, 60_000.0] {
                let mut damaged = true_ones.clone();
                damaged[at] = wrong;
                let mut found = taken(&damaged).expect("a clock");
                let mut expected = whole.clone();
                // Its own value is for nobody; the others keep their distances.
                found.remove(at);
                expected.remove(at);
                let distances = |stamps: &[f64]| -> Vec<f64> {
                    stamps
                        .iter()
                        .map(|stamp| stamp - stamps[stamps.len() - 1])
                        .collect()
                };
                assert_eq!(distances(&found), distances(&expected), "{wrong} at {at}");
            }
        }
    }

    #[test]
    fn a_clock_starts_anew_after_64_stamps_and_not_before() {
        let restarted = |count| [even(1e6, 300), even(100.0, count)].concat();
        assert!(taken(&restarted(63)).is_ok());
        assert_eq!(taken(&restarted(64)), Err(1e6 + 500.0 * 299.0));
        // 63 in a row that are too large or too small are damaged ones.
        for by in [400_000.0, -400_000.0] {
            let mut damaged = even(1e6, 3000);
            damaged[2000..2063]
                .iter_mut()
                .for_each(|stamp| *stamp += by);
            let found = taken(&damaged).expect("a clock");
            assert_eq!(
                (found[1999], found[2999]),
                (1e6 + 999_500.0, 1e6 + 1_499_500.0)
            );
        }
        // A few stamps before a restart are no clock to hold on to.
        assert!(taken(&[even(9e6, 30), even(100.0, 500)].concat()).is_ok());
    }
}

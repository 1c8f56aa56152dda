//! Periods between two readings of a device.

use std::sync::Arc;

/// Source of the number of periods between two readings.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Pace {
    /// The clock: a device moves on while periods are missed.
    #[default]
    Clock,
    /// The device moves on by a period from each reading to the next, whatever the clock says.
    Stepped,
    /// A recording: the periods before each of its readings. The loop ends after the last one,
    /// unless the device begins again.
    Recorded {
        /// Periods from the reading before to each reading.
        periods: Arc<[u32]>,
        /// True if the device starts over after its last reading.
        repeats: bool,
    },
}

impl Pace {
    /// Periods before a reading, which is the `tick`th from 0; `passed` went by on the clock.
    pub(super) fn periods(&self, tick: u64, passed: u32) -> u32 {
        match self {
            Self::Clock => passed,
            Self::Stepped => 1,
            Self::Recorded { periods, repeats } => {
                let count = periods.len().max(1) as u64;
                let tick = if *repeats { tick % count } else { tick };
                let told = usize::try_from(tick).ok().and_then(|n| periods.get(n));
                told.copied().unwrap_or(1)
            }
        }
    }

    /// Returns true if a device is at its end after this many readings.
    pub(super) fn is_over(&self, readings: u64) -> bool {
        match self {
            Self::Recorded {
                periods,
                repeats: false,
            } => readings >= periods.len() as u64,
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_recording_says_its_own_periods_and_ends() {
        let recorded = |repeats| Pace::Recorded {
            periods: [1, 3, 2].into(),
            repeats,
        };
        let told = |pace: &Pace| [0, 1, 2, 3, 4].map(|tick| pace.periods(tick, 7));
        assert_eq!(told(&recorded(false)), [1, 3, 2, 1, 1]);
        assert_eq!(told(&recorded(true)), [1, 3, 2, 1, 3]);
        assert_eq!(told(&Pace::Stepped), [1; 5]);
        assert_eq!(told(&Pace::Clock), [7; 5]);
        assert_eq!([2, 3].map(|n| recorded(false).is_over(n)), [false, true]);
        assert!(!recorded(true).is_over(3) && !Pace::Clock.is_over(u64::MAX));
    }
}

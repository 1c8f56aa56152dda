//! The encoders' zero. They count from where the device was switched on, until the grip has been
//! pulled out and pushed in once; then the counts jump to true ones. A force from counts before the
//! jump would be violent, so there is none.

use super::frame::{ALL_HOMED, Answer, led};

/// Consecutive answers with every encoder homed before positions are valid.
const SETTLE: u8 = 8;

/// Homing state of the encoders.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Homing {
    settled: u8,
    homed: u8,
}

impl Homing {
    /// Processes an answer; returns true if its position is valid.
    pub fn step(&mut self, answer: &Answer) -> bool {
        self.homed = answer.homed;
        self.settled = if answer.homed == ALL_HOMED {
            self.settled.saturating_add(1)
        } else {
            0
        };
        self.done()
    }

    /// Returns true once positions are valid.
    #[must_use]
    pub const fn done(&self) -> bool {
        self.settled >= SETTLE
    }

    /// Homed encoders, a bit each.
    #[must_use]
    pub const fn homed(&self) -> u8 {
        self.homed
    }

    /// Returns the indicator light: red while homing, blue once homed.
    #[must_use]
    pub const fn light(&self) -> u8 {
        if self.done() { led::BLUE } else { led::RED }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(homed: u8) -> Answer {
        Answer {
            homed,
            ..Answer::default()
        }
    }

    #[test]
    fn positions_count_once_all_three_are_homed_for_a_while() {
        for partly in 0..ALL_HOMED {
            let mut homing = Homing::default();
            assert!(
                (0..100).all(|_| !homing.step(&answer(partly))),
                "{partly:#b}"
            );
            assert_eq!(homing.light(), led::RED);
        }
        let mut homing = Homing::default();
        let counted = (0..SETTLE).map(|_| homing.step(&answer(ALL_HOMED)));
        assert_eq!(counted.filter(|c| *c).count(), 1, "the last one only");
        assert_eq!(homing.light(), led::BLUE);
    }

    #[test]
    fn a_lost_zero_counts_at_once_and_is_waited_for_again() {
        let mut homing = Homing::default();
        for _ in 0..1000 {
            homing.step(&answer(ALL_HOMED));
        }
        assert!(homing.done() && !homing.step(&answer(0b101)));
        assert!((1..SETTLE).all(|_| !homing.step(&answer(ALL_HOMED))));
        assert!(homing.step(&answer(ALL_HOMED)));
    }
}

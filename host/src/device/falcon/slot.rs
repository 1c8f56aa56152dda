//! The newest answer and the newest command, each in one atomic number: the servo thread and the
//! two that carry bytes exchange them without a lock.
//!
//! ```text
//! bits       0–47                 48–51     52–55     56–63
//! answer     three encoders       buttons   homed     sequence
//! command    three motors         lights    homing    sequence
//! ```
//!
//! The sequence says whether there is something new. It goes round after 255; a reader that misses
//! just so many answers takes the next one for old, once.

use std::sync::atomic::{AtomicU64, Ordering};

use super::frame::{Answer, Command};

/// A slot for the newest of something; the older is overwritten.
#[derive(Debug, Default)]
pub(super) struct Slot(AtomicU64);

/// Snapshot of a slot: its content and its sequence, 0 until the first put.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Held(u64);

impl Slot {
    /// Returns the content of the slot.
    #[must_use]
    pub(super) fn held(&self) -> Held {
        Held(self.0.load(Ordering::Acquire))
    }

    /// Stores an answer. Single producer.
    pub(super) fn put_answer(&self, answer: &Answer) {
        let flags = u64::from(answer.buttons & 0xf) | u64::from(answer.homed & 0x7) << 4;
        self.put(answer.encoders, flags);
    }

    /// Stores a command. Single producer.
    pub(super) fn put_command(&self, command: &Command) {
        let flags = u64::from(command.leds & 0xf) | u64::from(command.homing) << 4;
        self.put(command.motors, flags);
    }

    fn put(&self, numbers: [i16; 3], flags: u64) {
        let sequence = self.held().sequence() % 255 + 1;
        let [a, b, c] = numbers.map(|number| u64::from(number as u16));
        let packed = a | b << 16 | c << 32 | flags << 48 | u64::from(sequence) << 56;
        self.0.store(packed, Ordering::Release);
    }
}

impl Held {
    /// 1 to 255 in turn; 0 for an empty slot.
    #[must_use]
    pub(super) const fn sequence(self) -> u8 {
        (self.0 >> 56) as u8
    }

    /// As an answer.
    #[must_use]
    pub(super) fn answer(self) -> Answer {
        Answer {
            encoders: self.numbers(),
            buttons: (self.0 >> 48) as u8 & 0xf,
            homed: (self.0 >> 52) as u8 & 0x7,
        }
    }

    /// As a command.
    #[must_use]
    pub(super) fn command(self) -> Command {
        Command {
            motors: self.numbers(),
            leds: (self.0 >> 48) as u8 & 0xf,
            homing: self.0 >> 52 & 1 != 0,
        }
    }

    fn numbers(self) -> [i16; 3] {
        std::array::from_fn(|n| (self.0 >> (16 * n)) as i16)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_put_in_comes_out_with_another_sequence() {
        let slot = Slot::default();
        assert_eq!(slot.held().sequence(), 0);
        let mut before = 0;
        for n in 0..1000_i16 {
            let answer = Answer {
                encoders: [n.wrapping_mul(331), -n, i16::MIN],
                homed: (n % 8) as u8,
                buttons: (n % 16) as u8,
            };
            slot.put_answer(&answer);
            let held = slot.held();
            assert!(held.sequence() != before && held.sequence() != 0);
            assert_eq!(held.answer(), answer);
            before = held.sequence();
            let command = Command {
                motors: [n, n.wrapping_mul(-77), i16::MAX],
                leds: 2 * (n % 8) as u8,
                homing: n % 3 == 0,
            };
            slot.put_command(&command);
            assert_eq!(slot.held().command(), command);
            before = before % 255 + 1;
        }
    }

    #[test]
    fn a_reader_never_sees_half_an_answer() {
        let slot = Slot::default();
        std::thread::scope(|scope| {
            let writer = scope.spawn(|| {
                for n in 0..200_000_u32 {
                    let n = n as i16;
                    slot.put_answer(&Answer {
                        encoders: [n, !n, n ^ 0x55],
                        homed: 7,
                        buttons: 0,
                    });
                }
            });
            while !writer.is_finished() {
                let held = slot.held();
                let [a, b, c] = held.answer().encoders;
                assert!(held.sequence() == 0 || (b == !a && c == a ^ 0x55));
            }
        });
    }
}

//! The boot loader: it answers the handshake, repeats every byte of a firmware, and runs it.

use std::collections::VecDeque;

use asperity_host::device::falcon::firmware::{BEGIN, HELLO, HELLO_ANSWER};
use asperity_host::device::falcon::ftdi::{DIVISOR_FIRMWARE, DIVISOR_HANDSHAKE};

use super::image::{Verdict, judge};

/// What users report of real ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Quirks {
    /// Handshakes that meet no answer before the first that does.
    pub deaf: u32,
    /// Loads in which a byte comes back wrong before the first that goes well.
    pub wrong_echoes: u32,
    /// Loads whose echo ends early before the first that goes well.
    pub lost_echoes: u32,
    /// Whether a zero comes before the answer of the handshake.
    pub leading_zero: bool,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum State {
    /// Waits for the handshake; the last bytes that came.
    Waiting(Vec<u8>),
    /// Takes a firmware.
    Loading(Vec<u8>),
    /// Took something that is none.
    Dead,
    Running,
}

#[derive(Debug, Clone)]
pub(super) struct Boot {
    state: State,
    quirks: Quirks,
}

impl Boot {
    pub(super) fn new(quirks: Quirks) -> Self {
        Self {
            state: State::Waiting(Vec::new()),
            quirks,
        }
    }

    pub(super) fn run(&mut self) {
        self.state = State::Running;
    }

    pub(super) fn is_running(&self) -> bool {
        self.state == State::Running
    }

    pub(super) fn reset(&mut self) {
        self.state = State::Waiting(Vec::new());
    }

    /// Takes a byte at the baud rate and line that the computer set.
    pub(super) fn take(&mut self, byte: u8, divisor: u16, dtr: bool, out: &mut VecDeque<u8>) {
        match &mut self.state {
            State::Waiting(seen) if divisor == DIVISOR_HANDSHAKE && dtr => {
                seen.push(byte);
                if seen.ends_with(&HELLO) {
                    seen.clear();
                    if self.quirks.deaf > 0 {
                        self.quirks.deaf -= 1;
                    } else {
                        out.extend(self.quirks.leading_zero.then_some(0));
                        out.extend(HELLO_ANSWER);
                    }
                }
            }
            State::Waiting(_) if divisor == DIVISOR_FIRMWARE && !dtr && byte == BEGIN => {
                out.push_back(BEGIN);
                self.state = State::Loading(Vec::new());
            }
            State::Loading(image) if divisor == DIVISOR_FIRMWARE => {
                image.push(byte);
                let late = image.len() == 3000;
                if late && self.quirks.wrong_echoes > 0 {
                    self.quirks.wrong_echoes -= 1;
                    out.push_back(byte ^ 0x10);
                    self.state = State::Dead;
                } else if late && self.quirks.lost_echoes > 0 {
                    self.quirks.lost_echoes -= 1;
                    self.state = State::Dead;
                } else {
                    out.push_back(byte);
                    match judge(image) {
                        Verdict::More => {}
                        Verdict::Right => self.state = State::Running,
                        Verdict::Wrong => {
                            // It repeats what it gets to the end, and then runs nothing.
                            image.truncate(0);
                            image.push(0);
                        }
                    }
                }
            }
            _ => {}
        }
    }
}

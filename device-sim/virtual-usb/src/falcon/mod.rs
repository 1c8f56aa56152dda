//! A virtual Novint Falcon: serial chip, boot loader, firmware of our own, and a grip in a hand.
//!
//! The real firmware is its maker's and is not here, nor is any of it. The boot loader takes an
//! [`image`] of our own, and what then runs answers frames as the public description says.
//!
//! Simplified: an answer leaves the chip at once, where the real one may hold it for its latency.

mod grip;
pub mod image;

pub use grip::{Grip, MotorStats, TOLD};

use super::{
    Answer, Device, Setup,
    descriptor::{Descriptors, Endpoint, Interface},
};
use asperity_host::device::falcon::{
    firmware::{BEGIN, HELLO, HELLO_ANSWER},
    frame::{Answer as Reading, Command, FRAME_BYTES},
    ftdi::{
        DIVISOR_FIRMWARE, DIVISOR_HANDSHAKE, DIVISOR_RUNNING, ENDPOINT_IN, ENDPOINT_OUT,
        PAYLOAD_BYTES, Setting,
    },
};
use image::{Verdict, judge};
use std::collections::VecDeque;

/// Status bytes that the chip puts before every packet: lines as they are at rest.
const STATUS: [u8; 2] = [0x01, 0x60];
/// Bytes that the chip holds for a computer that does not fetch them.
const HELD_BYTES: usize = 256;

/// A virtual Falcon.
#[derive(Debug, Clone)]
pub struct Falcon {
    descriptors: Descriptors,
    boot: Boot,
    /// The grip and the hand that holds it.
    pub grip: Grip,
    /// Time that a command lasts, s. Without it time passes by [`Device::advance`] alone.
    frame_s: Option<f64>,
    divisor: u16,
    latency_s: f64,
    dtr: bool,
    idle_s: f64,
    to_computer: VecDeque<u8>,
    /// Bytes of a command that is not complete.
    pending: Vec<u8>,
    /// Bytes that belonged to no command.
    pub skipped: u64,
}

impl Falcon {
    /// A Falcon that was just switched on: it waits for its firmware.
    #[must_use]
    pub fn new(quirks: Quirks) -> Self {
        let endpoint = |address| Endpoint {
            address,
            kind: 2,
            packet_bytes: 64,
            interval_ms: 0,
        };
        Self {
            descriptors: Descriptors {
                vendor: 0x0403,
                product: 0xcb48,
                release: 0x0400,
                class: 0,
                strings: ["Asperity", "virtual Falcon", "VF0001"].map(String::from),
                interfaces: vec![Interface {
                    class: [0xff; 3],
                    class_descriptors: Vec::new(),
                    endpoints: vec![endpoint(ENDPOINT_IN), endpoint(ENDPOINT_OUT)],
                }],
            },
            boot: Boot::new(quirks),
            grip: Grip::new(),
            frame_s: None,
            divisor: 0,
            latency_s: 0.016,
            dtr: false,
            idle_s: 0.0,
            to_computer: VecDeque::new(),
            pending: Vec::new(),
            skipped: 0,
        }
    }

    /// A Falcon whose firmware runs already.
    #[must_use]
    pub fn running() -> Self {
        let mut falcon = Self::new(Quirks::default());
        falcon.boot.run();
        falcon
    }

    /// Has every command last `seconds` for the hand and the grip, whatever the clock says: a
    /// session is then the same at any rate.
    #[must_use]
    pub fn paced_by_commands(mut self, seconds: f64) -> Self {
        self.frame_s = Some(seconds);
        self
    }

    /// Returns true while its firmware runs.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.boot.is_running()
    }

    /// Its power goes and comes back: firmware and zeros of the encoders are lost.
    pub fn lose_power(&mut self) {
        self.boot.reset();
        self.grip.forget_zeros();
        self.to_computer.clear();
        self.pending.clear();
    }

    fn take(&mut self, byte: u8) {
        if !self.is_running() {
            self.boot
                .take(byte, self.divisor, self.dtr, &mut self.to_computer);
            return;
        }
        if self.divisor != DIVISOR_RUNNING {
            self.skipped += 1;
            return;
        }
        self.pending.push(byte);
        if self.pending.len() == 1 && byte != b'<' {
            self.pending.clear();
            self.skipped += 1;
            return;
        }
        let Ok(frame) = <&[u8; FRAME_BYTES]>::try_from(&self.pending[..]) else {
            return;
        };
        match Command::decode(frame) {
            Some(command) => {
                self.pending.clear();
                self.obey(&command);
            }
            None => {
                let next = self.pending[1..].iter().position(|byte| *byte == b'<');
                let dropped = next.map_or(FRAME_BYTES, |n| n + 1);
                self.skipped += dropped as u64;
                self.pending.drain(..dropped);
            }
        }
    }

    fn obey(&mut self, command: &Command) {
        self.grip.command(command);
        if let Some(seconds) = self.frame_s {
            self.grip.advance(seconds);
        }
        let reading = Reading {
            encoders: self.grip.encoders(),
            homed: self.grip.homed(),
            buttons: 0,
        };
        if self.to_computer.len() + FRAME_BYTES <= HELD_BYTES {
            self.to_computer.extend(reading.encode());
        }
    }
}

impl Device for Falcon {
    fn descriptors(&self) -> &Descriptors {
        &self.descriptors
    }

    fn control(&mut self, setup: &Setup, _: &[u8]) -> Answer {
        if setup.request_type != 0x40 || setup.index != 0 {
            return Answer::Stall;
        }
        match Setting::of(setup.request, setup.value) {
            Some(Setting::PurgeReceived) => self.to_computer.clear(),
            Some(Setting::PurgeSent) => self.pending.clear(),
            Some(Setting::Divisor(divisor)) => self.divisor = divisor,
            Some(Setting::LatencyMs(ms)) => self.latency_s = f64::from(ms) * 1e-3,
            Some(Setting::Dtr(on)) => {
                if on && !self.dtr {
                    // A rising line resets the processor.
                    self.boot.reset();
                    self.grip.forget_zeros();
                }
                self.dtr = on;
            }
            Some(Setting::Rts(_) | Setting::NoFlowControl | Setting::EightNone1) => {}
            None => return Answer::Stall,
        }
        Answer::Done(Vec::new())
    }

    fn write(&mut self, _: u8, bytes: &[u8]) -> Answer {
        for byte in bytes {
            self.take(*byte);
        }
        Answer::Done(Vec::new())
    }

    fn read(&mut self, _: u8, most: usize) -> Answer {
        if self.to_computer.is_empty() && self.idle_s < self.latency_s {
            return Answer::Pending;
        }
        self.idle_s = 0.0;
        let room = most.saturating_sub(STATUS.len()).min(PAYLOAD_BYTES);
        let count = room.min(self.to_computer.len());
        let mut packet = STATUS.to_vec();
        packet.extend(self.to_computer.drain(..count));
        packet.truncate(most);
        Answer::Done(packet)
    }

    fn advance(&mut self, seconds: f64) {
        self.idle_s += seconds;
        if self.frame_s.is_none() {
            self.grip.advance(seconds);
        }
    }

    fn plugged_in(&mut self) {
        // The chip lives on USB's power, the rest on its own supply.
        self.grip.plugged_in();
        self.divisor = 0;
        self.latency_s = 0.016;
        self.to_computer.clear();
        self.pending.clear();
    }
}

// The boot loader: it answers the handshake, repeats every byte of a firmware, and runs it.

/// Boot-loader quirks that users report of real devices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Quirks {
    /// Handshakes left unanswered before the first answer.
    pub deaf: u32,
    /// Loads with a corrupted echo before the first that succeeds.
    pub wrong_echoes: u32,
    /// Loads with a truncated echo before the first that succeeds.
    pub lost_echoes: u32,
    /// True if a zero byte precedes the answer to the handshake.
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
struct Boot {
    state: State,
    quirks: Quirks,
}

impl Boot {
    fn new(quirks: Quirks) -> Self {
        Self {
            state: State::Waiting(Vec::new()),
            quirks,
        }
    }

    fn run(&mut self) {
        self.state = State::Running;
    }

    fn is_running(&self) -> bool {
        self.state == State::Running
    }

    fn reset(&mut self) {
        self.state = State::Waiting(Vec::new());
    }

    /// Takes a byte at the baud rate and line that the computer set.
    fn take(&mut self, byte: u8, divisor: u16, dtr: bool, out: &mut VecDeque<u8>) {
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

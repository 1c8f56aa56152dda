//! The firmware's way into a Falcon. The device has none of its own after power-up.
//!
//! ```text
//! 9600 Bd    → 0a 43 0d      ← (00) 0a 44 2c 0d      repeated until it answers
//! 143 kBd    → 41            ← 41
//!            → 62 bytes      ← the same 62 bytes     until the file ends
//! 1.5 MBd    → a command     ← an answer             it runs
//! ```
//!
//! The firmware is its maker's and is not part of Asperity: the user names a file. A byte that
//! comes back otherwise than it went out ends the try, and another begins.

use std::time::{Duration, Instant};

use thiserror::Error;

use super::frame::{Answer, Command, Frames};
use super::ftdi::{self, FIRMWARE, HANDSHAKE, PACKET_BYTES, PAYLOAD_BYTES, RUNNING, payload, set};
use super::transport::{Direction, TransferError, Transport};

/// Largest firmware that is read; those that are known have 8 KiB.
pub const MAX_BYTES: usize = 64 * 1024;
/// Handshake of the boot loader. Its answer, [`HELLO_ANSWER`], may follow a zero.
pub const HELLO: [u8; 3] = [0x0a, 0x43, 0x0d];
/// Answer to [`HELLO`].
pub const HELLO_ANSWER: [u8; 4] = [0x0a, 0x44, 0x2c, 0x0d];
/// Start byte of the transfer; the device echoes it.
pub const BEGIN: u8 = 0x41;

/// Time of one transfer.
const PATIENCE: Duration = Duration::from_millis(500);
/// Packets that an answer may take; an empty one comes every 16 ms.
const PACKETS: usize = 20;
/// Questions until the handshake is given up.
const QUESTIONS: usize = 20;

/// Why a Falcon has no firmware that runs.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FirmwareError {
    /// The file has no bytes, or too many.
    #[error("a firmware of {0} bytes; it must have 1 to {MAX_BYTES}")]
    Size(usize),
    /// The device did not answer the handshake.
    #[error("the device does not answer the handshake for its firmware")]
    NoHandshake,
    /// The device did not answer the byte that begins the transfer.
    #[error("the device does not begin to take its firmware")]
    NoBegin,
    /// Not every byte came back.
    #[error("the device repeated {0} bytes of its firmware, then nothing")]
    EchoEnds(usize),
    /// A byte came back otherwise.
    #[error("byte {offset} of the firmware went as {sent:#04x} and came back as {got:#04x}")]
    EchoDiffers {
        /// Which byte, from 0.
        offset: usize,
        /// Byte sent.
        sent: u8,
        /// Byte echoed.
        got: u8,
    },
    /// The firmware is in the device and does not run.
    #[error("the firmware was taken, but the device answers no command")]
    Silent,
    /// A transfer failed.
    #[error("{0}")]
    Transfer(#[from] TransferError),
}

impl FirmwareError {
    /// Returns a remedy for the user.
    #[must_use]
    pub const fn remedy(&self) -> &'static str {
        match self {
            Self::Size(_) => "name the firmware file of a Falcon, some 8 KB",
            Self::NoHandshake | Self::NoBegin => {
                "switch the Falcon's power off and on, wait for 5 s and try again; use a port of the \
                 computer or a powered hub"
            }
            Self::EchoEnds(_) | Self::EchoDiffers { .. } => {
                "try again with more tries (`falcon:?tries=20`); use another cable or a powered hub"
            }
            Self::Silent => "check that the file is a firmware of the Falcon, then try again",
            Self::Transfer(TransferError::Disconnected) => "plug the Falcon in again",
            Self::Transfer(_) => "plug the Falcon out and in, then try again",
        }
    }
}

/// Loads a firmware, in as many tries as it takes up to `tries`; gives how many it took.
///
/// # Errors
/// What the last try met.
pub fn load(transport: &dyn Transport, bytes: &[u8], tries: u32) -> Result<u32, FirmwareError> {
    if bytes.is_empty() || bytes.len() > MAX_BYTES {
        return Err(FirmwareError::Size(bytes.len()));
    }
    let mut last = FirmwareError::NoHandshake;
    for n in 1..=tries.max(1) {
        match load_once(transport, bytes) {
            Ok(()) => return Ok(n),
            Err(FirmwareError::Transfer(TransferError::Disconnected)) => {
                return Err(TransferError::Disconnected.into());
            }
            Err(error) => last = error,
        }
        // An endpoint may have stalled; a stall that is none is no error either.
        for direction in [Direction::In, Direction::Out] {
            let _ = transport.clear_stall(direction);
        }
    }
    Err(last)
}

fn load_once(transport: &dyn Transport, bytes: &[u8]) -> Result<(), FirmwareError> {
    set(transport, &HANDSHAKE)?;
    handshake(transport)?;
    set(transport, &FIRMWARE)?;
    send(transport, &[BEGIN])?;
    let mut echo = [0];
    if receive(transport, &mut echo)? != 1 || echo[0] != BEGIN {
        return Err(FirmwareError::NoBegin);
    }
    let mut offset = 0;
    for chunk in bytes.chunks(PAYLOAD_BYTES) {
        send(transport, chunk)?;
        let mut echo = [0; PAYLOAD_BYTES];
        let got = receive(transport, &mut echo[..chunk.len()])?;
        let mut pairs = chunk.iter().zip(&echo[..got]);
        if let Some(wrong) = pairs.position(|(sent, got)| sent != got) {
            return Err(FirmwareError::EchoDiffers {
                offset: offset + wrong,
                sent: chunk[wrong],
                got: echo[wrong],
            });
        }
        if got < chunk.len() {
            return Err(FirmwareError::EchoEnds(offset + got));
        }
        offset += chunk.len();
    }
    set(transport, &RUNNING)?;
    answers(transport)?.map(drop).ok_or(FirmwareError::Silent)
}

fn handshake(transport: &dyn Transport) -> Result<(), FirmwareError> {
    for _ in 0..QUESTIONS {
        send(transport, &HELLO)?;
        // The leading zero comes on some systems and not on others.
        let mut answer = [0; HELLO_ANSWER.len() + 1];
        let complete = |seen: &[u8]| seen.strip_prefix(&[0]).unwrap_or(seen) == HELLO_ANSWER;
        let got = receive_until(transport, &mut answer, complete)?;
        if complete(&answer[..got]) {
            return Ok(());
        }
        set(transport, &[ftdi::Setting::PurgeReceived])?;
    }
    Err(FirmwareError::NoHandshake)
}

/// Returns the first answer to a command without force if a firmware runs, else `None`.
///
/// # Errors
/// [`TransferError`] if the device is gone or refuses transfers.
pub fn answers(transport: &dyn Transport) -> Result<Option<Answer>, TransferError> {
    let mut frames = Frames::default();
    // The first command often meets a device that is still in the middle of another.
    for _ in 0..10 {
        let command = Command {
            homing: true,
            ..Command::default()
        };
        match transport.send(&command.encode(), PATIENCE) {
            Err(TransferError::TimedOut) => continue,
            other => other?,
        };
        let begun = Instant::now();
        while begun.elapsed() < Duration::from_millis(30) {
            let mut packet = [0; PACKET_BYTES];
            match transport.receive(&mut packet, Duration::from_millis(30)) {
                Ok(length) => {
                    if let Some(answer) = frames.push(payload(&packet[..length])) {
                        return Ok(Some(answer));
                    }
                }
                Err(TransferError::TimedOut) => break,
                Err(error) => return Err(error),
            }
        }
    }
    Ok(None)
}

fn send(transport: &dyn Transport, bytes: &[u8]) -> Result<(), TransferError> {
    let sent = transport.send(bytes, PATIENCE)?;
    if sent == bytes.len() {
        Ok(())
    } else {
        Err(TransferError::Failed)
    }
}

/// Fills `bytes` from as many packets as it takes; gives how many came before the device fell
/// silent. More than `bytes` takes is lost.
fn receive(transport: &dyn Transport, bytes: &mut [u8]) -> Result<usize, TransferError> {
    receive_until(transport, bytes, |_| false)
}

/// As [`receive`], until what came is `complete`.
fn receive_until(
    transport: &dyn Transport,
    bytes: &mut [u8],
    complete: impl Fn(&[u8]) -> bool,
) -> Result<usize, TransferError> {
    let mut got = 0;
    for _ in 0..PACKETS {
        let mut packet = [0; PACKET_BYTES];
        let length = match transport.receive(&mut packet, PATIENCE) {
            Ok(length) => length,
            Err(TransferError::TimedOut) => break,
            Err(error) => return Err(error),
        };
        let payload = payload(&packet[..length]);
        let taken = payload.len().min(bytes.len() - got);
        bytes[got..got + taken].copy_from_slice(&payload[..taken]);
        got += taken;
        if got == bytes.len() || complete(&bytes[..got]) {
            break;
        }
    }
    Ok(got)
}

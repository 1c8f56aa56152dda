//! A Novint Falcon over its openly documented protocol.
//!
//! | file | holds |
//! |---|---|
//! | [`frame`] | commands and answers of 16 bytes |
//! | [`ftdi`] | settings of the serial chip |
//! | [`transport`] | what carries bytes |
//! | [`firmware`] | handshake, transfer with a checked echo, retries |
//! | [`homing`] | when positions can be trusted |
//! | [`geometry`], [`kinematics`], [`motors`] | angles, positions, forces |
//! | `slot`, [`link`] | two threads that carry frames, and what they share |
//! | [`settings`] | what a URI says |
//! | `open`, `on_usb` | finding, claiming and opening it |
//!
//! Source of the protocol and of the measures: libnifalcon (BSD). The code is our own. **Nothing
//! here has been confirmed on a device.**

pub mod firmware;
pub mod frame;
pub mod ftdi;
pub mod geometry;
pub mod homing;
pub mod kinematics;
pub mod link;
pub mod motors;
#[cfg(feature = "usb")]
pub mod on_usb;
mod open;
pub mod settings;
mod slot;
pub mod transport;

use std::sync::Arc;
use std::time::{Duration, Instant};

use firmware::FirmwareError;
use frame::Command;
use geometry::{CENTRE_M, CONTINUOUS_FORCE_N};
use homing::Homing;
use link::{Link, LinkCounts};
pub use open::{OpenError, Opened, Opener};
use settings::Settings;
use transport::{Direction, Transport};

use super::{Description, Device, DeviceError, Reading};

/// A Falcon that is open.
///
/// Its world frame has the origin in the middle of the workspace, x to the right, y up and z
/// towards the user. Until its encoders are homed, [`Device::read`] gives
/// [`DeviceError::NotCalibrated`]: a person pulls the grip out as far as it goes and pushes it in once.
pub struct Falcon {
    opener: Box<dyn Opener>,
    settings: Settings,
    description: Description,
    link: Option<Link>,
    homing: Homing,
    /// Sequence of the answer that was read last.
    seen: u8,
    last: Option<(Reading, [f64; 3])>,
    encoders: Option<([i16; 3], Instant)>,
    /// Readings in a row that brought nothing new.
    stale: u32,
    counts_before: LinkCounts,
}

impl Falcon {
    /// Opens what `opener` gives, loads the firmware if the device has none, and begins to talk.
    ///
    /// # Errors
    /// [`OpenError`] with what is missing and what to do.
    pub fn open(mut opener: Box<dyn Opener>, settings: Settings) -> Result<Self, OpenError> {
        let (link, serial) = start(&mut *opener, &settings)?;
        Ok(Self {
            opener,
            description: Description {
                name: "Novint Falcon".into(),
                serial,
                peak_force_n: settings.peak_n,
                continuous_force_n: if settings.peak_n < CONTINUOUS_FORCE_N {
                    settings.peak_n
                } else {
                    CONTINUOUS_FORCE_N
                },
                unconfirmed: [
                    "The protocol follows its public description; no device has run it.",
                    "Measures of the legs and counts per torque are as published.",
                    "Peak force as its maker published; the continuous force is a cautious guess.",
                ]
                .map(String::from)
                .to_vec(),
            },
            settings,
            link: Some(link),
            homing: Homing::default(),
            seen: 0,
            last: None,
            encoders: None,
            stale: 0,
            counts_before: LinkCounts::default(),
        })
    }

    /// Returns the link statistics, summed over every time the device was opened.
    #[must_use]
    pub fn counts(&self) -> LinkCounts {
        let now = self.link.as_ref().map(Link::counts).unwrap_or_default();
        self.counts_before + now
    }

    /// Homed encoders, a bit each.
    #[must_use]
    pub fn homed(&self) -> u8 {
        self.homing.homed()
    }

    fn link(&self) -> Result<&Link, DeviceError> {
        let link = self.link.as_ref().ok_or(DeviceError::Disconnected)?;
        link.fault().map_or(Ok(link), Err)
    }

    fn command(&self, motors: [i16; 3]) -> Result<(), DeviceError> {
        self.link()?.command(&Command {
            motors,
            leds: self.homing.light(),
            homing: true,
        });
        Ok(())
    }
}

impl Device for Falcon {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        let held = self.link()?.newest();
        if held.sequence() == self.seen {
            self.stale = self.stale.saturating_add(1);
            let stale = self.last.map(|(reading, _)| Reading {
                fresh: false,
                ..reading
            });
            return stale.ok_or(if held.sequence() == 0 {
                DeviceError::TimedOut
            } else {
                DeviceError::NotCalibrated
            });
        }
        self.seen = held.sequence();
        self.stale = 0;
        let answer = held.answer();
        if !self.homing.step(&answer) {
            self.last = None;
            self.encoders = None;
            return Err(DeviceError::NotCalibrated);
        }
        let now = Instant::now();
        let before = self.encoders.replace((answer.encoders, now));
        if before.is_some_and(|(before, at)| jumps(before, answer.encoders, now - at)) {
            return Err(DeviceError::Garbled);
        }
        let angles = answer.encoders.map(geometry::angle);
        let position = kinematics::forward(angles).ok_or(DeviceError::Garbled)?;
        let reading = Reading {
            position_m: std::array::from_fn(|n| (position[n] - CENTRE_M[n]) as f32),
            fresh: true,
            buttons: u32::from(answer.buttons),
        };
        self.last = Some((reading, position));
        Ok(reading)
    }

    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        let force = motors::limited(force_n, self.settings.peak_n);
        if force == [0.0; 3] {
            return self.command([0; 3]);
        }
        let Some((_, position)) = self.last else {
            self.command([0; 3])?;
            return Err(DeviceError::NotCalibrated);
        };
        if self.stale > STALE {
            self.command([0; 3])?;
            return Err(DeviceError::TimedOut);
        }
        let jacobian = kinematics::inverse(position)
            .and_then(|angles| kinematics::jacobian(position, angles))
            .and_then(|rows| motors::counts(force, &rows));
        match jacobian {
            Some(counts) => self.command(counts),
            None => {
                self.command([0; 3])?;
                Err(DeviceError::Garbled)
            }
        }
    }

    fn recover(&mut self) -> Result<(), DeviceError> {
        if self.link().is_err() {
            self.counts_before = self.counts();
            self.last = None;
            self.encoders = None;
            self.seen = 0;
            self.homing = Homing::default();
            // The old threads end before the device is opened anew.
            self.link = None;
            let (link, serial) = start(&mut *self.opener, &self.settings).map_err(|e| e.fault())?;
            self.description.serial = serial;
            self.link = Some(link);
        }
        // Answers come only to commands.
        for _ in 0..50 {
            self.command([0; 3])?;
            std::thread::sleep(Duration::from_millis(2));
            match self.read() {
                Ok(_) => return Ok(()),
                Err(DeviceError::NotCalibrated | DeviceError::TimedOut) => {}
                Err(fault) => return Err(fault),
            }
        }
        Err(if self.seen == 0 {
            DeviceError::TimedOut
        } else {
            DeviceError::NotCalibrated
        })
    }
}

/// Readings in a row without anything new after which there is no force: it would be one for where
/// the grip was.
const STALE: u32 = 20;

/// Counts that no thigh turns between two answers that follow each other at once, in a millisecond
/// more, and at all: some 4, 2.5 and 20 mm. A frame torn in the middle of a number is off by a
/// multiple of 16, 256 or 4096 counts: 16 are 0.6 mm, and 256 are refused where answers come within
/// 2.5 ms.
const JUMP: f32 = 96.0;
const JUMP_PER_MS: f32 = 64.0;
const LARGEST_JUMP: f32 = 512.0;

/// Returns true if two answers are too far apart to be consecutive. The protocol has no checksum,
/// so a frame that lost its middle looks valid. It is rejected once; the next answer is compared
/// with it.
fn jumps(before: [i16; 3], after: [i16; 3], between: Duration) -> bool {
    let moved = JUMP + JUMP_PER_MS * between.as_secs_f32() * 1e3;
    let limit = if moved < LARGEST_JUMP {
        moved as i32
    } else {
        LARGEST_JUMP as i32
    };
    let mut pairs = before.into_iter().zip(after);
    pairs.any(|(before, after)| (i32::from(after) - i32::from(before)).abs() > limit)
}

/// Opens the device and has its firmware run.
fn start(
    opener: &mut dyn Opener,
    settings: &Settings,
) -> Result<(Link, Option<String>), OpenError> {
    let Opened { transport, serial } = opener.open()?;
    make_run(&transport, settings)?;
    let link = Link::start(transport, settings.motor_step).map_err(OpenError::Thread)?;
    Ok((link, serial))
}

fn make_run(transport: &Arc<dyn Transport>, settings: &Settings) -> Result<(), OpenError> {
    // A stall stays with the endpoint, whoever had the device open when it came.
    let running = transport
        .clear_stall(Direction::In)
        .and_then(|()| transport.clear_stall(Direction::Out))
        .and_then(|()| ftdi::set(&**transport, &ftdi::RUNNING))
        .and_then(|()| firmware::answers(&**transport))
        .map_err(FirmwareError::from)?;
    if running.is_some() {
        return Ok(());
    }
    let bytes = settings.firmware_bytes()?.ok_or(OpenError::NoFirmware)?;
    firmware::load(&**transport, &bytes, settings.tries)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn torn_numbers_are_refused_and_fast_hands_are_not() {
        let after = |counts: i16, ms: f32| {
            let between = Duration::from_secs_f32(1e-3 * ms);
            jumps([7, -300, 0], [7, -300 + counts, 0], between)
        };
        for ms in [0.0, 0.3, 1.0, 2.0] {
            assert!(
                after(256, ms) && after(-256, ms) && after(4096, ms),
                "{ms} ms"
            );
        }
        assert!(after(4096, 1000.0));
        for ms in [0.3_f32, 1.0, 3.0, 5.0] {
            // 2 m/s, at 26 counts a millimetre.
            let counts = (2.0 * 26.0 * ms) as i16;
            assert!(!after(counts, ms) && !after(-counts, ms), "{ms} ms");
        }
    }
}

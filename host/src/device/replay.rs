//! A recorded session as a device: it moves as the hand did, whatever force it is given.

use std::path::Path;

use super::{Description, Device, DeviceError, Reading, Uri, UriError};
use crate::session_log::{Ending, SessionLog, SessionLogError};

/// Behaviour after the last tick of a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AtEnd {
    /// The device is gone.
    #[default]
    Leave,
    /// The recording begins again.
    Loop,
}

/// Why a recording cannot be a device.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReplayError {
    /// A setting that a replay does not have.
    #[error(transparent)]
    Uri(#[from] UriError),
    /// The URI names no file.
    #[error("replay: names no file; write replay:FILE")]
    NoFile,
    /// A setting with another value than those that there are.
    #[error("replay: setting end={0}: it is `leave` or `loop`")]
    End(String),
    /// The file cannot be read.
    #[error("{path}: {source}")]
    File {
        /// The file.
        path: String,
        /// Why.
        source: SessionLogError,
    },
    /// The file has no tick.
    #[error("{0}: the recording has no tick")]
    Empty(String),
}

impl ReplayError {
    /// Returns a remedy for the user.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::File { source, .. } => source.remedy(),
            Self::Empty(_) => "record for longer",
            _ => "write replay:FILE, or replay:FILE?end=loop",
        }
    }
}

/// A recorded session.
///
/// Each reading is the next recorded tick, its faults included. Periods that the recorded loop
/// missed cannot be missed again, so forces repeat to the bit where none was missed;
/// [`render_again`](crate::session_log::render_again) repeats them in any case.
#[derive(Debug)]
pub struct Replay {
    description: Description,
    recording: SessionLog,
    at_end: AtEnd,
    /// The tick that was read last, plus one.
    next: usize,
    last: Reading,
    different: u64,
    written: u64,
}

impl Replay {
    /// Opens the file of a URI: `replay:FILE?end=leave|loop`.
    ///
    /// # Errors
    /// [`ReplayError`].
    pub fn open(uri: &Uri) -> Result<Self, ReplayError> {
        uri.allow(&["end"])?;
        if uri.which.is_empty() {
            return Err(ReplayError::NoFile);
        }
        let at_end = match uri.setting("end") {
            None | Some("leave") => AtEnd::Leave,
            Some("loop") => AtEnd::Loop,
            Some(other) => return Err(ReplayError::End(other.into())),
        };
        let recording =
            SessionLog::open(Path::new(&uri.which)).map_err(|source| ReplayError::File {
                path: uri.which.clone(),
                source,
            })?;
        Self::new(recording, at_end, &uri.which)
    }

    /// A recording that was read; `name` is for reports.
    ///
    /// # Errors
    /// [`ReplayError::Empty`].
    pub fn new(recording: SessionLog, at_end: AtEnd, name: &str) -> Result<Self, ReplayError> {
        if recording.entries.is_empty() {
            return Err(ReplayError::Empty(name.into()));
        }
        let peak_n = recording.conditions.config.limits.peak_n;
        let ticks = recording.entries.len();
        let cut = match recording.ending {
            Ending::Whole(_) => String::new(),
            Ending::Cut { why, .. } => format!(", cut: {why}"),
        };
        Ok(Self {
            description: Description {
                name: format!(
                    "recording of {} ({ticks} ticks{cut})",
                    recording.conditions.device
                ),
                serial: None,
                peak_force_n: peak_n,
                continuous_force_n: peak_n,
                unconfirmed: Vec::new(),
            },
            recording,
            at_end,
            next: 0,
            last: Reading {
                position_m: [0.0; 3],
                fresh: false,
                buttons: 0,
            },
            different: 0,
            written: 0,
        })
    }

    /// The recording.
    #[must_use]
    pub fn recording(&self) -> &SessionLog {
        &self.recording
    }

    /// Forces that were written, and how many of them differ in a bit from those of the recording.
    #[must_use]
    pub fn compared(&self) -> (u64, u64) {
        (self.written, self.different)
    }
}

impl Device for Replay {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        let entries = &self.recording.entries;
        if self.next == entries.len() && self.at_end == AtEnd::Loop {
            self.next = 0;
        }
        let entry = entries.get(self.next).ok_or(DeviceError::Disconnected)?;
        self.next += 1;
        if let Some(fault) = entry.read_fault {
            return Err(fault);
        }
        let fresh = entry.sample.elapsed_ticks > 0;
        self.last = Reading {
            position_m: if fresh {
                entry.sample.position_m
            } else {
                self.last.position_m
            },
            fresh,
            buttons: entry.buttons,
        };
        Ok(self.last)
    }

    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        let recorded = self
            .next
            .checked_sub(1)
            .and_then(|n| self.recording.entries.get(n));
        if let Some(entry) = recorded {
            self.written += 1;
            let same = entry.force_n.map(f32::to_bits) == force_n.map(f32::to_bits);
            self.different += u64::from(!same);
        }
        Ok(())
    }

    fn recover(&mut self) -> Result<(), DeviceError> {
        if self.next < self.recording.entries.len() || self.at_end == AtEnd::Loop {
            Ok(())
        } else {
            Err(DeviceError::Disconnected)
        }
    }
}

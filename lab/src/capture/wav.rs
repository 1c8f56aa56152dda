//! A WAV file that another program is writing, such as `arecord` or `sox`.
//!
//! Such a program states a length that is 0, or far too large, until it ends; the length of the file
//! is what counts here. Everything else of the header must stay.

use super::columns::{Column, Layout};
use super::error::SensorError;
use super::samples::{Counts, Samples};
use super::source::Source;
use asperity_recording::reader::wav::{self, ParsedHeader, Wav as Format};
use std::fs::{self, File};
use std::io::{self, Read as _, Seek as _, SeekFrom};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

/// Rates of a sensor, Hz.
const RATES_HZ: RangeInclusive<u32> = 10..=200_000;
/// Time between two looks at the file.
const LOOK: Duration = Duration::from_millis(2);
/// Looks between two looks at the header.
const SELDOM: u32 = 250;
/// Bytes that are read at once.
const PIECE: u64 = 256 * 1024;

/// A growing WAV file.
#[derive(Debug)]
pub struct Wav {
    name: String,
    path: PathBuf,
    open: Option<(File, Format)>,
    asked: Option<Layout>,
    layout: Option<Layout>,
    /// Value of full scale of each channel, in its unit.
    full: Full,
    frames: u64,
    counts: Counts,
    looks: u32,
    bytes: Vec<u8>,
}

/// Full scale: g of an acceleration, N of a force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Full {
    /// In the units of acceleration channels.
    pub acceleration: f64,
    /// In the units of force channels.
    pub force: f64,
}

impl Wav {
    /// Follows a file, which need not be there yet. Without `layout` it has one channel, or three.
    #[must_use]
    pub fn follow(path: &Path, layout: Option<Layout>, full: Full) -> Self {
        Self {
            name: path.display().to_string(),
            path: path.to_owned(),
            open: None,
            asked: layout,
            layout: None,
            full,
            frames: 0,
            counts: Counts::default(),
            looks: 0,
            bytes: Vec::new(),
        }
    }

    fn fail(&self, cause: io::Error) -> SensorError {
        SensorError::Read {
            name: self.name.clone(),
            cause,
        }
    }

    /// Opens the file once its header is whole.
    fn begin(&mut self) -> Result<(), SensorError> {
        let fail = |cause| SensorError::Open {
            name: self.name.clone(),
            cause,
        };
        // Opening a pipe would wait for its writer.
        let opened = fs::metadata(&self.path).and_then(|data| {
            if !data.is_file() {
                return Err(io::Error::other("it is no file"));
            }
            File::open(&self.path)
        });
        let mut file = match opened {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
            Err(cause) => return Err(fail(cause)),
        };
        let header = |why: String| SensorError::Header {
            name: self.name.clone(),
            why,
        };
        let Some(format) = read_header(&mut file, &self.name)? else {
            return Ok(());
        };
        let layout = match &self.asked {
            Some(layout) if layout.columns().len() == format.channels => layout.clone(),
            Some(layout) => {
                return Err(header(format!(
                    "states {} channels, and {} columns are named",
                    format.channels,
                    layout.columns().len()
                )));
            }
            None => Layout::of_width(format.channels)
                .ok_or_else(|| header(format!("states {} channels", format.channels)))?,
        };
        if layout
            .columns()
            .iter()
            .any(|column| matches!(column, Column::Clock(_) | Column::Count))
        {
            return Err(header("has no place for a clock".into()));
        }
        self.layout = Some(layout);
        self.open = Some((file, format));
        Ok(())
    }

    /// Refuses a file that is another one now.
    fn check_header(&mut self) -> Result<(), SensorError> {
        let Some((file, format)) = &mut self.open else {
            return Ok(());
        };
        let changed = |what| SensorError::Changed {
            name: self.name.clone(),
            what,
        };
        if is_another(file, &self.path) {
            return Err(changed("it was replaced"));
        }
        match read_header(file, &self.name) {
            Ok(Some(now)) if now == *format => Ok(()),
            _ => Err(changed("its header changed")),
        }
    }

    /// Reads the frames that are whole.
    fn frames(&mut self, into: &mut Samples) -> Result<(), SensorError> {
        let Some((file, format)) = &mut self.open else {
            return Ok(());
        };
        let width = format.width() as u64;
        let length = file.metadata().map(|data| data.len());
        let seek = format.begin + self.frames * width;
        let piece = length.and_then(|length| {
            if length < seek {
                return Ok(None);
            }
            let whole = ((length - seek) / width).min(PIECE / width) * width;
            self.bytes.resize(whole as usize, 0);
            file.seek(SeekFrom::Start(seek))?;
            file.read_exact(&mut self.bytes)?;
            Ok(Some(()))
        });
        let format = *format;
        match piece {
            Ok(Some(())) => {}
            Ok(None) => {
                return Err(SensorError::Changed {
                    name: self.name.clone(),
                    what: "it was shortened",
                });
            }
            // It was shortened between the two.
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(()),
            Err(error) => return Err(self.fail(error)),
        }
        for frame in self.bytes.chunks_exact(width as usize) {
            into.own.push(self.frames as f64);
            self.frames += 1;
            self.counts.samples += 1;
            let columns = self.layout.iter().flat_map(|layout| layout.columns());
            for (value, column) in frame.chunks_exact(format.bytes).zip(columns) {
                let Column::Channel(channel) = column else {
                    continue;
                };
                let full = match channel.quantity {
                    asperity_recording::description::Quantity::Force => self.full.force,
                    _ => self.full.acceleration,
                };
                let value = (format.number(value) * full) as f32;
                let value = if value.is_finite() { value } else { f32::NAN };
                self.counts.missing += u64::from(value.is_nan());
                into.values.push(value);
            }
        }
        Ok(())
    }
}

impl Source for Wav {
    fn read(&mut self, wait: Duration, into: &mut Samples) -> Result<(), SensorError> {
        let before = into.len();
        if self.open.is_none() {
            self.begin()?;
        }
        self.looks += 1;
        if self.looks.is_multiple_of(SELDOM) {
            self.check_header()?;
        }
        self.frames(into)?;
        if into.len() == before {
            sleep(LOOK.min(wait));
        }
        Ok(())
    }

    fn layout(&self) -> Option<&Layout> {
        self.layout.as_ref()
    }

    fn stated_scale(&self) -> Option<f64> {
        let (_, format) = self.open.as_ref()?;
        Some(1.0 / f64::from(format.rate_hz))
    }

    fn counts(&self) -> Counts {
        self.counts
    }

    fn name(&self) -> &str {
        &self.name
    }
}

/// Returns true if the path leads to another file than the open one.
#[cfg(unix)]
fn is_another(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let id = |data: fs::Metadata| (data.dev(), data.ino());
    let (open, named) = (file.metadata().map(id), fs::metadata(path).map(id));
    !matches!((open, named), (Ok(open), Ok(named)) if open == named)
}

/// Other systems do not let an open file be replaced.
#[cfg(not(unix))]
fn is_another(_: &File, path: &Path) -> bool {
    fs::metadata(path).is_err()
}

/// The header as far as it is written; `None` where more must be written first. The stated length is
/// left out: it changes while the file grows.
fn read_header(file: &mut File, name: &str) -> Result<Option<Format>, SensorError> {
    let found = wav::read_header(file).map_err(|cause| SensorError::Read {
        name: name.to_owned(),
        cause,
    })?;
    let refused = |why| SensorError::Header {
        name: name.to_owned(),
        why,
    };
    match found {
        ParsedHeader::Cut => Ok(None),
        ParsedHeader::Refused(what, remedy) => Err(refused(format!("{what}; {remedy}"))),
        ParsedHeader::Whole(format) if !RATES_HZ.contains(&format.rate_hz) => Err(refused(
            format!("states {} Hz, outside 10 to 200000", format.rate_hz),
        )),
        ParsedHeader::Whole(format) => Ok(Some(Format {
            stated: 0,
            ..format
        })),
    }
}

#[cfg(test)]
#[path = "wav_tests.rs"]
mod tests;

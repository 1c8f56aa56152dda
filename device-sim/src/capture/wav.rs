//! A WAV file that another program is writing, such as `arecord` or `sox`.
//!
//! Such a program states a length that is 0, or far too large, until it ends; the length of the file
//! is what counts here. hound, which imports read with, refuses such lengths. Everything else of the
//! header must stay.

use super::columns::{Column, Layout};
use super::error::SensorError;
use super::samples::{Counts, Samples};
use super::source::Source;
use std::fs::{self, File};
use std::io::{self, Read, Seek as _, SeekFrom};
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

/// Longest header, bytes.
const LONGEST_HEADER: usize = 64 * 1024;
/// Time between two looks at the file.
const LOOK: Duration = Duration::from_millis(2);
/// Looks between two looks at the header.
const SELDOM: u32 = 250;
/// Bytes that are read at once.
const PIECE: u64 = 256 * 1024;

/// What a header says.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Format {
    channels: usize,
    rate_hz: u32,
    /// Bytes of a value.
    bytes: usize,
    is_float: bool,
    /// Where the values begin in the file.
    begin: u64,
}

/// What was found of a header.
enum Found {
    Whole(Format),
    /// More must be written first.
    Cut,
}

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

/// What full scale is: g of an acceleration, N of a force.
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
        let Found::Whole(format) = read_header(&mut file, &self.name)? else {
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
            Ok(Found::Whole(now)) if now == *format => Ok(()),
            _ => Err(changed("its header changed")),
        }
    }

    /// Reads the frames that are whole.
    fn frames(&mut self, into: &mut Samples) -> Result<(), SensorError> {
        let Some((file, format)) = &mut self.open else {
            return Ok(());
        };
        let width = (format.channels * format.bytes) as u64;
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
                let value = (number(value, format.is_float) * full) as f32;
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

/// Whether the path leads to another file than the open one.
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

fn read_header(file: &mut File, name: &str) -> Result<Found, SensorError> {
    let mut head = Vec::new();
    let read = file
        .seek(SeekFrom::Start(0))
        .and_then(|_| file.take(LONGEST_HEADER as u64).read_to_end(&mut head));
    read.map_err(|cause| SensorError::Read {
        name: name.to_owned(),
        cause,
    })?;
    parse(&head).map_err(|why| SensorError::Header {
        name: name.to_owned(),
        why,
    })
}

/// Reads a header as far as it is written.
fn parse(head: &[u8]) -> Result<Found, String> {
    let magic = |at: usize, expected: &[u8]| {
        let there = head.get(at..).unwrap_or_default();
        let common = there.len().min(expected.len());
        there[..common] == expected[..common]
    };
    if !magic(0, b"RIFF") || !magic(8, b"WAVE") {
        return Err("is none of a WAV".into());
    }
    let word = |at: usize| Some(u16::from_le_bytes(head.get(at..at + 2)?.try_into().ok()?));
    let long = |at: usize| Some(u32::from_le_bytes(head.get(at..at + 4)?.try_into().ok()?));
    let mut at = 12;
    let mut format = None;
    loop {
        let (Some(id), Some(size)) = (head.get(at..at + 4), long(at + 4)) else {
            return if head.len() >= LONGEST_HEADER {
                Err(format!("has more than {LONGEST_HEADER} bytes"))
            } else {
                Ok(Found::Cut)
            };
        };
        let body = at + 8;
        if id == b"data" {
            let format: Format = format.ok_or("has values before their format")?;
            return Ok(Found::Whole(Format {
                begin: body as u64,
                ..format
            }));
        }
        if id == b"fmt " {
            if !(16..=64).contains(&size) {
                return Err(format!("states a format of {size} bytes"));
            }
            if head.len() < body + size as usize {
                return Ok(Found::Cut);
            }
            let field = |offset: usize| word(body + offset).unwrap_or(0);
            // An extensible format names the real one at the start of its identifier.
            let tag = match field(0) {
                0xfffe if size >= 26 => field(24),
                tag => tag,
            };
            let (channels, bits) = (usize::from(field(2)), field(14));
            let rate_hz = long(body + 4).unwrap_or(0);
            let is_float = tag == 3;
            let is_known = match tag {
                1 => matches!(bits, 16 | 24 | 32),
                3 => bits == 32,
                _ => false,
            };
            let bytes = usize::from(bits / 8);
            if !is_known {
                return Err(format!(
                    "states format {tag} with {bits} bits; record 16, 24 or 32 bits, or float of 32"
                ));
            }
            if channels == 0 || usize::from(field(12)) != channels * bytes {
                return Err(format!("states {channels} channels in {} bytes", field(12)));
            }
            if !(10..=200_000).contains(&rate_hz) {
                return Err(format!("states {rate_hz} Hz, outside 10 to 200000"));
            }
            format = Some(Format {
                channels,
                rate_hz,
                bytes,
                is_float,
                begin: 0,
            });
        }
        // Chunks begin at even places.
        at = body + size as usize + (size % 2) as usize;
    }
}

/// A value, as a part of full scale.
fn number(bytes: &[u8], is_float: bool) -> f64 {
    match *bytes {
        [a, b] => f64::from(i16::from_le_bytes([a, b])) / 32_768.0,
        [a, b, c] => f64::from(i32::from_le_bytes([0, a, b, c])) / 2_147_483_648.0,
        [a, b, c, d] if is_float => f64::from(f32::from_le_bytes([a, b, c, d])),
        [a, b, c, d] => f64::from(i32::from_le_bytes([a, b, c, d])) / 2_147_483_648.0,
        _ => 0.0,
    }
}

#[cfg(test)]
#[path = "wav_tests.rs"]
mod tests;

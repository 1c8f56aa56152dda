//! WAV: integers of 8 to 32 bits, floats of 32 and 64, any number of channels. Full scale is 1.
//!
//! Programs that write into a pipe state a length of 0 or about 2³² bytes, and one that was killed states
//! too many: such a file is read to its end, and that is said.

use super::{EachRow, Header, Remark};
use crate::{file, remedy::unreadable};
use asperity_io::diagnostic::Fault;
use std::{
    fs::File,
    io::{self, BufReader, Read, Seek, SeekFrom},
    path::Path,
};

/// A length from which on no file is that long, but its writer could not know.
const UNKNOWN: u64 = 0x7fff_0000;
/// Least and largest length of a format, bytes.
const FORMAT: (u64, u64) = (16, 128);
/// Names of the format tags that are not read.
const OTHERS: [(u16, &str); 5] = [
    (2, "ADPCM"),
    (6, "A-law"),
    (7, "µ-law"),
    (0x11, "IMA ADPCM"),
    (0x55, "MP3"),
];

/// Parameters in the header of a WAV.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wav {
    /// Values in a row.
    pub channels: usize,
    /// Rows a second.
    pub rate_hz: u32,
    /// Bytes of a value in the file.
    pub bytes: usize,
    /// Bits of a value that count.
    pub bits: u16,
    /// True if values are floats.
    pub is_float: bool,
    /// Where the values begin in the file.
    pub begin: u64,
    /// Bytes of values, as the file states them.
    pub stated: u64,
}

impl Wav {
    /// Bytes of a row.
    #[must_use]
    pub fn width(&self) -> usize {
        self.channels * self.bytes
    }

    /// A value from its bytes: integers as parts of full scale, floats as they are.
    #[must_use]
    pub fn number(&self, bytes: &[u8]) -> f64 {
        let full = |value: i32| f64::from(value) / 2_147_483_648.0;
        match *bytes {
            [a, b, c, d] if self.is_float => f64::from(f32::from_le_bytes([a, b, c, d])),
            [a, b, c, d, e, f, g, h] => f64::from_le_bytes([a, b, c, d, e, f, g, h]),
            // The only one without a sign.
            [a] => f64::from(i16::from(a) - 128) / 128.0,
            [a, b] => full(i32::from_le_bytes([0, 0, a, b])),
            // 24 bits in the lower bytes of 32 are what ALSA calls S24_LE.
            [a, b, c] => full(i32::from_le_bytes([0, a, b, c])),
            [a, b, c, _] if self.bits == 24 => full(i32::from_le_bytes([0, a, b, c])),
            [a, b, c, d] => full(i32::from_le_bytes([a, b, c, d])),
            _ => f64::NAN,
        }
    }
}

/// Outcome of parsing a header.
#[derive(Debug, Clone, PartialEq)]
pub enum ParsedHeader {
    /// All of it.
    Whole(Wav),
    /// The file ends before the values.
    Cut,
    /// It is none that can be read: what it is, and what to give instead.
    Refused(String, &'static str),
}

/// Reads the header of a WAV up to its values. The file is left at their beginning.
///
/// # Errors
/// What the reader says.
pub fn read_header<R: Read + Seek>(file: &mut R) -> io::Result<ParsedHeader> {
    const REMEDY: &str = "save it as a WAV of 16, 24 or 32 bit integers, or of 32 or 64 bit floats";
    let refused = |what: String| Ok(ParsedHeader::Refused(what, REMEDY));
    let length = file.seek(SeekFrom::End(0))?;
    file.seek(SeekFrom::Start(0))?;
    let mut start = [0; 12];
    let read = fill(file, &mut start)?;
    let begins = |magic: &[u8]| {
        let there = read.min(magic.len());
        start[..there] == magic[..there]
    };
    let is_long = begins(b"RF64") || begins(b"BW64");
    if read >= 4 && start[..4] == *b"RIFX" {
        return refused("is a WAV with the highest byte first (RIFX)".into());
    }
    let is_wave = read <= 8 || start[8..read] == b"WAVE"[..read - 8];
    if !(begins(b"RIFF") || is_long) || !is_wave {
        return refused("is none of a WAV: it does not begin with RIFF and WAVE".into());
    }
    if read < 12 {
        return Ok(ParsedHeader::Cut);
    }
    let (mut format, mut long) = (None, None);
    let mut at = 12;
    loop {
        let mut head = [0; 8];
        file.seek(SeekFrom::Start(at))?;
        if fill(file, &mut head)? < 8 {
            return Ok(ParsedHeader::Cut);
        }
        let size = u64::from(u32::from_le_bytes([head[4], head[5], head[6], head[7]]));
        let body = at + 8;
        match &head[..4] {
            b"data" => {
                let Some(format) = format else {
                    return refused("has values before their format".into());
                };
                let stated = long.filter(|_| is_long).unwrap_or(size);
                return Ok(ParsedHeader::Whole(Wav {
                    begin: body,
                    stated,
                    ..format
                }));
            }
            b"fmt " => {
                let (least, most) = FORMAT;
                if !(least..=most).contains(&size) {
                    return refused(format!("states a format of {size} bytes"));
                }
                let mut bytes = vec![0; size as usize];
                if fill(file, &mut bytes)? < bytes.len() {
                    return Ok(ParsedHeader::Cut);
                }
                match parse(&bytes) {
                    Ok(wav) => format = Some(wav),
                    Err(what) => return refused(what),
                }
            }
            b"ds64" => {
                let mut sizes = [0; 16];
                if fill(file, &mut sizes)? == sizes.len() {
                    let bytes = sizes[8..].iter().rev();
                    long = Some(bytes.fold(0, |sum, byte| sum << 8 | u64::from(*byte)));
                }
            }
            _ => {}
        }
        // Chunks begin at even places.
        at = body + size + size % 2;
        if at > length {
            return Ok(ParsedHeader::Cut);
        }
    }
}

/// Reads a format.
fn parse(bytes: &[u8]) -> Result<Wav, String> {
    let word = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
    // An extensible format names the real one at the start of its identifier.
    let tag = match word(0) {
        0xfffe if bytes.len() >= 26 => word(24),
        tag => tag,
    };
    let (channels, align, bits) = (usize::from(word(2)), usize::from(word(12)), word(14));
    let rate_hz = u32::from_le_bytes([bytes[4], bytes[5], bytes[6], bytes[7]]);
    if channels == 0 || align == 0 || !align.is_multiple_of(channels) {
        return Err(format!("states {channels} channels in {align} bytes"));
    }
    if rate_hz == 0 {
        return Err("states 0 Hz".into());
    }
    let size = align / channels;
    let is_known = match tag {
        1 => matches!(
            (bits, size),
            (1..=8, 1) | (9..=16, 2) | (17..=24, 3) | (24..=32, 4)
        ),
        3 => matches!((bits, size), (32, 4) | (64, 8)),
        _ => false,
    };
    if !is_known {
        let name = OTHERS
            .iter()
            .find(|(known, _)| *known == tag)
            .map(|(_, name)| *name);
        return Err(match (name, tag) {
            (Some(name), _) => format!("is a WAV of {name}"),
            (None, 1) => format!("is a WAV of {bits} bit integers in {size} bytes"),
            (None, 3) => format!("is a WAV of {bits} bit floats in {size} bytes"),
            (None, _) => format!("is a WAV of the unknown format {tag:#x}"),
        });
    }
    Ok(Wav {
        channels,
        rate_hz,
        bytes: size,
        bits,
        is_float: tag == 3,
        begin: 0,
        stated: 0,
    })
}

/// Reads until the buffer is full or the file ends.
fn fill(file: &mut impl Read, buffer: &mut [u8]) -> io::Result<usize> {
    let mut read = 0;
    while read < buffer.len() {
        match file.read(&mut buffer[read..])? {
            0 => break,
            count => read += count,
        }
    }
    Ok(read)
}

/// An open file at its first value, the bytes of values that are there, and what is to be said.
fn open(path: &Path) -> Result<(BufReader<File>, Wav, u64, Vec<Remark>), Fault> {
    let mut file = BufReader::new(file::open(path)?);
    let wav = match read_header(&mut file).map_err(unreadable(path))? {
        ParsedHeader::Whole(wav) => wav,
        ParsedHeader::Cut => {
            let what = "is cut: it ends within its header";
            return Err(Fault::new(what, "copy or record it again").at(path));
        }
        ParsedHeader::Refused(what, remedy) => return Err(Fault::new(what, remedy).at(path)),
    };
    let end = file.seek(SeekFrom::End(0)).map_err(unreadable(path))?;
    let there = end.saturating_sub(wav.begin);
    let tail_at = |stated: u64| wav.begin + stated;
    let seconds = |bytes: u64| bytes as f64 / wav.width() as f64 / f64::from(wav.rate_hz);
    let mut remarks = Vec::new();
    let mut remark = |what: String, remedy| remarks.push(Remark { what, remedy });
    let is_empty = there < wav.width() as u64
        || there >= 8 && is_chunks(&mut file, wav.begin, end).map_err(unreadable(path))?;
    let bytes = if wav.stated >= UNKNOWN && wav.stated > there || wav.stated == 0 && !is_empty {
        let what = format!(
            "states no length; it is read to its end, {:.3} s",
            seconds(there)
        );
        remark(
            what,
            "end the recording program by its own command, so that it writes the length",
        );
        there
    } else if wav.stated > there {
        let what = format!(
            "is cut: {:.3} s of the {:.3} s that it states are there",
            seconds(there),
            seconds(wav.stated)
        );
        remark(what, "copy it again, or look why the recording ended early");
        there
    } else {
        // Not every program writes the pad byte.
        let mut padded = [wav.stated + wav.stated % 2, wav.stated]
            .into_iter()
            .map(tail_at);
        let is_whole = padded.try_fold(false, |is_whole, at| {
            Ok(is_whole || is_chunks(&mut file, at, end)?)
        });
        if !is_whole.map_err(unreadable(path))? {
            let what = format!(
                "states {:.3} s and holds {:.3} s: what is beyond is not read",
                seconds(wav.stated),
                seconds(there)
            );
            remark(
                what,
                "end the recording program by its own command, so that it writes the length",
            );
        }
        wav.stated
    };
    file.seek(SeekFrom::Start(wav.begin))
        .map_err(unreadable(path))?;
    Ok((file, wav, bytes, remarks))
}

/// Returns true if whole chunks, or nothing, fill a file from an offset to its end.
fn is_chunks(file: &mut (impl Read + Seek), mut at: u64, end: u64) -> io::Result<bool> {
    while at + 8 <= end {
        let mut head = [0; 8];
        file.seek(SeekFrom::Start(at))?;
        fill(file, &mut head)?;
        let size = u64::from(u32::from_le_bytes([head[4], head[5], head[6], head[7]]));
        if !head[..4].iter().all(|byte| matches!(byte, b' '..=b'~')) || at + 8 + size > end {
            return Ok(false);
        }
        at += 8 + size + size % 2;
    }
    // A few stray bytes are no row.
    Ok(true)
}

pub(super) fn header(path: &Path) -> Result<Header, Fault> {
    let (_, wav, _, remarks) = open(path)?;
    Ok(Header {
        columns: (0..wav.channels)
            .map(|channel| channel.to_string())
            .collect(),
        rate_hz: Some(f64::from(wav.rate_hz)),
        full_scale: !wav.is_float,
        remarks,
        ..Header::default()
    })
}

pub(super) fn rows(path: &Path, each: &mut EachRow<'_>) -> Result<(), Fault> {
    let (mut file, wav, bytes, _) = open(path)?;
    let mut frame = vec![0; wav.width()];
    let mut row = vec![0.0; wav.channels];
    for index in 1..=bytes / wav.width() as u64 {
        file.read_exact(&mut frame).map_err(unreadable(path))?;
        for (value, bytes) in row.iter_mut().zip(frame.chunks_exact(wav.bytes)) {
            *value = wav.number(bytes);
        }
        if !each(index, &row)? {
            break;
        }
    }
    Ok(())
}

#[cfg(test)]
#[path = "wav_tests.rs"]
mod tests;

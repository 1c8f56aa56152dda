//! The file as a whole: magic, version, conditions, blocks.

use std::io::{BufReader, Read, Write};
use std::path::Path;

use crate::regular_file;

use super::block::{self, BlockKind, Next};
use super::record::{self, Before};
use super::{Conditions, Entry, SessionLogError, TextureInfo};

/// The first bytes of a recording.
const MAGIC: [u8; 4] = *b"ASPR";
/// The version that is written and read.
const VERSION: u16 = 1;
/// Records of a full block: a quarter of a second at 1 kHz.
const PER_BLOCK: usize = 250;
/// Ticks that are read of a file at most, 100 minutes at 1 kHz: 64 bytes each are kept in memory, and
/// a damaged or foreign file may hold one in every two bytes.
pub const MAX_TICKS: usize = 6_000_000;

/// Summary of a written file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Summary {
    /// Ticks in the file.
    pub recorded: u64,
    /// Ticks that were lost, since the queue was full.
    pub lost: u64,
}

/// Writes a recording, block by block.
#[derive(Debug)]
pub struct Encoder<W: Write> {
    to: W,
    body: Vec<u8>,
    before: Before,
    in_block: usize,
    recorded: u64,
}

impl<W: Write> Encoder<W> {
    /// Begins a recording.
    ///
    /// # Errors
    /// [`SessionLogError::Io`].
    pub fn new(mut to: W, conditions: &Conditions) -> Result<Self, SessionLogError> {
        let head = serde_json::to_vec(conditions).map_err(std::io::Error::from)?;
        to.write_all(&MAGIC)?;
        to.write_all(&VERSION.to_le_bytes())?;
        to.write_all(&[0; 2])?;
        block::write(&mut to, BlockKind::Conditions, &head)?;
        Ok(Self {
            to,
            body: Vec::new(),
            before: Before::default(),
            in_block: 0,
            recorded: 0,
        })
    }

    /// Appends a tick. Every 250 ticks a block goes out.
    ///
    /// # Errors
    /// [`SessionLogError::Io`].
    pub fn push(&mut self, entry: &Entry) -> Result<(), SessionLogError> {
        record::encode(&mut self.body, &mut self.before, entry);
        self.in_block += 1;
        self.recorded += 1;
        if self.in_block == PER_BLOCK {
            self.flush()?;
        }
        Ok(())
    }

    /// Says which texture is the next to play.
    ///
    /// # Errors
    /// [`SessionLogError::Io`].
    pub fn announce(&mut self, texture: &TextureInfo) -> Result<(), SessionLogError> {
        self.flush()?;
        let body = serde_json::to_vec(texture).map_err(std::io::Error::from)?;
        Ok(block::write(&mut self.to, BlockKind::Texture, &body)?)
    }

    /// Writes what is waiting.
    ///
    /// # Errors
    /// [`SessionLogError::Io`].
    pub fn flush(&mut self) -> Result<(), SessionLogError> {
        if self.in_block > 0 {
            let mut body = Vec::with_capacity(self.body.len() + 4);
            record::put(&mut body, self.in_block as u64);
            body.append(&mut self.body);
            block::write(&mut self.to, BlockKind::Ticks, &body)?;
            (self.before, self.in_block) = (Before::default(), 0);
        }
        Ok(self.to.flush()?)
    }

    /// Ends the recording.
    ///
    /// # Errors
    /// [`SessionLogError::Io`].
    pub fn finish(mut self, lost: u64) -> Result<(W, Summary), SessionLogError> {
        self.flush()?;
        let recorded = self.recorded;
        let mut body = Vec::new();
        record::put(&mut body, recorded);
        record::put(&mut body, lost);
        block::write(&mut self.to, BlockKind::End, &body)?;
        self.to.flush()?;
        Ok((self.to, Summary { recorded, lost }))
    }
}

/// End of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Ending {
    /// Complete.
    Whole(Summary),
    /// Truncated or damaged; everything before is read.
    Cut {
        /// Valid bytes before it.
        at: u64,
        /// Description of the defect.
        why: &'static str,
    },
}

/// A recording that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct SessionLog {
    /// Under which conditions it was made.
    pub conditions: Conditions,
    /// The textures that played after the first, in order.
    pub textures: Vec<TextureInfo>,
    /// Every tick.
    pub entries: Vec<Entry>,
    /// End of the file.
    pub ending: Ending,
}

impl SessionLog {
    /// Opens and reads a file.
    ///
    /// # Errors
    /// [`SessionLogError`].
    pub fn open(path: &Path) -> Result<Self, SessionLogError> {
        Self::read(&mut BufReader::new(regular_file::open(path)?))
    }

    /// Reads a recording. One that was cut is read up to its last whole block, one of more than
    /// [`MAX_TICKS`] up to the last block within.
    ///
    /// # Errors
    /// [`SessionLogError`]: no recording, a newer one, or one whose conditions are damaged.
    pub fn read(from: &mut impl Read) -> Result<Self, SessionLogError> {
        Self::read_at_most(from, MAX_TICKS)
    }

    fn read_at_most(from: &mut impl Read, most: usize) -> Result<Self, SessionLogError> {
        let mut from = Counted { from, count: 0 };
        let conditions = head(&mut from)?;
        let (mut textures, mut entries) = (Vec::new(), Vec::new());
        let ending = loop {
            let at = from.count;
            let malformed = |why| SessionLogError::Malformed { at, why };
            match block::read(&mut from)? {
                Next::Block(BlockKind::Ticks, body) => {
                    if !ticks(&body, &mut entries, most).map_err(malformed)? {
                        break Ending::Cut {
                            at,
                            why: "it has more than the 6,000,000 ticks that are read",
                        };
                    }
                }
                Next::Block(BlockKind::Texture, body) => {
                    let texture = serde_json::from_slice(&body);
                    textures.push(
                        texture.map_err(|_| malformed("this is no description of a texture"))?,
                    );
                }
                Next::Block(BlockKind::End, body) => {
                    let summary = end(&body).map_err(malformed)?;
                    if summary.recorded != entries.len() as u64 {
                        return Err(malformed("the count of ticks at the end is another"));
                    }
                    break Ending::Whole(summary);
                }
                Next::Block(BlockKind::Conditions, _) => {
                    return Err(malformed("conditions stand twice"));
                }
                Next::Block(BlockKind::Unknown, _) => {}
                Next::End => {
                    break Ending::Cut {
                        at,
                        why: "the file ends without an end block",
                    };
                }
                Next::Broken(why) => break Ending::Cut { at, why },
            }
        };
        Ok(Self {
            conditions,
            textures,
            entries,
            ending,
        })
    }

    /// Ticks that are missing between those that were recorded.
    #[must_use]
    pub fn lost(&self) -> u64 {
        self.entries
            .iter()
            .map(|entry| u64::from(entry.lost_before))
            .sum()
    }
}

/// Magic, version and conditions.
fn head(from: &mut impl Read) -> Result<Conditions, SessionLogError> {
    let mut start = [0; 8];
    let got = block::fill(from, &mut start)?;
    if got < 4 || start[..4] != MAGIC {
        return Err(SessionLogError::Foreign {
            found: start[..got.min(4)].to_vec(),
        });
    }
    let damaged = |why: &str| SessionLogError::Conditions { why: why.into() };
    if got < start.len() {
        return Err(damaged("the file ends before them"));
    }
    let found = u16::from_le_bytes([start[4], start[5]]);
    if found != VERSION {
        return Err(SessionLogError::Version {
            found,
            known: VERSION,
        });
    }
    match block::read(from)? {
        Next::Block(BlockKind::Conditions, body) => {
            let conditions: Conditions =
                serde_json::from_slice(&body).map_err(|error| damaged(&error.to_string()))?;
            // Queues and clocks are sized by the rate, before a renderer checks it.
            let checked = conditions.config.check();
            checked.map_err(|error| damaged(&error.to_string()))?;
            Ok(conditions)
        }
        Next::Block(..) => Err(damaged("another block stands in their place")),
        Next::End => Err(damaged("the file ends before them")),
        Next::Broken(why) => Err(damaged(why)),
    }
}

/// Reads a block, unless it has more ticks than there is room for.
fn ticks(mut body: &[u8], entries: &mut Vec<Entry>, most: usize) -> Result<bool, &'static str> {
    let count = record::take(&mut body)?;
    // A record has two bytes at least, so a wrong count reserves no memory.
    if count > body.len() as u64 / 2 {
        return Err("a block states more ticks than it has bytes for");
    }
    let needed = entries.len() + count as usize;
    if needed > most {
        return Ok(false);
    }
    if needed > entries.capacity() {
        // Memory that doubles would take twice the limit.
        entries.reserve_exact((needed + needed / 4).min(most) - entries.len());
    }
    let mut before = Before::default();
    for _ in 0..count {
        entries.push(record::decode(&mut body, &mut before)?);
    }
    if body.is_empty() {
        Ok(true)
    } else {
        Err("bytes follow the last tick of a block")
    }
}

fn end(mut body: &[u8]) -> Result<Summary, &'static str> {
    let recorded = record::take(&mut body)?;
    let lost = record::take(&mut body)?;
    Ok(Summary { recorded, lost })
}

/// Counts the bytes that were read.
struct Counted<'a, R> {
    from: &'a mut R,
    count: u64,
}

impl<R: Read> Read for Counted<'_, R> {
    fn read(&mut self, bytes: &mut [u8]) -> std::io::Result<usize> {
        let got = self.from.read(bytes)?;
        self.count += got as u64;
        Ok(got)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_runtime::{Config, Sample};

    #[test]
    fn a_long_recording_is_read_up_to_the_limit_and_says_so() {
        let conditions = Conditions {
            program: "test 1.0".into(),
            device: "null:".into(),
            texture: None,
            scene: None,
            seed: 1,
            config: Config::default(),
        };
        let nothing = Entry {
            sample: Sample::STALE,
            force_n: [0.0; 3],
            flags: 0,
            buttons: 0,
            read_fault: None,
            write_fault: None,
            next_texture: false,
            lost_before: 0,
        };
        let mut encoder = Encoder::new(Vec::new(), &conditions).expect("memory takes it");
        for _ in 0..4 * PER_BLOCK {
            encoder.push(&nothing).expect("memory takes it");
        }
        let (bytes, _) = encoder.finish(0).expect("memory takes it");
        let read = |most| SessionLog::read_at_most(&mut &bytes[..], most).expect("a recording");
        assert!(matches!(read(4 * PER_BLOCK).ending, Ending::Whole(_)));
        let part = read(3 * PER_BLOCK + 1);
        assert_eq!(part.entries.len(), 3 * PER_BLOCK);
        assert!(part.entries.capacity() <= 3 * PER_BLOCK + 1);
        let Ending::Cut { at, why } = part.ending else {
            panic!("{:?}", part.ending);
        };
        assert!(
            (at as usize) < bytes.len() && why.contains("6,000,000"),
            "{at}: {why}"
        );
    }
}

//! Interval logs (`.hlog`), as HdrHistogram's own tools read them. Each interval holds a histogram
//! of every stage, whose tag is the stage's name. A comment holds the [`Facts`].

use super::{
    encoded::{counts, inflated},
    facts::Facts,
    run::{Interval, Run},
};
use crate::servo::Stage;
use base64::Engine as _;
use hdrhistogram::serialization::{
    V2DeflateSerializer,
    interval_log::{IntervalLogIterator, IntervalLogWriterBuilder, LogEntry, Tag},
};
use std::time::{Duration, UNIX_EPOCH};
use thiserror::Error;

/// Prefix of the comment with the metadata.
const FACTS: &str = "asperity-lab jitter ";
/// Largest values are written in ms.
const MAX_DIVISOR: f64 = 1e6;
/// Bytes to which the histograms of a log unpack, at most: so many for each byte of the file, and
/// some more. Those of a measurement unpack to about as many as they take.
const UNPACKED: usize = 8;
const UNPACKED_MORE: usize = 1 << 22;
/// More intervals than any run of a day has.
const MOST_INTERVALS: usize = 1_000_000;

/// Why bytes are no log of a run.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LogError {
    /// The log cannot be written.
    #[error("cannot encode the log: {0}")]
    Write(String),
    /// No comment with facts.
    #[error("no comment `#{FACTS}…`: not a log that `asperity-lab jitter` wrote")]
    NoFacts,
    /// The comment with facts is damaged.
    #[error("the comment with the conditions is damaged: {0}")]
    Facts(#[from] serde_json::Error),
    /// A line that is none of a log.
    #[error("interval {0} cannot be read")]
    Line(usize),
    /// A histogram that is damaged.
    #[error("the histogram of interval {0} is damaged")]
    Histogram(usize),
    /// A tag that is no stage.
    #[error("interval {index} has the tag {tag:?}, which is no stage")]
    Tag {
        /// The interval.
        index: usize,
        /// Its tag.
        tag: String,
    },
    /// The histograms unpack to far more than the file.
    #[error("interval {0}: its histograms unpack to more than {UNPACKED} times the file")]
    Unpacked(usize),
    /// Too many intervals.
    #[error("more than {MOST_INTERVALS} intervals")]
    TooMany,
}

/// The bytes of a log.
///
/// # Errors
/// [`LogError::Write`].
pub fn write_log(run: &Run) -> Result<Vec<u8>, LogError> {
    let failed = |error: &dyn std::fmt::Display| LogError::Write(error.to_string());
    let mut bytes = Vec::new();
    let mut serializer = V2DeflateSerializer::new();
    let began = UNIX_EPOCH + seconds(run.facts.began_s);
    let mut log = IntervalLogWriterBuilder::new()
        .add_comment("[Histogram log format version 1.3]")
        .add_comment(&format!("{FACTS}{}", serde_json::to_string(&run.facts)?))
        .with_start_time(began)
        .with_base_time(began)
        .with_max_value_divisor(MAX_DIVISOR)
        .begin_log_with(&mut bytes, &mut serializer)
        .map_err(|error| failed(&error))?;
    for interval in &run.intervals {
        for stage in Stage::ALL {
            log.write_histogram(
                &interval.stage(stage).histogram(),
                seconds(interval.start_s),
                seconds(interval.length_s),
                Tag::new(stage.name()),
            )
            .map_err(|error| failed(&error))?;
        }
    }
    Ok(bytes)
}

/// A duration of so many seconds; 0 for what is none.
fn seconds(s: f64) -> Duration {
    Duration::try_from_secs_f64(s).unwrap_or_default()
}

/// The comment with the facts.
fn facts_of(bytes: &[u8]) -> Option<&[u8]> {
    let mut lines = bytes.split(|&byte| byte == b'\n');
    lines.find_map(|line| line.strip_prefix(b"#")?.strip_prefix(FACTS.as_bytes()))
}

/// Returns true if the bytes are a log written by [`write_log`], whole or damaged.
#[must_use]
pub fn is_log(bytes: &[u8]) -> bool {
    facts_of(bytes).is_some()
}

/// The run of a log.
///
/// # Errors
/// [`LogError`].
pub fn read_log(bytes: &[u8]) -> Result<Run, LogError> {
    let facts = facts_of(bytes).ok_or(LogError::NoFacts)?;
    let facts: Facts = serde_json::from_slice(facts)?;
    let mut room = UNPACKED_MORE.saturating_add(bytes.len().saturating_mul(UNPACKED));
    let mut intervals: Vec<Interval> = Vec::new();
    let entries = IntervalLogIterator::new(bytes).filter(|entry| {
        // Start and base time were read with the facts.
        !matches!(entry, Ok(LogEntry::StartTime(_) | LogEntry::BaseTime(_)))
    });
    for (index, entry) in entries.enumerate() {
        let Ok(LogEntry::Interval(entry)) = entry else {
            return Err(LogError::Line(index));
        };
        let tag = entry.tag().map_or("", |tag| tag.as_str());
        let stage = Stage::of_name(tag).ok_or_else(|| LogError::Tag {
            index,
            tag: tag.into(),
        })?;
        let histogram = base64::engine::general_purpose::STANDARD
            .decode(entry.encoded_histogram())
            .ok()
            .and_then(|bytes| inflated(&bytes))
            .ok_or(LogError::Histogram(index))?;
        let left = room.checked_sub(histogram.len());
        room = left.ok_or(LogError::Unpacked(index))?;
        let counts = counts(&histogram).ok_or(LogError::Histogram(index))?;
        let start_s = entry.start_timestamp().as_secs_f64();
        let length_s = entry.duration().as_secs_f64();
        let same = |last: &&mut Interval| last.start_s == start_s;
        if intervals.last_mut().filter(same).is_none() {
            if intervals.len() == MOST_INTERVALS {
                return Err(LogError::TooMany);
            }
            intervals.push(Interval {
                start_s,
                length_s,
                stages: Default::default(),
            });
        }
        if let Some(interval) = intervals.last_mut() {
            interval.stages[stage as usize] = counts;
        }
    }
    Ok(Run { facts, intervals })
}

//! Interval logs against the reference's description of their format, read here byte by byte:
//! HdrHistogram's `HistogramLogWriter` (version 1.3 of the log) and its encoding V2.

use asperity_host::latency::{Counts, Facts, Interval, LogError, Run, read_log, write_log};
use asperity_host::servo::Stage;
use base64::Engine as _;
use flate2::{Compression, read::ZlibDecoder, write::ZlibEncoder};
use std::io::{Read as _, Write as _};

/// Cookies of the encoding V2; the low byte says that counts are numbers of variable length.
const COMPRESSED: u32 = 0x1c84_9304 | 0x10;
const PLAIN: u32 = 0x1c84_9303 | 0x10;

/// A decoded histogram of the log.
struct Decoded {
    digits: u32,
    /// Value (the lowest of its cell) and count.
    counts: Vec<(u64, u64)>,
}

fn be<const N: usize>(bytes: &mut &[u8]) -> [u8; N] {
    let (head, rest) = bytes.split_first_chunk().expect("bytes");
    *bytes = rest;
    *head
}

/// A number of seven bits a byte, the last of nine with eight, in zigzag.
fn zigzag(bytes: &mut &[u8]) -> i64 {
    let mut number = 0_u64;
    for place in 0..9 {
        let [byte] = be(bytes);
        if place == 8 {
            number |= u64::from(byte) << 56;
            break;
        }
        number |= u64::from(byte & 0x7f) << (7 * place);
        if byte < 0x80 {
            break;
        }
    }
    (number >> 1) as i64 ^ -((number & 1) as i64)
}

/// The lowest value of a cell, where `sub_buckets` cells share the first power of two.
fn value(cell: u64, sub_buckets: u64) -> u64 {
    let half = sub_buckets / 2;
    match (cell / half).checked_sub(1) {
        None | Some(0) => cell,
        Some(bucket) => (cell % half + half) << bucket,
    }
}

fn decoded(text: &str) -> Decoded {
    let compressed = base64::engine::general_purpose::STANDARD
        .decode(text)
        .expect("base64");
    let mut bytes = &compressed[..];
    assert_eq!(u32::from_be_bytes(be(&mut bytes)), COMPRESSED);
    assert_eq!(u32::from_be_bytes(be(&mut bytes)) as usize, bytes.len());
    let mut plain = Vec::new();
    ZlibDecoder::new(bytes)
        .read_to_end(&mut plain)
        .expect("zlib");
    let mut bytes = &plain[..];
    assert_eq!(u32::from_be_bytes(be(&mut bytes)), PLAIN);
    let length = u32::from_be_bytes(be(&mut bytes)) as usize;
    assert_eq!(u32::from_be_bytes(be(&mut bytes)), 0, "not shifted");
    let digits = u32::from_be_bytes(be(&mut bytes));
    assert_eq!(u64::from_be_bytes(be(&mut bytes)), 1, "the lowest value");
    let highest = u64::from_be_bytes(be(&mut bytes));
    assert!(highest >= 2);
    assert_eq!(f64::from_be_bytes(be(&mut bytes)), 1.0, "the unit");
    assert_eq!(length, bytes.len());
    let sub_buckets = (2 * 10_u64.pow(digits)).next_power_of_two();
    let (mut cell, mut counts) = (0, Vec::new());
    while !bytes.is_empty() {
        match zigzag(&mut bytes) {
            // A negative number is a run of empty cells.
            run @ ..0 => cell += run.unsigned_abs(),
            count => {
                if count > 0 {
                    counts.push((value(cell, sub_buckets), count.unsigned_abs()));
                }
                cell += 1;
            }
        }
    }
    Decoded { digits, counts }
}

fn run() -> Run {
    let counts = |n: u64| {
        Counts(vec![
            (3 + n, 5),
            (2047, 1),
            (2048 + 16 * n, 70_000),
            (305_408, 12),
            (70_000_000_000, 1),
        ])
    };
    let interval = |n: u64| Interval {
        start_s: n as f64,
        length_s: 1.0,
        stages: std::array::from_fn(|stage| counts(n + stage as u64)),
    };
    Run {
        facts: Facts {
            ticks: 1,
            missed: 0,
            lost: 0,
            period_ns: 1_000_000,
            longest_gap_ns: 0,
            omits: true,
            began_s: 1_700_000_000.5,
            conditions: Vec::new(),
            worst: Vec::new(),
        },
        intervals: vec![interval(0), interval(1)],
    }
}

#[test]
fn a_log_is_what_the_reference_describes() {
    let run = run();
    let text = String::from_utf8(write_log(&run).expect("a log")).expect("text");
    let mut lines = text.lines().peekable();
    let comments: Vec<&str> =
        std::iter::from_fn(|| lines.next_if(|line| line.starts_with('#'))).collect();
    assert_eq!(comments[0], "#[Histogram log format version 1.3]");
    // Seconds since 1970 with milliseconds.
    for name in ["StartTime", "BaseTime"] {
        let start = format!("#[{name}: 1700000000.5");
        assert!(
            comments.iter().any(|line| line.starts_with(&start)),
            "{name}"
        );
    }
    // A legend in quotes is skipped by its readers.
    while lines.next_if(|line| line.starts_with('"')).is_some() {}
    for interval in &run.intervals {
        for stage in Stage::ALL {
            let line = lines.next().expect("a line for each stage");
            let fields: Vec<&str> = line.split(',').collect();
            let [tag, start, length, max, histogram] = fields[..] else {
                panic!("{line}");
            };
            assert_eq!(tag, format!("Tag={}", stage.name()));
            assert_eq!(start.parse(), Ok(interval.start_s));
            assert_eq!(length.parse(), Ok(interval.length_s));
            // The largest value in ms: its cell is known to three digits.
            let max: f64 = max.parse().expect("a number");
            assert!((max - 70_000.0).abs() < 70.0, "{max}");
            assert!(histogram.starts_with("HISTFAAA"), "as its documents show");
            let decoded = decoded(histogram);
            assert_eq!(decoded.digits, 3);
            let expected = &interval.stage(stage).0;
            assert_eq!(decoded.counts.len(), expected.len());
            for ((value, count), (expected, times)) in decoded.counts.iter().zip(expected) {
                assert_eq!(count, times);
                assert!(
                    value <= expected && expected - value <= expected / 1000,
                    "{value}"
                );
            }
        }
    }
    assert_eq!(lines.next(), None);
}

/// A histogram whose heads, the outer and the inner one, state these lengths instead of their own.
fn lying(text: &str, outer: Option<u32>, inner: Option<u32>) -> String {
    let engine = base64::engine::general_purpose::STANDARD;
    let compressed = engine.decode(text).expect("base64");
    let mut plain = Vec::new();
    ZlibDecoder::new(&compressed[8..])
        .read_to_end(&mut plain)
        .expect("zlib");
    if let Some(inner) = inner {
        plain[4..8].copy_from_slice(&inner.to_be_bytes());
    }
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(&plain).expect("memory");
    let body = encoder.finish().expect("memory");
    let length = outer.unwrap_or(body.len() as u32);
    engine.encode([&compressed[..4], &length.to_be_bytes(), &body].concat())
}

/// Nothing is reserved for bytes that the file does not hold.
#[test]
fn a_histogram_that_states_other_lengths_than_its_own_is_damaged() {
    let log = String::from_utf8(write_log(&run()).expect("a log")).expect("text");
    let at = log.find("HISTFAAA").expect("a histogram");
    let end = at + log[at..].find('\n').expect("a line");
    let with = |histogram: &str| format!("{}{histogram}{}", &log[..at], &log[end..]);
    let histogram = &log[at..end];
    assert_eq!(
        read_log(with(&lying(histogram, None, None)).as_bytes()).expect("the same run"),
        read_log(log.as_bytes()).expect("a run")
    );
    for length in [0, 1, 0x7fff_ffff, u32::MAX] {
        for (outer, inner) in [(Some(length), None), (None, Some(length))] {
            let lies = with(&lying(histogram, outer, inner));
            let read = read_log(lies.as_bytes());
            assert!(
                matches!(read, Err(LogError::Histogram(_))),
                "{outer:?} {inner:?}: {read:?}"
            );
        }
    }
}

/// A histogram in the encoding V2 with these digits and bytes of counts.
fn encoded(digits: u32, counts: &[u8]) -> String {
    let mut plain = PLAIN.to_be_bytes().to_vec();
    plain.extend((counts.len() as u32).to_be_bytes());
    plain.extend(0_u32.to_be_bytes());
    plain.extend(digits.to_be_bytes());
    plain.extend(1_u64.to_be_bytes());
    plain.extend((i64::MAX as u64).to_be_bytes());
    plain.extend(1.0_f64.to_be_bytes());
    plain.extend(counts);
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(&plain).expect("memory");
    let body = encoder.finish().expect("memory");
    let heads = [COMPRESSED.to_be_bytes(), (body.len() as u32).to_be_bytes()].concat();
    base64::engine::general_purpose::STANDARD.encode([heads, body].concat())
}

/// A log of `intervals` with this histogram in each.
fn log_of(histogram: &str, intervals: usize) -> String {
    let log = String::from_utf8(write_log(&run()).expect("a log")).expect("text");
    let comments = log.lines().filter(|line| line.starts_with('#'));
    let mut text: String = comments.map(|line| format!("{line}\n")).collect();
    for n in 0..intervals {
        text += &format!("Tag=wakeup,{n}.000,1.000,1.000,{histogram}\n");
    }
    text
}

/// Claim: what a few bytes state costs no more than a file of its size may.
#[test]
fn a_small_log_of_huge_histograms_is_refused_at_once() {
    // One count behind 5,000,000 empty cells of five digits, and the most that three digits hold.
    let far = encoded(5, &[0xff, 0xac, 0xe2, 0x04, 0x02]);
    let refused = read_log(log_of(&far, 150).as_bytes());
    assert!(
        matches!(refused, Err(LogError::Histogram(0))),
        "{refused:?}"
    );
    let beyond = encoded(3, &[0xff, 0xac, 0xe2, 0x04, 0x02]);
    let refused = read_log(log_of(&beyond, 1).as_bytes());
    assert!(
        matches!(refused, Err(LogError::Histogram(0))),
        "{refused:?}"
    );
    // Dense ones unpack to a hundred times their bytes; a few may, and not hundreds.
    let dense = encoded(3, &[2; 50_000]);
    let few = read_log(log_of(&dense, 20).as_bytes()).expect("a run");
    assert_eq!(few.raw(Stage::WakeUp).len(), 20 * 50_000);
    let refused = read_log(log_of(&dense, 2000).as_bytes());
    assert!(matches!(refused, Err(LogError::Unpacked(_))), "{refused:?}");
    // More ticks in a cell than any run has.
    let many = encoded(3, &[0xfe, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f]);
    let refused = read_log(log_of(&many, 1).as_bytes());
    assert!(
        matches!(refused, Err(LogError::Histogram(0))),
        "{refused:?}"
    );
}

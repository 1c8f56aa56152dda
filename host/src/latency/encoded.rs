//! Histograms in HdrHistogram's encoding V2, read in time and memory that their bytes bound: cells
//! without counts, of which a few bytes can state millions, are never walked.

use super::run::{Counts, DIGITS};
use flate2::read::ZlibDecoder;
use std::io::Read as _;

/// First bytes of a compressed histogram and of a plain one, with counts of variable length.
const COMPRESSED: u32 = 0x1c84_9304 | 0x10;
const PLAIN: u32 = 0x1c84_9303 | 0x10;
/// Bytes before the counts.
const HEAD: usize = 40;
/// Cells that share a power of two, for three digits.
const HALF: u64 = 1024;
/// Cells of a histogram of three digits that holds every number of 63 bits.
const MOST_CELLS: u64 = (64 - 10) * HALF;
/// Largest count of a cell: more ticks than any run has.
const MOST_COUNT: u64 = u32::MAX as u64;
/// Bytes of the longest count.
const LONGEST: u64 = 9;

/// The bytes of a compressed histogram. `None` for one that is damaged, or whose heads state other
/// lengths than its own.
pub(super) fn inflated(compressed: &[u8]) -> Option<Vec<u8>> {
    let mut rest = compressed;
    if word(&mut rest)? != COMPRESSED || word(&mut rest)? as usize != rest.len() {
        return None;
    }
    let most = HEAD as u64 + LONGEST * MOST_CELLS;
    let mut histogram = Vec::new();
    let mut decoder = ZlibDecoder::new(rest).take(most + 1);
    decoder.read_to_end(&mut histogram).ok()?;
    (histogram.len() as u64 <= most).then_some(histogram)
}

/// The counts of a histogram of three digits, each at the largest value of its cell.
pub(super) fn counts(histogram: &[u8]) -> Option<Counts> {
    let mut rest = histogram;
    let is_ours = word(&mut rest)? == PLAIN
        && word(&mut rest)? as usize == histogram.len().checked_sub(HEAD)?
        // Not shifted, and a lowest value of 1.
        && word(&mut rest)? == 0
        && word(&mut rest)? == u32::from(DIGITS)
        && (word(&mut rest)?, word(&mut rest)?) == (0, 1);
    let mut rest = histogram.get(HEAD..).filter(|_| is_ours)?;
    let (mut cell, mut counts) = (0_u64, Vec::new());
    while !rest.is_empty() {
        match zigzag(&mut rest)? {
            empty @ ..0 => cell = cell.checked_add(empty.unsigned_abs())?,
            count => {
                let count = count.unsigned_abs();
                if count > MOST_COUNT {
                    return None;
                }
                if count > 0 {
                    counts.push((largest(cell), count));
                }
                cell += 1;
            }
        }
        if cell > MOST_CELLS {
            return None;
        }
    }
    Some(Counts(counts))
}

/// The largest value of a cell.
fn largest(cell: u64) -> u64 {
    match (cell / HALF).checked_sub(1) {
        None | Some(0) => cell,
        Some(bucket) => ((cell % HALF + HALF) << bucket) + ((1 << bucket) - 1),
    }
}

fn word(bytes: &mut &[u8]) -> Option<u32> {
    let (head, rest) = bytes.split_first_chunk()?;
    *bytes = rest;
    Some(u32::from_be_bytes(*head))
}

/// A number of seven bits a byte, the last of nine with eight, in zigzag.
fn zigzag(bytes: &mut &[u8]) -> Option<i64> {
    let mut number = 0_u64;
    for place in 0..LONGEST {
        let (&byte, rest) = bytes.split_first()?;
        *bytes = rest;
        if place == LONGEST - 1 {
            number |= u64::from(byte) << 56;
            break;
        }
        number |= u64::from(byte & 0x7f) << (7 * place);
        if byte < 0x80 {
            break;
        }
    }
    Some((number >> 1).cast_signed() ^ -(number & 1).cast_signed())
}

//! Damage to valid inputs.

use super::{
    forge::sealed,
    seeds::{Seed, Seeds},
};
use asperity_tests::draw::Draw;

/// Replacements for a number.
const NUMBERS: [&str; 22] = [
    "0",
    "-0",
    "-1",
    "1",
    "2",
    "64",
    "65",
    "1e9",
    "4294967295",
    "4294967296",
    "9223372036854775808",
    "18446744073709551616",
    "1e308",
    "1e999",
    "-1e999",
    "1e-320",
    "NaN",
    "inf",
    "0x10",
    "\"1\"",
    "",
    "0.30000000000000004",
];
/// Insertions.
const PIECES: [&[u8]; 22] = [
    b"\0",
    b"\xff\xfe",
    b"\xef\xbb\xbf",
    b"\xc0\x80",
    b"\x1b[2J",
    b"\r",
    b"\n",
    b"\"",
    b"'",
    b",",
    b";",
    b"<",
    b">",
    b"&amp;",
    b"&x;",
    b"<!DOCTYPE a [<!ENTITY x \"y\">]>",
    b"<![CDATA[",
    b"]]>",
    b"[[",
    b"{",
    b"}",
    b"# ",
];

/// An input of a kind after a few kinds of damage, and what was done.
pub(crate) fn mutated(seed: Seed, seeds: &Seeds, draw: &mut Draw) -> (Vec<u8>, String) {
    let mut bytes = seeds.bytes(seed).to_vec();
    let mut told = Vec::new();
    // Most of them once, because what is refused early attacks nothing behind it.
    let times = [1, 1, 1, 2, 3][draw.below(5)];
    for _ in 0..times {
        told.push(once(&mut bytes, seed, seeds, draw));
    }
    // Most of them past the checksums.
    if !seed.is_text() && draw.below(4) > 0 {
        bytes = sealed(bytes);
        told.push("sealed".to_owned());
    }
    (bytes, format!("{seed:?}: {}", told.join(", ")))
}

fn once(bytes: &mut Vec<u8>, seed: Seed, seeds: &Seeds, draw: &mut Draw) -> String {
    let at = draw.below(bytes.len() + 1);
    // What leaves the form intact gets farther, so it is drawn more often.
    let kind = match (draw.below(2), seed.is_text()) {
        (0, true) => 8 + draw.below(4),
        (0, false) => 6,
        _ => draw.below(8),
    };
    match kind {
        0 => {
            bytes.truncate(at);
            format!("cut at {at}")
        }
        1 => {
            let flips = 1 + draw.below(8);
            for _ in 0..flips.min(bytes.len()) {
                let place = draw.below(bytes.len());
                bytes[place] ^= 1 << draw.below(8);
            }
            format!("{flips} bits flipped")
        }
        2 => {
            let range = range(bytes, at, draw);
            let told = format!("{range:?} removed");
            bytes.drain(range);
            told
        }
        3 => {
            let range = range(bytes, at, draw);
            let times = 1 + draw.below(64);
            let piece = bytes[range.clone()].repeat(times);
            bytes.splice(at..at, piece);
            format!("{range:?} repeated {times} times at {at}")
        }
        4 => {
            const OTHERS: [Seed; 11] = [
                Seed::Asset,
                Seed::Library,
                Seed::Scene,
                Seed::Trajectory,
                Seed::Material,
                Seed::Model,
                Seed::Haptic,
                Seed::Ahap,
                Seed::Hjif,
                Seed::Description,
                Seed::Device,
            ];
            let other = OTHERS[draw.below(OTHERS.len())];
            let source = seeds.bytes(other);
            let range = range(source, draw.below(source.len()), draw);
            let told = format!("{range:?} of {other:?} spliced in at {at}");
            bytes.splice(at..at, source[range].iter().copied());
            told
        }
        5 => {
            let random: Vec<u8> = (0..1 + draw.below(300))
                .map(|_| draw.bits() as u8)
                .collect();
            let told = format!("{} random bytes at {at}", random.len());
            bytes.splice(at..at, random);
            told
        }
        6 => field(bytes, draw),
        7 => {
            let piece = PIECES[draw.below(PIECES.len())];
            let times = [1, 2, 1000, 200_000][draw.below(4)];
            bytes.splice(at..at, piece.repeat(times));
            format!("{times} times {:?} at {at}", String::from_utf8_lossy(piece))
        }
        8 | 9 => number(bytes, at, draw),
        10 => {
            let lines: Vec<&[u8]> = bytes.split_inclusive(|&byte| byte == b'\n').collect();
            let (from, to) = (draw.below(lines.len().max(1)), draw.below(lines.len() + 1));
            let mut lines = lines;
            if let Some(&line) = lines.get(from) {
                lines.insert(to, line);
            }
            *bytes = lines.concat();
            format!("line {} again after {to}", from + 1)
        }
        _ => {
            let mut lines: Vec<&[u8]> = bytes.split_inclusive(|&byte| byte == b'\n').collect();
            let (one, other) = (
                draw.below(lines.len().max(1)),
                draw.below(lines.len().max(1)),
            );
            if !lines.is_empty() {
                lines.swap(one, other);
            }
            *bytes = lines.concat();
            format!("lines {} and {} swapped", one + 1, other + 1)
        }
    }
}

/// A range from `at` of up to 1,000 bytes.
fn range(bytes: &[u8], at: usize, draw: &mut Draw) -> std::ops::Range<usize> {
    let start = at.min(bytes.len());
    start..(start + draw.below(1000)).min(bytes.len())
}

/// A field of a binary file to an extreme.
fn field(bytes: &mut [u8], draw: &mut Draw) -> String {
    const VALUES: [u32; 12] = [
        0,
        1,
        2,
        0x7f,
        0xff,
        0xffff,
        0x7fff_ffff,
        0x8000_0000,
        u32::MAX,
        0x7fc0_0000, // NaN
        0x7f80_0000, // infinity
        0x0000_0001, // the smallest float
    ];
    let value = VALUES[draw.below(VALUES.len())].to_le_bytes();
    let len = [1, 2, 4][draw.below(3)];
    // Headers and tables come first.
    let reach = if draw.below(2) == 0 { 128 } else { bytes.len() };
    let at = draw.below(reach.max(1));
    if let Some(place) = bytes.get_mut(at..at + len) {
        place.copy_from_slice(&value[..len]);
    }
    format!("{:?} at {at}", &value[..len])
}

/// The next number from `at` replaced by another.
fn number(bytes: &mut Vec<u8>, at: usize, draw: &mut Draw) -> String {
    let is_part = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
    let from = bytes.iter().skip(at).position(|byte| byte.is_ascii_digit());
    let Some(start) = from.map(|from| at + from) else {
        return "nothing done".to_owned();
    };
    let len = bytes[start..]
        .iter()
        .take_while(|byte| is_part(byte))
        .count();
    let number = NUMBERS[draw.below(NUMBERS.len())];
    bytes.splice(start..start + len, number.bytes());
    format!("{number:?} for the number at {start}")
}

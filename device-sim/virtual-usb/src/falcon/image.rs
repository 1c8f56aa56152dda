//! A firmware of our own, which only the virtual Falcon runs: a name, a length, bytes that look
//! like code, and a sum.

/// Magic at the start of an image.
const NAME: &[u8; 24] = b"ASPERITY VIRTUAL FALCON\0";
/// Name, length, sum.
const HEADER: usize = 24 + 4 + 4;

/// An image of `bytes` bytes, at least its header.
#[must_use]
pub fn image(bytes: usize) -> Vec<u8> {
    let mut noise = 0x2545_f491_u32;
    let body: Vec<u8> = (HEADER..bytes.max(HEADER))
        .map(|_| {
            noise ^= noise << 13;
            noise ^= noise >> 17;
            noise ^= noise << 5;
            noise as u8
        })
        .collect();
    let mut image = NAME.to_vec();
    image.extend(((HEADER + body.len()) as u32).to_le_bytes());
    image.extend(sum(&body).to_le_bytes());
    image.extend(body);
    image
}

/// Verdict of the boot loader on the bytes received so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    /// Incomplete.
    More,
    /// Complete and valid.
    Right,
    /// Not a firmware image.
    Wrong,
}

pub(super) fn judge(bytes: &[u8]) -> Verdict {
    if bytes
        .iter()
        .zip(NAME)
        .any(|(got, expected)| got != expected)
    {
        return Verdict::Wrong;
    }
    let Some((header, body)) = bytes.split_first_chunk::<HEADER>() else {
        return Verdict::More;
    };
    let number = |at: usize| {
        let mut four = [0; 4];
        four.copy_from_slice(&header[at..at + 4]);
        u32::from_le_bytes(four)
    };
    let length = number(24) as usize;
    if bytes.len() < length {
        Verdict::More
    } else if bytes.len() == length && sum(body) == number(28) {
        Verdict::Right
    } else {
        Verdict::Wrong
    }
}

/// Fletcher's, over bytes.
fn sum(bytes: &[u8]) -> u32 {
    let (a, b) = bytes.iter().fold((1_u32, 0_u32), |(a, b), byte| {
        let a = (a + u32::from(*byte)) % 65_521;
        (a, (b + a) % 65_521)
    });
    b << 16 | a
}

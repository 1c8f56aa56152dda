//! Blocks: a kind, a length, bytes, and a checksum over all of them.

use std::io::{self, Read, Write};

/// Kind of a block's content.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BlockKind {
    /// Conditions, as JSON.
    Conditions,
    /// Records of ticks.
    Ticks,
    /// A texture that plays later.
    Texture,
    /// The end of a whole recording.
    End,
    /// A kind of a later version; skipped.
    Unknown,
}

impl BlockKind {
    const ALL: [(Self, u8); 4] = [
        (Self::Conditions, 0),
        (Self::Ticks, 1),
        (Self::Texture, 2),
        (Self::End, 3),
    ];
}

/// The most bytes of a block. A longer one is damage.
pub(super) const LONGEST: usize = 1 << 20;

/// Writes a block.
pub(super) fn write(to: &mut impl Write, kind: BlockKind, body: &[u8]) -> io::Result<()> {
    let number = BlockKind::ALL.iter().find(|(known, _)| *known == kind);
    let mut bytes = Vec::with_capacity(body.len() + 9);
    bytes.push(number.map_or(u8::MAX, |(_, number)| *number));
    let length = u32::try_from(body.len()).map_err(|_| io::ErrorKind::InvalidInput)?;
    bytes.extend_from_slice(&length.to_le_bytes());
    bytes.extend_from_slice(body);
    let checksum = crc32fast::hash(&bytes);
    bytes.extend_from_slice(&checksum.to_le_bytes());
    to.write_all(&bytes)
}

/// Result of reading the next block.
#[derive(Debug)]
pub(super) enum Next {
    /// A whole block.
    Block(BlockKind, Vec<u8>),
    /// The end of the file, between blocks.
    End,
    /// A truncated or damaged block.
    Broken(&'static str),
}

/// Reads a block.
pub(super) fn read(from: &mut impl Read) -> io::Result<Next> {
    let mut head = [0; 5];
    match fill(from, &mut head)? {
        0 => return Ok(Next::End),
        5 => {}
        _ => return Ok(Next::Broken("the file ends within the head of a block")),
    }
    let length = u32::from_le_bytes([head[1], head[2], head[3], head[4]]) as usize;
    if length > LONGEST {
        return Ok(Next::Broken("a block is longer than any that was written"));
    }
    let mut rest = vec![0; length + 4];
    if fill(from, &mut rest)? < rest.len() {
        return Ok(Next::Broken("the file ends within a block"));
    }
    let stated = rest.split_off(length);
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(&head);
    hasher.update(&rest);
    if hasher.finalize().to_le_bytes() != stated[..] {
        return Ok(Next::Broken("the checksum of a block is wrong"));
    }
    let kind = BlockKind::ALL.iter().find(|(_, number)| *number == head[0]);
    Ok(Next::Block(
        kind.map_or(BlockKind::Unknown, |(kind, _)| *kind),
        rest,
    ))
}

/// Reads as many bytes as there are, at most all of `bytes`.
pub(super) fn fill(from: &mut impl Read, bytes: &mut [u8]) -> io::Result<usize> {
    let mut got = 0;
    while got < bytes.len() {
        match from.read(&mut bytes[got..]) {
            Ok(0) => break,
            Ok(more) => got += more,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(got)
}

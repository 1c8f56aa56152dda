//! Counts constructs for which an XML parser would take quadratic time or memory, before the parser runs.
//!
//! The parser compares every attribute of an element with those before it, and every element that
//! declares a namespace holds all that are in scope. The scan below knows just enough of XML to find
//! elements and attributes. On text that is not well-formed it may find other ones than are meant;
//! the parser refuses such text.

use std::ops::Range;
use thiserror::Error;

/// Most attributes of one element.
pub const MAX_ATTRIBUTES: usize = 64;
/// Most elements within each other.
pub const MAX_DEPTH: usize = 64;
/// Most namespace declarations of a document.
pub const MAX_NAMESPACES: usize = 16;

/// A document that is nested or loaded beyond a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Nesting {
    /// Line, 1-based.
    pub line: u32,
    /// The limit.
    pub problem: NestingProblem,
}

/// Which limit an XML document exceeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NestingProblem {
    /// An element with too many attributes.
    #[error("an element has more than {MAX_ATTRIBUTES} attributes")]
    Attributes,
    /// Elements too deep within each other.
    #[error("elements are nested deeper than {MAX_DEPTH}")]
    Depth,
    /// Too many declarations of namespaces.
    #[error("more than {MAX_NAMESPACES} namespaces are declared")]
    Namespaces,
}

/// Checks attributes, depth and namespaces of a document in one pass.
///
/// # Errors
/// The first place beyond a limit.
pub fn check_nesting(text: &str) -> Result<(), Nesting> {
    let bytes = text.as_bytes();
    let (mut at, mut depth, mut namespaces) = (0, 0_usize, 0);
    while let Some(start) = find(bytes, at, b"<") {
        let rest = &bytes[start..];
        let skipped = [
            (b"<!--".as_slice(), b"-->".as_slice()),
            (b"<![CDATA[", b"]]>"),
            (b"<?", b"?>"),
            (b"<!", b">"),
        ]
        .into_iter()
        .find(|(opening, _)| rest.starts_with(opening));
        if let Some((opening, closing)) = skipped {
            // What is not closed is not well-formed.
            let Some(end) = find(bytes, start + opening.len(), closing) else {
                return Ok(());
            };
            at = end + closing.len();
            continue;
        }
        let tag = Tag::scan(bytes, start + 1);
        at = tag.content.end;
        namespaces += tag.namespaces;
        let problem = if tag.attributes > MAX_ATTRIBUTES {
            Some(NestingProblem::Attributes)
        } else if namespaces > MAX_NAMESPACES {
            Some(NestingProblem::Namespaces)
        } else if tag.is_end {
            depth = depth.saturating_sub(1);
            None
        } else {
            depth += usize::from(!tag.is_empty);
            (depth > MAX_DEPTH).then_some(NestingProblem::Depth)
        };
        if let Some(problem) = problem {
            let before = &bytes[..start];
            let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count() as u32;
            return Err(Nesting { line, problem });
        }
    }
    Ok(())
}

/// A start or an end tag.
struct Tag {
    /// The bytes between `<` and `>`.
    content: Range<usize>,
    attributes: usize,
    namespaces: usize,
    is_end: bool,
    is_empty: bool,
}

impl Tag {
    fn scan(bytes: &[u8], start: usize) -> Self {
        let mut tag = Self {
            content: start..bytes.len(),
            attributes: 0,
            namespaces: 0,
            is_end: bytes.get(start) == Some(&b'/'),
            is_empty: false,
        };
        let mut quote = None;
        for (at, &byte) in bytes.iter().enumerate().skip(start) {
            match quote {
                Some(closing) if byte == closing => quote = None,
                Some(_) => {}
                None if byte == b'"' || byte == b'\'' => quote = Some(byte),
                None if byte == b'=' => {
                    tag.attributes += 1;
                    let name = bytes[start..at].trim_ascii_end();
                    let ends = |byte: &u8| byte.is_ascii_whitespace() || b"\"'".contains(byte);
                    let name = name.rsplit(ends).next();
                    tag.namespaces += usize::from(name.is_some_and(|n| n.starts_with(b"xmlns")));
                }
                None if byte == b'>' => {
                    tag.content.end = at;
                    tag.is_empty = bytes[at - 1] == b'/';
                    break;
                }
                None => {}
            }
            // What follows changes nothing.
            if tag.attributes > MAX_ATTRIBUTES {
                break;
            }
        }
        tag
    }
}

fn find(bytes: &[u8], from: usize, wanted: &[u8]) -> Option<usize> {
    let rest = bytes.get(from..)?;
    let found = rest
        .windows(wanted.len())
        .position(|window| window == wanted)?;
    Some(from + found)
}

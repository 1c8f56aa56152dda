//! What the reader and the grammar both know of things: their names, what they are made of, and which parts
//! of them are things of their own.

mod names;

pub(crate) use names::{LONGEST, is_quality, keys, name, vocabulary};
pub use names::{in_one_word, key, names, qualities};

use crate::{Vocabulary, words::singular};

/// What things are made of: lines `word TAB substance`, sorted; the substance is left out where it is the
/// word.
const SUBSTANCES: &str = include_str!("substances.tsv");
/// Parts that are as they are, whatever they belong to.
const OWN_PARTS: &[&str] = &[
    "blade", "buckle", "button", "grip", "handle", "hilt", "hinge", "knob", "shaft", "spout",
    "strap", "zip",
];

/// Whether a text is the name of something.
#[must_use]
pub fn is_name(text: &str) -> bool {
    name(&text.split(' ').collect::<Vec<_>>()).is_some()
}

/// The substance that a word names.
pub(crate) fn substance(word: &str) -> Option<&'static str> {
    let line = Vocabulary::new(SUBSTANCES).line("", word)?;
    Some(line.split_once('\t').map_or(line, |(_, name)| name))
}

/// Whether a part, in the singular, is as it is, whatever it belongs to.
pub(crate) fn is_own_part(part: &str) -> bool {
    OWN_PARTS.contains(&part)
}

/// The part that a name ends in, if it is as it is: the handle of "axe handle".
pub(crate) fn own_part(name: &str) -> Option<&str> {
    let (_, part) = name.rsplit_once(' ')?;
    is_own_part(&singular(part)).then_some(part)
}

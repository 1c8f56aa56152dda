//! The lexicon shared by the reader, the tagger and the grammar: names of things, their substances, parts that are
//! things of their own, function words, and the senses of words on no list.

pub(crate) mod closed_class;
mod names;
pub(crate) mod word_sense;

pub(crate) use names::{LONGEST, is_quality, keys, name, vocabulary};
pub use names::{in_one_word, key, names, qualities};

use crate::{Vocabulary, words::singular};
use closed_class::{is_colour, is_grammar};

/// Substances of things: lines `word TAB substance`, sorted; the substance is left out where it equals the word.
const SUBSTANCES: &str = include_str!("substances.tsv");
/// Parts that are as they are, whatever they belong to.
const OWN_PARTS: &[&str] = &[
    "blade", "buckle", "button", "grip", "handle", "hilt", "hinge", "knob", "shaft", "spout",
    "strap", "zip",
];

/// Returns true if a text is a name in the lexicon.
#[must_use]
pub fn is_name(text: &str) -> bool {
    name(&text.split(' ').collect::<Vec<_>>()).is_some()
}

/// The longest name that words begin with, of those that `accepts` holds for, and how many words it has. In "violet
/// wool" the first is a colour.
pub(crate) fn longest(
    words: &[&str],
    accepts: impl Fn(usize, &str) -> bool,
) -> Option<(usize, &'static str)> {
    let coloured = |count: usize| {
        let next = words.get(1).is_some_and(|next| !is_grammar(next));
        count == 1 && next && is_colour(words[0])
    };
    (1..=words.len().min(LONGEST)).rev().find_map(|count| {
        let name = name(&words[..count]).filter(|name| accepts(count, name))?;
        (!coloured(count)).then_some((count, name))
    })
}

/// Returns true if a word has the form of an adjective: "ribbed", and "frosty" beside "frost".
pub(crate) fn is_adjectival(word: &str) -> bool {
    let participle = word.len() > 5 && word.ends_with("ed");
    let of_noun = |stem: &str| stem.len() > 2 && (is_name(stem) || is_name(&format!("{stem}e")));
    (participle && !word.ends_with("eed")) || word.strip_suffix('y').is_some_and(of_noun)
}

/// The substance that a word names.
pub(crate) fn substance(word: &str) -> Option<&'static str> {
    let line = Vocabulary::new(SUBSTANCES).line("", word)?;
    Some(line.split_once('\t').map_or(line, |(_, name)| name))
}

/// Returns true if a part, in the singular, feels the same whatever it belongs to.
pub(crate) fn is_own_part(part: &str) -> bool {
    OWN_PARTS.contains(&part)
}

/// The part that a name ends in, if it is as it is: the handle of "axe handle".
pub(crate) fn own_part(name: &str) -> Option<&str> {
    let (_, part) = name.rsplit_once(' ')?;
    is_own_part(&singular(part)).then_some(part)
}

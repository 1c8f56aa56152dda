//! BERT's tokens of a text, in lower case and without accents.

use super::vocabulary::Vocabulary;
use unicode_categories::UnicodeCategories as _;
use unicode_normalization::char::decompose_canonical;

/// Characters of the longest word that is cut into pieces; a longer one is unknown.
const LONGEST_WORD: usize = 100;
/// What a piece inside a word begins with.
const INSIDE: &str = "##";
/// The piece that stands for what no piece fits.
pub(super) const UNKNOWN: &str = "[UNK]";

/// Appends the ids of a text, without marks for its start and end; `None` when the vocabulary
/// lacks the piece for the unknown.
pub(super) fn encode(text: &str, vocabulary: &Vocabulary, ids: &mut Vec<i64>) -> Option<()> {
    let normal = normalised(text);
    let mut rest = normal.as_str();
    while let Some(first) = rest.chars().next() {
        let length = if stands_alone(first) {
            first.len_utf8()
        } else {
            rest.find(stands_alone).unwrap_or(rest.len())
        };
        let (word, after) = rest.split_at(length);
        if !first.is_whitespace() {
            encode_word(word, vocabulary, ids)?;
        }
        rest = after;
    }
    Some(())
}

/// A text character by character: decomposed, without nonspacing marks, in lower case.
fn normalised(text: &str) -> String {
    let mut normal = String::with_capacity(text.len());
    for character in text.chars() {
        decompose_canonical(character, |part| {
            if !part.is_mark_nonspacing() {
                normal.extend(part.to_lowercase());
            }
        });
    }
    normal
}

/// Whether a character ends a word and is a word of its own, or white space.
fn stands_alone(character: char) -> bool {
    character.is_ascii_punctuation() || character.is_punctuation() || character.is_whitespace()
}

/// Appends the longest pieces that a word begins with, one after the other, until the word is used
/// up or none fits.
fn encode_word(word: &str, vocabulary: &Vocabulary, ids: &mut Vec<i64>) -> Option<()> {
    let mut rest = word;
    let mut prefix = "";
    let short = word.chars().nth(LONGEST_WORD).is_none();
    while short && let Some((id, length)) = longest(prefix, rest, vocabulary) {
        ids.push(id);
        rest = &rest[length..];
        prefix = INSIDE;
    }
    if !rest.is_empty() {
        ids.push(vocabulary.id("", UNKNOWN)?.into());
    }
    Some(())
}

/// Id and bytes of the longest piece that `rest` begins with, of those with this prefix.
fn longest(prefix: &str, rest: &str, vocabulary: &Vocabulary) -> Option<(i64, usize)> {
    let ends = rest.char_indices().map(|(start, c)| start + c.len_utf8());
    ends.rev().find_map(|end| {
        let id = vocabulary.id(prefix, &rest[..end])?;
        Some((id.into(), end))
    })
}

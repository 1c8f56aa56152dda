//! What the lexicon holds: names of the materials that the model knows, their synonyms, things of the
//! rated lexicon, and the words that say how its things feel.
//!
//! `names.tsv` has lines `key TAB name`, sorted by the bytes of the key; the name is left out where it
//! equals the key. A key is a name as [`normalise`](crate::words::normalise) divides it, each word
//! in the singular. `qualities.txt` has a word a line. Both are written by
//! `cargo run --release -p asperity-corpus --example names`.

use crate::learned::text::Vocabulary;
use crate::words::{Token, normalise, singular};

const NAMES: &str = include_str!("names.tsv");
const QUALITIES: &str = include_str!("qualities.txt");
/// Words of a name at most.
pub(in crate::sources::prompt) const LONGEST: usize = 5;

/// The key of a name; `None` for a text of no words or too many.
#[must_use]
pub fn key(name: &str) -> Option<String> {
    let tokens = normalise(name);
    let words = tokens.iter().filter_map(|token| match token {
        Token::Word(word) => Some(word.as_str()),
        Token::Break => None,
    });
    let words: Vec<&str> = words.collect();
    (1..=LONGEST).contains(&words.len()).then(|| key_of(&words))
}

fn key_of(words: &[&str]) -> String {
    let mut key = String::new();
    for word in words {
        if !key.is_empty() {
            key.push(' ');
        }
        key.push_str(&singular(word));
    }
    key
}

/// The name that these words are, as the corpus spells it.
pub(in crate::sources::prompt) fn name(words: &[&str]) -> Option<&'static str> {
    let line = Vocabulary::new(NAMES).line("", &key_of(words))?;
    Some(line.split_once('\t').map_or(line, |(_, name)| name))
}

/// Whether the lexicon says of something how it feels by this word.
pub(in crate::sources::prompt) fn is_quality(word: &str) -> bool {
    Vocabulary::new(QUALITIES).line("", word).is_some()
}

/// Every word of a name's key, as often as it stands in one, and every quality.
pub(in crate::sources::prompt) fn vocabulary() -> impl Iterator<Item = &'static str> {
    keys()
        .flat_map(|key| key.split(' '))
        .chain(QUALITIES.lines())
}

/// Every name, as the corpus spells it.
pub(in crate::sources::prompt) fn names() -> impl Iterator<Item = &'static str> {
    NAMES.lines().filter_map(|line| line.rsplit('\t').next())
}

/// The words by which the lexicon says how something feels.
pub(in crate::sources::prompt) fn qualities() -> impl Iterator<Item = &'static str> {
    QUALITIES.lines()
}

/// The key of every name.
pub(in crate::sources::prompt) fn keys() -> impl Iterator<Item = &'static str> {
    let key = |line: &'static str| line.split_once('\t').map_or(line, |(key, _)| key);
    NAMES.lines().map(key)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_is_found_by_its_key() {
        let lines: Vec<&str> = NAMES.lines().collect();
        let keys: Vec<&str> = lines
            .iter()
            .map(|line| line.split('\t').next().unwrap_or_default())
            .collect();
        assert!(keys.windows(2).all(|pair| pair[0] < pair[1]), "sorted");
        for line in lines {
            let shown = line.split('\t').next_back().unwrap_or_default();
            let words = key(line.split('\t').next().unwrap_or_default()).expect(shown);
            let words: Vec<&str> = words.split(' ').collect();
            assert_eq!(name(&words), Some(shown));
        }
    }

    #[test]
    fn plurals_and_other_spellings_are_the_same_name() {
        assert_eq!(name(&["corks"]), name(&["cork"]));
        assert_eq!(key("Steel-Wool"), key("steel wool"));
        assert_eq!(name(&["zither", "soup"]), None);
    }
}

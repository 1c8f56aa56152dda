//! Word lists of the lexicon: names of the materials that the model knows, their synonyms, things of the rated lexicon,
//! and the words that say how its things feel.
//!
//! `names.tsv` has lines `key TAB name`, sorted by the bytes of the key; the name is left out where it
//! equals the key. A key is a name as [`normalise`](crate::words::normalise) divides it, each word
//! in the singular. `qualities.txt` has a word a line. Both are written by
//! `cargo run --release -p asperity-corpus --example names`.

use crate::Vocabulary;
use crate::words::{Token, normalise, singular, without_accents};
use std::{collections::HashMap, sync::LazyLock};

const NAMES: &str = include_str!("names.tsv");
const QUALITIES: &str = include_str!("qualities.txt");
/// Words of a name at most.
pub(crate) const LONGEST: usize = 5;

/// The key of a name; `None` for a text of no words or too many.
#[must_use]
pub fn key(name: &str) -> Option<String> {
    let tokens = normalise(name);
    let words: Vec<&str> = tokens.iter().filter_map(Token::word).collect();
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

/// Names by their keys, as they are spelt in one word and without accents.
static IN_ONE_WORD: LazyLock<HashMap<String, &'static str>> = LazyLock::new(|| {
    let name = |line: &'static str| {
        let (key, name) = line.split_once('\t').unwrap_or((line, line));
        (in_one_word(key), name)
    };
    NAMES.lines().map(name).collect()
});
/// Letters of a name that may be spelt otherwise: "lame" is no lamé.
const LEAST_LETTERS: usize = 5;

/// Returns the key shared by all spellings of a name: "steel wool", "steelwool"; "crêpe", "crepe".
#[must_use]
pub fn in_one_word(key: &str) -> String {
    without_accents(key).replace(' ', "")
}

/// The name that these words are, as the corpus spells it.
pub(crate) fn name(words: &[&str]) -> Option<&'static str> {
    let key = key_of(words);
    if let Some(line) = Vocabulary::new(NAMES).line("", &key) {
        return Some(line.split_once('\t').map_or(line, |(_, name)| name));
    }
    // "tea towels", "bees wax"
    let joined = singular(&words.concat()).into_owned();
    [key, joined]
        .iter()
        .map(|key| in_one_word(key))
        .find_map(|key| {
            let long = key.len() >= LEAST_LETTERS;
            IN_ONE_WORD.get(&key).copied().filter(|_| long)
        })
}

/// Returns true if the lexicon uses this word to describe the feel of something.
pub(crate) fn is_quality(word: &str) -> bool {
    Vocabulary::new(QUALITIES).line("", word).is_some()
}

/// Every word of a name's key, as often as it stands in one, and every quality.
pub(crate) fn vocabulary() -> impl Iterator<Item = &'static str> {
    keys()
        .flat_map(|key| key.split(' '))
        .chain(QUALITIES.lines())
}

/// Every name, as the corpus spells it.
pub fn names() -> impl Iterator<Item = &'static str> {
    NAMES.lines().filter_map(|line| line.rsplit('\t').next())
}

/// The words by which the lexicon says how something feels.
pub fn qualities() -> impl Iterator<Item = &'static str> {
    QUALITIES.lines()
}

/// The key of every name.
pub(crate) fn keys() -> impl Iterator<Item = &'static str> {
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

    #[test]
    fn a_name_is_the_same_in_one_word_and_in_several_and_without_accents() {
        for (words, other) in [
            (&["steelwool"][..], &["steel", "wool"][..]),
            (&["teatowels"], &["tea", "towel"]),
            (&["steelwool", "pad"], &["steel", "wool", "pad"]),
            (&["bees", "wax"], &["beeswax"]),
            (&["sand", "paper"], &["sandpaper"]),
            (&["crepe", "paper"], &["crêpe", "paper"]),
            (&["suède"], &["suede"]),
        ] {
            assert!(name(words).is_some(), "{words:?}");
            assert_eq!(name(words), name(other), "{words:?}");
        }
        assert_eq!(name(&["lame"]), None);
    }

    /// Claim: no two spellings of one name lead to two names.
    #[test]
    fn every_spelling_is_one_name() {
        for line in NAMES.lines() {
            let (key, shown) = line.split_once('\t').unwrap_or((line, line));
            assert_eq!(IN_ONE_WORD[&in_one_word(key)], shown, "{key}");
        }
    }
}

//! Words of grammar, and others of which there is a fixed number: they name nothing themselves.

use crate::{Vocabulary, phrase};

/// Lines `words TAB classes`, sorted by the bytes of the words. `determiner`: also pronouns. `auxiliary`: verbs of being and
/// having. `link`: joins two objects, or an object and its qualities. `place`: after it comes a place, an owner, a time, a
/// use, or what something moves across. `act`: what a prompt says of itself or of touching. `colour`: also patterns, shapes,
/// and what speaks of them. `picture` and `part`: of what follows "of". `covering`: a participle after which "in", "with" or
/// "from" names the cover or the material of an object. `not`, `without` and `with`: words that mean these. From `hardly`
/// to `extremely`: words of degree. `empty`: names nothing. Of an edit, `raise`, `lower`, and `filler`, which asks for
/// nothing.
const CLOSED_CLASS: &str = include_str!("closed_class.tsv");

/// Returns true if a word has any of these classes.
pub(crate) fn is(word: &str, classes: &[&str]) -> bool {
    let line = Vocabulary::new(CLOSED_CLASS).line("", word);
    let own = line.and_then(|line| line.split_once('\t'));
    own.is_some_and(|(_, own)| own.split(' ').any(|class| classes.contains(&class)))
}

/// Returns the number of words in a leading "not", "without" or "with", and the canonical word.
pub(crate) fn meant(words: &[&str]) -> Option<(usize, &'static str)> {
    (1..=words.len().min(LONGEST)).rev().find_map(|count| {
        let said = words[..count].join(" ");
        let mut meanings = ["not", "without", "with"].into_iter();
        Some((count, meanings.find(|meaning| is(&said, &[meaning]))?))
    })
}

/// Words of a line at most.
const LONGEST: usize = 3;

/// Returns true for a colour or a pattern.
#[must_use]
pub fn is_colour(word: &str) -> bool {
    is(word, &["colour"]) || word.ends_with("coloured") || word.ends_with("chequered")
}

/// Returns true if a word before "of" names a part of an object.
pub(crate) fn is_part(word: &str) -> bool {
    is(word, &["part"])
}

/// Returns true if "in", "by" or "from" after this word names the cover or the material of an object.
pub(crate) fn is_covering(word: &str) -> bool {
    phrase::is_cover(word) || is(word, &["covering"])
}

/// Returns true for a word that has no meaning of its own.
pub(crate) fn is_function(word: &str) -> bool {
    is(word, &["determiner", "auxiliary", "link", "place"])
}

/// Returns true for a form of "be" or "have".
pub(crate) fn is_auxiliary(word: &str) -> bool {
    is(word, &["auxiliary"])
}

/// Returns true if a place, an owner, a time or a use follows the word.
pub(crate) fn is_place(word: &str) -> bool {
    is(word, &["place"])
}

/// Returns true if a word before "of" denotes a depiction.
pub(crate) fn is_picture(word: &str) -> bool {
    is(word, &["picture"])
}

/// Returns true for a function word, or a word for touching itself.
#[must_use]
pub fn is_grammar(word: &str) -> bool {
    is_function(word) || is_act(word)
}

/// Returns true for an article, a determiner or a pronoun.
pub(crate) fn is_determiner(word: &str) -> bool {
    is(word, &["determiner"])
}

/// Returns true if a word joins an object to its description.
pub(crate) fn is_link(word: &str) -> bool {
    is(word, &["link"])
}

/// Returns true for a word about touching or about the prompt itself.
pub(crate) fn is_act(word: &str) -> bool {
    is(word, &["act", "picture"])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_sorted_and_of_known_classes() {
        let words: Vec<&str> = CLOSED_CLASS
            .lines()
            .filter_map(|line| line.split('\t').next())
            .collect();
        assert!(words.windows(2).all(|pair| pair[0] < pair[1]));
        const CLASSES: &[&str] = &[
            "determiner",
            "auxiliary",
            "link",
            "place",
            "act",
            "colour",
            "picture",
            "part",
            "covering",
            "not",
            "without",
            "with",
            "hardly",
            "little",
            "fairly",
            "very",
            "extremely",
            "empty",
            "raise",
            "lower",
            "filler",
        ];
        assert!(words.iter().all(|word| is(word, CLASSES)));
    }
}

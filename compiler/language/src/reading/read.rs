//! Reading of a text from tables alone, and the words that a reading leaves out.

use super::{
    Reading,
    group::is_content,
    parts,
    segment::{Class, Item},
};
use crate::{
    lexicon::{
        self,
        closed_class::{is_auxiliary, is_colour, is_determiner},
    },
    phrase,
    words::grade::Grade,
};

/// Returns true if the tables alone can read a text: it has only names, qualities and words that join them.
pub(super) fn is_bare(items: &[Item]) -> bool {
    let listed = |text: &str| {
        phrase::is_quality(text) || lexicon::is_quality(text) || Grade::of(text).is_some()
    };
    // In a few words, what a word vector says of a word is enough.
    let few = items.len() <= FEW;
    let named = items.iter().any(|item| item.class == Class::Name);
    let plain = |item: &Item| match item.class {
        Class::Name | Class::Degree | Class::Break | Class::Link | Class::Denial => true,
        Class::Touch => few || listed(&item.text),
        Class::Thing => few || parts::is_part(&item.text),
        // How near they lie to what the model knows decides the rest.
        Class::Other => items.len() < FEW && !named && !is_colour(&item.text),
        Class::Function => is_determiner(&item.text) && !is_person(&item.text),
        _ => false,
    };
    // "steel, not wood": what is denied is no quality.
    let said: Vec<&Item> = items
        .iter()
        .filter(|item| !is_determiner(&item.text))
        .collect();
    let denied = |pair: &[&Item]| pair[0].class == Class::Denial && !listed(&pair[1].text);
    items.iter().all(plain) && !said.windows(2).any(denied)
}

/// Words of a text that is read by word vectors alone.
pub(super) const FEW: usize = 3;

/// Returns true for a personal pronoun, which occurs only in sentences.
pub(super) fn is_person(word: &str) -> bool {
    const PERSONS: &[&str] = &[
        "i", "you", "he", "she", "we", "they", "me", "him", "us", "them", "who",
    ];
    PERSONS.contains(&word)
}

/// Returns true for a question or a statement, which a description of an object never is.
pub(super) fn is_clause(items: &[Item]) -> bool {
    let is = |n: usize, words: &[&str]| {
        items
            .get(n)
            .is_some_and(|item| words.contains(&item.text.as_str()))
    };
    let asks = is(0, &["how", "why"]) || (is(0, &["what"]) && is(1, &["a", "an", "the"]));
    let states = |n: usize| {
        is_auxiliary(&items[n].text) && !is(n.wrapping_sub(1), &["that", "which", "what", "who"])
    };
    asks || (0..items.len()).any(|n| items[n].class == Class::Break || states(n))
}

/// Words of content that are in a text, and not in what was read of it.
pub(super) fn left_out(items: &[Item], reading: &Reading) -> Vec<String> {
    let says = |item: &&Item| is_content(item) || is_colour(&item.text);
    let gone = items
        .iter()
        .filter(says)
        .filter(|item| !reading.holds(&item.text));
    gone.map(|item| item.text.clone()).collect()
}

/// All words of a text.
pub(super) fn whole(items: &[Item]) -> Vec<String> {
    let said = items
        .iter()
        .filter(|item| !item.said.is_empty() && item.class != Class::Break);
    said.map(|item| item.said.clone()).collect()
}

/// Returns the words to encode of a text in which nothing is touched: all words of content.
pub(super) fn unread(items: &[Item]) -> Vec<String> {
    let words = |says: fn(&Item) -> bool| -> Vec<String> {
        let said = items
            .iter()
            .filter(|item| says(item) && !item.said.is_empty());
        said.map(|item| item.said.clone()).collect()
    };
    let content = words(is_content);
    if content.is_empty() {
        words(|_| true)
    } else {
        content
    }
}

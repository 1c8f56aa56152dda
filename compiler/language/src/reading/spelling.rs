//! Misspellings: a word that no one knows, and that is nearly one of the reader's.

use crate::lexicon::closed_class::{is_colour, is_grammar};
use crate::words::{Token, singular, spelled, without_accents};
use crate::{Vocabulary, WordVectors, lexicon, phrase};
use std::collections::BTreeMap;

/// English words that the table of words lacks, and that one edit parts from a word of the reader's: no
/// misspellings. From the package `word-list` (MIT, its licence beside this file), a line each and sorted;
/// `compiler/model/tools/export_reading.py` writes it.
const OWN_WORDS: &str = include_str!("own_words.txt");
/// Letters of a word that can be misspelt.
const SHORTEST: usize = 3;
/// A word of fewer letters is misspelt only where it stands alone.
const SHORT: usize = 5;
/// Letters of a name of several words in which an error is looked for.
const LONG: usize = 8;
/// Letters of each of two words that stand without a space.
const PART: usize = 4;
/// Letters of two words without a space at most; no two words of the reader's have more.
const BOTH: usize = 40;
/// Letters from which on one error leaves hardly a doubt: many a shorter word of another language is one letter away
/// from an English one.
const SURE: usize = 6;

/// A word that was read as another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Correction {
    /// The word as it was typed.
    pub said: String,
    /// The corrected word.
    pub corrected: String,
    /// True if another correction is as likely: the corrected word is a guess.
    pub doubtful: bool,
}

/// Puts a misspelt name right, or the one misspelt word of a prompt. Words that only lack the space between them are no
/// misspellings.
pub(super) fn correct(tokens: &mut Vec<Token>, table: &impl WordVectors) -> Option<Correction> {
    part(tokens, table);
    whole(tokens).or_else(|| one_word(tokens, table))
}

/// Parts words that no one knows between two that say something: "brickwall", "carbonfiber".
fn part(tokens: &mut Vec<Token>, table: &impl WordVectors) {
    let mut at = 0;
    while at < tokens.len() {
        let parts = match &tokens[at] {
            Token::Word(word)
                if word.len() <= BOTH && word.is_ascii() && !is_known(word, table) =>
            {
                // "sandstonee" is rather a misspelling.
                two_words(word).filter(|_| nearest(word).is_none())
            }
            _ => None,
        };
        if let Some(parts) = parts {
            tokens.splice(at..=at, parts.map(Token::Word));
        }
        at += 1;
    }
}

/// The two words that one is put together of: a quality or a name, and a name.
fn two_words(word: &str) -> Option<[String; 2]> {
    let is_name = |word: &str| lexicon::name(&[word]).is_some();
    (PART..=word.len().saturating_sub(PART)).find_map(|at| {
        let [first, second] = [&word[..at], &word[at..]].map(|part| spelled(part).into_owned());
        let says = phrase::is_quality(&first) || is_name(&first);
        (says && is_name(&second)).then_some([first, second])
    })
}

/// A prompt that is a name of several words with one error, even where the error makes another word:
/// "patent lather". A word must be left over that says nothing by itself.
fn whole(tokens: &mut Vec<Token>) -> Option<Correction> {
    let words: Option<Vec<&str>> = tokens.iter().map(Token::word).collect();
    let words = words.filter(|words| (2..=lexicon::LONGEST).contains(&words.len()))?;
    let says = |word: &&str| {
        let name = lexicon::name(&[*word]).is_some();
        name || is_grammar(word) || phrase::is_quality(word) || lexicon::is_quality(word)
    };
    if lexicon::name(&words).is_some() {
        return None;
    }
    // A wrong digit makes another number, and that is no misspelling.
    let said = words.join(" ");
    if said.bytes().any(|byte| byte.is_ascii_digit()) {
        return None;
    }
    if said.len() < LONG || words.iter().all(says) {
        return None;
    }
    let near = |key: &&str| {
        let several = key.contains(' ') && key.len().abs_diff(said.len()) <= 1;
        several && strsim::osa_distance(key, &said) <= 1
    };
    let corrected = lexicon::keys().find(near)?.to_owned();
    let corrected_words = corrected
        .split(' ')
        .map(|word| Token::Word(word.to_owned()));
    *tokens = corrected_words.collect();
    Some(Correction {
        said,
        corrected,
        doubtful: false,
    })
}

/// The one word that nobody knows. Where two are unknown, it is rather another language, or somebody's
/// name, and nothing is touched.
fn one_word(tokens: &mut [Token], table: &impl WordVectors) -> Option<Correction> {
    let alone = tokens.len() == 1;
    let mut unknown = tokens.iter_mut().filter_map(|token| match token {
        Token::Word(word) if !is_known(word, table) => Some(word),
        _ => None,
    });
    let word = unknown.next()?;
    if unknown.next().is_some() || !word.is_ascii() {
        return None;
    }
    // Beside others, a short word is rather slang: "idk", "org".
    if word.len() < SHORT && !alone {
        return None;
    }
    let corrected = nearest(word)?.to_owned();
    let said = std::mem::replace(word, corrected.clone());
    let first = said.as_bytes().first() == corrected.as_bytes().first();
    let sure = first && (said.len() >= SURE || is_swapped(&said, &corrected));
    Some(Correction {
        said,
        corrected,
        doubtful: !sure,
    })
}

/// Returns true if two words are anagrams.
fn is_swapped(a: &str, b: &str) -> bool {
    let [a, b] = [a, b].map(|word| {
        let mut letters = word.as_bytes().to_vec();
        letters.sort_unstable();
        letters
    });
    a == b
}

/// Returns true for a word on a list of English; any other is a misspelling, of another language, or a person's name. A
/// word with letters that are not Latin is not a misspelling.
pub(super) fn is_known(word: &str, table: &impl WordVectors) -> bool {
    let word = &*without_accents(word);
    let letters = word.chars().all(|c| c.is_ascii_lowercase());
    let own = |word: &str| Vocabulary::new(OWN_WORDS).line("", word).is_some();
    !letters
        || word.len() < SHORTEST
        || table.holds(word)
        || is_grammar(word)
        || is_colour(word)
        || phrase::is_quality(word)
        || phrase::is_degree(word)
        || lexicon::is_quality(word)
        || own(word)
        || own(&singular(word))
        || lexicon::name(&[word]).is_some()
        // Looked through from end to end, so last.
        || lexicon::vocabulary().any(|known| known == word)
}

/// The word of the reader's that one edit parts from this one. Of several, one with the same first letter,
/// then the one in most names.
fn nearest(word: &str) -> Option<&'static str> {
    let word = singular(word);
    let near = |known: &&'static str| {
        known.len() >= SHORTEST
            && known.len().abs_diff(word.len()) <= 1
            && strsim::osa_distance(known, &word) <= 1
    };
    let mut found: BTreeMap<&'static str, usize> = BTreeMap::new();
    for known in lexicon::vocabulary().filter(near) {
        *found.entry(known).or_default() += 1;
    }
    let rank = |(known, times): &(&'static str, usize)| {
        let first = known.as_bytes().first() != word.as_bytes().first();
        (first, usize::MAX - times)
    };
    Some(found.into_iter().min_by_key(rank)?.0)
}

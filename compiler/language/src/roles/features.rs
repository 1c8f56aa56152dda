//! Input features of the tagger: the entries of the tables for each word of a text.

use super::WIDTH;
use crate::{
    WordVectors,
    lexicon::{
        self, LONGEST,
        closed_class::{is_colour, is_grammar},
        substance, word_sense,
    },
    phrase,
    words::Token,
};

/// Flags of a word, each 0 or 1.
pub type Flags = [f32; WIDTH];

/// The flags of every token: [`FLAGS`](super::FLAGS) says which is which.
pub fn flags(tokens: &[Token], table: &impl WordVectors) -> Vec<Flags> {
    let mut all = vec![Flags::default(); tokens.len()];
    let mut at = 0;
    while at < tokens.len() {
        let words: Vec<&str> = tokens[at..]
            .iter()
            .map_while(Token::word)
            .take(LONGEST)
            .collect();
        let taken = lexicon::longest(&words, |_, _| true);
        let count = taken.map_or(1, |(count, _)| count);
        for (n, flags) in all[at..at + count].iter_mut().enumerate() {
            let mut set = |flag: usize, holds: bool| flags[flag] = f32::from(u8::from(holds));
            let Some(word) = tokens[at + n].word() else {
                set(0, true);
                continue;
            };
            let sense = word_sense::sense(table, word);
            set(1, taken.is_some());
            set(2, taken.is_some() && n + 1 == count);
            set(3, count > 1);
            set(4, substance(word).is_some());
            set(5, phrase::is_quality(word));
            set(6, lexicon::is_quality(word));
            set(7, phrase::is_degree(word));
            set(8, is_grammar(word));
            set(9, is_colour(word));
            set(10, sense.touch);
            set(11, sense.thing);
            set(12, word.bytes().any(|byte| byte.is_ascii_digit()));
            set(13, word.ends_with("'s"));
        }
        at += count;
    }
    all
}

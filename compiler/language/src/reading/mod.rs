//! Reading of a prompt: the things that it names, and how it describes their feel.
//!
//! A sentence encoder reads the whole sentence: "make me gravel" is near to gravel, and near to making.
//! So a prompt is read before it is encoded. It is [normalised](normalise()), and a misspelling is corrected. Where tables
//! of names and qualities hold all of its words, they alone say what it is. Of any other text a [tagger](crate::roles) tells
//! which words say what is touched. What these are together is one phrase, qualities first, and only that is
//! encoded. English only.
//!
//! ```
//! use asperity_language::{WordVectors, reading::Reader, roles::WordStates, words::Token};
//!
//! /// Takes every word for English, and knows nothing about it.
//! struct NoTable;
//! impl WordVectors for NoTable {
//!     fn holds(&self, _: &str) -> bool { true }
//!     fn vector(&self, _: &str) -> Option<Vec<f32>> { None }
//! }
//! impl WordStates for NoTable {
//!     fn states(&self, _: &[Token]) -> Vec<Vec<f32>> { Vec::new() }
//! }
//!
//! let reader = Reader::new(NoTable, NoTable);
//! assert_eq!(reader.read("granite, very rough").text(), "very rough granite");
//! // Without states no sentence is read.
//! assert!(!reader.read("I walked over granite").says);
//! ```

mod contact;
mod description;
mod explained;
mod graphics;
mod group;
mod parts;
mod read;
mod segment;
mod spelling;

use group::{Group, phrase_of};
use read::is_bare;
use segment::{Class, Item};

pub use crate::lexicon::closed_class::{is_colour, is_grammar};
pub use crate::lexicon::{in_one_word, key};
pub use crate::roles::Role;
pub use crate::words::{Token, normalise, shown};
pub use explained::Interpretation;
pub use spelling::Correction;

use std::borrow::Cow;

use crate::{
    WordVectors,
    lexicon::word_sense,
    phrase::{self, Phrase},
    roles::WordStates,
    words::{
        grade::{self, Grade, Note},
        singular, without_accents,
    },
};

/// Version of the reader: the CRC-32 of its readings of the prompts in `training/corpora/evaluation/`, and of their
/// grammar, which the test `judged::the_version_of_the_reader_follows_what_it_reads` computes.
pub const VERSION: &str = "34cd677d";

/// Words of a prompt that are read: several times what an encoder reads of them.
pub const MOST_WORDS: usize = 1024;
/// Words of a description that is encoded as a whole.
const MOST_DESCRIBED: usize = 10;

/// Reads prompts with a table of words `T` and states of words `S`.
#[derive(Debug, Clone, Copy)]
pub struct Reader<T, S> {
    table: T,
    states: S,
}

/// The reading of a prompt.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Reading {
    /// The names that it says, as the corpus spells them.
    pub names: Vec<String>,
    /// Text to encode: names, each as one entry, and the words that say how something feels.
    pub words: Vec<String>,
    /// Grammar of these words together.
    pub phrase: Phrase,
    /// True if the prompt mentions a touched surface.
    pub contact: bool,
    /// Confidence in the reading, 0..=1: the least probability with which a word of content is felt, or is not. 1 where
    /// tables alone give the reading.
    pub sure: f32,
    /// True if any remaining word names something, or says how it feels.
    pub says: bool,
    /// Words that were left out because they say nothing of touch.
    pub ignored: Vec<String>,
    /// Among these, objects that carry the surface, denied words, and tools.
    pub others: Vec<(Role, String)>,
    /// A word that was misspelt.
    pub correction: Option<Correction>,
    /// Notes to the user on its numbers: those out of range, and those that may be read in two ways.
    pub numbers: Vec<String>,
    /// Two numbers of which only one can hold, the one that is taken last.
    pub conflict: Option<[Grade; 2]>,
    /// Words at the end that were not read: those after the first [`MOST_WORDS`], or of a sentence after the first 512
    /// pieces.
    pub cut: usize,
}

impl Reading {
    /// The text that is encoded.
    #[must_use]
    pub fn text(&self) -> String {
        self.words.join(" ")
    }

    /// Returns true if any word of this text is encoded.
    #[must_use]
    pub fn holds(&self, text: &str) -> bool {
        let words = || self.words.iter().flat_map(|word| word.split(' '));
        text.split(' ')
            .any(|word| words().any(|said| singular(said) == singular(word)))
    }
}

impl<T: WordVectors, S: WordStates> Reader<T, S> {
    /// A reader with a table of words, and the states from which it tells their roles.
    #[must_use]
    pub fn new(table: T, states: S) -> Self {
        Self { table, states }
    }

    /// Reads a text.
    #[must_use]
    pub fn read(&self, prompt: &str) -> Reading {
        let mut text = Text::new(prompt, &self.table);
        let items = text.items(&self.table);
        // "gravel idk", "gravel 2048x2048": beside a name, what nobody knows says nothing, unless most words are foreign.
        let has = |class: Class| items.iter().any(|item| item.class == class);
        let known = items.iter().filter(|item| self.knows(item));
        let mut known: Vec<Item> = known.cloned().collect();
        if !has(Class::Name) || has(Class::Denial) || known.len() * 3 < items.len() {
            known.clone_from(&items);
        }
        if is_bare(&known) {
            return self.surface(text, &known, &items);
        }
        let (mut reading, read) = self.contact(&text, &items);
        // "hair band": two words with a name name something.
        if !reading.contact && items.len() == 2 && has(Class::Name) {
            reading.contact = true;
            reading.says = self.knows_all(&text.tokens);
        }
        // "the untidy welds on a farm gate": what no name says, all of its words say.
        let asks = |item: &Item| item.class == Class::Act || read::is_person(&item.text);
        let unnamed = reading.names.is_empty() && items.len() > read::FEW;
        let described = !read::is_clause(&items)
            && ((unnamed && !items.iter().any(asks)) || description::is_whole(&items));
        if reading.contact && items.len() <= MOST_DESCRIBED && described {
            reading.words = read::whole(&items);
        }
        let unread = text.tokens.iter().skip(read);
        text.cut += unread.filter(|token| token.word().is_some()).count();
        text.finished(reading, &items)
    }

    /// Reads a text that names a surface and nothing else.
    #[must_use]
    pub fn read_surface(&self, text: &str) -> Reading {
        let text = Text::new(text, &self.table);
        let items = text.items(&self.table);
        self.surface(text, &items, &items)
    }

    /// Reads the surface that the `known` items of a text name.
    fn surface(&self, text: Text<'_>, known: &[Item], items: &[Item]) -> Reading {
        let clauses = known.split(|item| item.class == Class::Break);
        let items_of = clauses.map(<[Item]>::to_vec);
        let groups = items_of.map(|items| Group::new(items, 1.0));
        let (words, names) = self.named(&text, &phrase_of(groups.collect()));
        let reading = Reading {
            contact: !words.is_empty(),
            sure: 1.0,
            says: !names.is_empty() || (!words.is_empty() && self.knows_all(&text.tokens)),
            names,
            words,
            ..Reading::default()
        };
        text.finished(reading, items)
    }
}

impl<T: WordVectors, S> Reader<T, S> {
    /// Words of a phrase, and the names among them: together they may be another one, as in "copper, polished".
    fn named(&self, text: &Text<'_>, phrase: &[String]) -> (Vec<String>, Vec<String>) {
        let items = text.segment(&normalise(&phrase.join(" ")), &self.table);
        let names = items.iter().filter(|item| item.class == Class::Name);
        let names = names.map(|item| item.text.clone()).collect();
        (items.into_iter().map(|item| item.text).collect(), names)
    }

    /// Returns true if an item is on a list, or is English and not a code.
    fn knows(&self, item: &Item) -> bool {
        let has = |kind: fn(&u8) -> bool| item.text.bytes().any(|byte| kind(&byte));
        let code = has(u8::is_ascii_digit) && has(u8::is_ascii_alphabetic);
        item.class != Class::Other || (!code && spelling::is_known(&item.text, &self.table))
    }

    /// Returns true if every word is English.
    fn knows_all(&self, tokens: &[Token]) -> bool {
        tokens.iter().filter_map(Token::word).all(|word| {
            // Of other letters, only those of micrometres are English.
            let foreign = |c: char| c.is_alphabetic() && !c.is_ascii() && c != 'μ';
            !without_accents(word).contains(foreign) && spelling::is_known(word, &self.table)
        })
    }
}

/// A text before it is read.
struct Text<'a> {
    prompt: Cow<'a, str>,
    tokens: Vec<Token>,
    /// Words that were removed from the prompt.
    gone: Vec<String>,
    numbers: Vec<Note>,
    correction: Option<Correction>,
    context: Option<grade::Context>,
    cut: usize,
}

impl<'a> Text<'a> {
    fn new(prompt: &'a str, table: &impl WordVectors) -> Self {
        let (prompt, mut gone) = graphics::described(prompt);
        let mut tokens = normalise(&prompt);
        let beyond = tokens.iter().skip(MOST_WORDS);
        let cut = beyond.filter(|token| token.word().is_some()).count();
        tokens.truncate(MOST_WORDS);
        graphics::divide(&mut tokens, &mut gone, |word| {
            spelling::is_known(word, table)
        });
        let numbers = grade::notes(&mut tokens);
        gone.extend(numbers.iter().filter_map(Note::unread));
        let correction = spelling::correct(&mut tokens, table);
        Self {
            context: grade::may_be_in(&tokens).then(|| grade::Context::of(&tokens)),
            prompt,
            tokens,
            gone,
            numbers,
            correction,
            cut,
        }
    }

    fn items(&self, table: &impl WordVectors) -> Vec<Item> {
        self.segment(&self.tokens, table)
    }

    /// Words of the text as items.
    fn segment(&self, tokens: &[Token], table: &impl WordVectors) -> Vec<Item> {
        segment::segment(tokens, self.context, |word| word_sense::sense(table, word))
    }

    /// A reading with all that is to be said of the text.
    fn finished(self, mut reading: Reading, items: &[Item]) -> Reading {
        if reading.words.is_empty() {
            reading.words = read::unread(items);
        }
        if reading.words.is_empty() {
            // Signs alone: there is nothing to divide.
            reading.words.push(shown(&self.prompt).trim().to_owned());
        }
        let phrase = phrase::parse(&reading.words);
        Reading {
            ignored: [read::left_out(items, &reading), self.gone].concat(),
            conflict: conflict(&phrase, &reading.words),
            phrase,
            correction: self.correction,
            numbers: self.numbers.iter().map(Note::to_string).collect(),
            cut: self.cut,
            ..reading
        }
    }
}

/// The last number of one thing, and one before it that says otherwise.
fn conflict(phrase: &Phrase, words: &[String]) -> Option<[Grade; 2]> {
    if !matches!(phrase, Phrase::Graded { .. } | Phrase::Changed { .. }) {
        return None;
    }
    let grades: Vec<Grade> = words.iter().filter_map(|word| Grade::of(word)).collect();
    let pair = |(n, last): (usize, &Grade)| {
        let first = grades[..n].iter().find(|first| first.conflicts(*last))?;
        Some([*first, *last])
    };
    grades.iter().enumerate().rev().find_map(pair)
}

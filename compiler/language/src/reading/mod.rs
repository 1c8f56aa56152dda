//! What a prompt names, and what it says about it.
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

mod closed_class;
mod description;
mod explained;
mod graphics;
mod parts;
mod read;
mod segment;
mod spelling;
pub(crate) mod word_sense;

use read::{Group, is_bare, one_thing, phrase_of};
use segment::{Class, Item};

pub use crate::lexicon::{in_one_word, key};
pub use crate::roles::Role;
pub use crate::words::{Token, normalise, shown};
pub use closed_class::{is_colour, is_grammar};
pub use explained::Taken;
pub use spelling::Correction;

use std::borrow::Cow;

use crate::{
    WordVectors, lexicon,
    phrase::{self, Phrase},
    roles::{Flags, NAME, NAME_END, TOUCH, WordStates, flags, tag},
    words::{
        grade::{self, Grade, Note},
        singular, without_accents,
    },
};

/// What tells two readers apart: the CRC-32 of what is read of the prompts in `training/corpora/evaluation/`, and
/// of their grammar, which the test `judged::the_version_of_the_reader_follows_what_it_reads` computes.
pub const VERSION: &str = "66d655c9";

/// Words of a prompt that are read: several times what an encoder reads of them.
pub const MOST_WORDS: usize = 1024;
/// Words before a colour that are a part of it.
const SHADES: &[&str] = &["burnt", "dusty", "mossy", "rusty", "smoky"];
/// Words after which a quality is not there.
const DENIALS: &[&str] = &["lacks", "lost", "not", "without"];
/// Words of a description that is encoded as a whole.
const MOST_DESCRIBED: usize = 10;

/// Reads prompts with a table of words `T` and states of words `S`.
#[derive(Debug, Clone, Copy)]
pub struct Reader<T, S> {
    table: T,
    states: S,
}

/// What was read of a prompt.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Reading {
    /// The names that it says, as the corpus spells them.
    pub names: Vec<String>,
    /// What is encoded: names, each as one, and the words that say how something feels.
    pub words: Vec<String>,
    /// What these are together.
    pub phrase: Phrase,
    /// Whether anything is touched in it.
    pub contact: bool,
    /// Whether anything that is left names something, or says how it feels.
    pub says: bool,
    /// Words that were left out because they say nothing of touch.
    pub ignored: Vec<String>,
    /// Of these, objects that carry the surface, what is denied, and tools.
    pub others: Vec<(Role, String)>,
    /// A word that was misspelt.
    pub correction: Option<Correction>,
    /// What to tell of its numbers: those that are out of range, and those that may be read in two ways.
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

    /// Whether any word of this text is encoded.
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
        if is_bare(&items) {
            return self.surface(text, &items);
        }
        // "gravel idk", "gravel 2048x2048": beside a name, what nobody knows says nothing.
        let unknown = |item: &Item| {
            let has = |kind: fn(&u8) -> bool| item.text.bytes().any(|byte| kind(&byte));
            let code = has(u8::is_ascii_digit) && has(u8::is_ascii_alphabetic);
            item.class == Class::Other && (code || !spelling::is_known(&item.text, &self.table))
        };
        let known: Vec<Item> = items
            .iter()
            .filter(|item| !unknown(item))
            .cloned()
            .collect();
        let has = |class: Class| known.iter().any(|item| item.class == class);
        if has(Class::Name) && !has(Class::Denial) && is_bare(&known) {
            let reading = self.surface(text, &known);
            let gone = items.iter().filter(|item| unknown(item));
            let gone = gone.map(|item| item.text.clone());
            return Reading {
                ignored: reading.ignored.iter().cloned().chain(gone).collect(),
                ..reading
            };
        }
        if items.len() <= MOST_DESCRIBED && description::is_whole(&items) {
            let reading = Reading {
                words: read::whole(&items),
                contact: true,
                says: true,
                ..Reading::default()
            };
            return text.finished(reading, &items);
        }
        let (said, others, read) = self.contact(&text);
        let unread = text.tokens.iter().skip(read);
        text.cut += unread.filter(|token| token.word().is_some()).count();
        let (words, names) = if said.is_empty() {
            (read::unread(&items), Vec::new())
        } else {
            let read = self.read_surface(&said.join(" "));
            (read.words, read.names)
        };
        // Where nothing is named, a word that no one knows may say anything.
        let says = !names.is_empty() || (!said.is_empty() && self.knows_all(&text.tokens));
        let reading = Reading {
            contact: !said.is_empty(),
            words,
            names,
            says,
            others,
            ..Reading::default()
        };
        text.finished(reading, &items)
    }

    /// Reads a text that names a surface and nothing else.
    #[must_use]
    pub fn read_surface(&self, text: &str) -> Reading {
        let text = Text::new(text, &self.table);
        let items = text.items(&self.table);
        self.surface(text, &items)
    }

    fn surface(&self, text: Text<'_>, items: &[Item]) -> Reading {
        let clauses = items.split(|item| item.class == Class::Break);
        let items_of = clauses.map(<[Item]>::to_vec);
        let groups = items_of.map(|items| Group {
            items,
            surface: 1.0,
        });
        // Together they may be another name: "copper, polished".
        let words = phrase_of(groups.collect());
        let together = text.segment(&normalise(&words.join(" ")), &self.table);
        let names = together.iter().filter(|item| item.class == Class::Name);
        let names: Vec<String> = names.map(|item| item.text.clone()).collect();
        let words: Vec<String> = together.into_iter().map(|item| item.text).collect();
        let reading = Reading {
            contact: !words.is_empty(),
            says: !names.is_empty() || (!words.is_empty() && self.knows_all(&text.tokens)),
            names,
            words,
            ..Reading::default()
        };
        text.finished(reading, items)
    }

    /// What a sentence says is touched, its words of other roles, and how many tokens of it were read.
    fn contact(&self, text: &Text<'_>) -> (Vec<String>, Vec<(Role, String)>, usize) {
        let Text {
            tokens, context, ..
        } = text;
        let flags = flags(tokens, &self.table);
        let mut tagged = tag(&self.states.states(tokens), &flags);
        // A number on a scale is of the surface beside it.
        let mut at = 0;
        while at < tagged.len() {
            let graded = context.and_then(|about| grade::read(&tokens[at..], about));
            let count = graded.map_or(0, |(count, _)| count);
            let ends = at.saturating_sub(1)..(at + count + 1).min(tagged.len());
            if count > 0 && tagged[ends].iter().any(|(role, _)| *role == Role::Surface) {
                tagged[at..at + count].fill((Role::Surface, 1.0));
            }
            at += count.max(1);
        }
        names(&flags, &mut tagged);
        attributes(tokens, &flags, &mut tagged);
        // "dusty pink": a shade.
        for n in 1..tagged.len() {
            let words = [tokens[n - 1].word(), tokens[n].word()];
            if let [Some(shade), Some(colour)] = words
                && SHADES.contains(&shade)
                && is_colour(colour)
            {
                tagged[n - 1] = (Role::Context, 0.0);
            }
        }
        // "a pot which does not feel gritty"
        for n in 0..tagged.len() {
            let denies = tokens[n].word().is_some_and(|word| DENIALS.contains(&word));
            let says = |m: &usize| tokens[*m].word().is_some_and(|word| !is_grammar(word));
            if let Some(m) = (n + 1..tagged.len()).find(says).filter(|_| denies)
                && tagged[m].0 == Role::Context
            {
                tagged[m].0 = Role::Denied;
            }
        }
        let tokens: Vec<(&Token, (Role, f32))> = tokens.iter().zip(tagged).collect();
        let (mut groups, mut denied, mut others) = (Vec::new(), Vec::new(), Vec::new());
        for span in tokens.chunk_by(|a, b| a.1.0 == b.1.0) {
            let role = span[0].1.0;
            let words: Vec<Token> = span.iter().map(|(token, _)| (*token).clone()).collect();
            if role == Role::Surface {
                let surface = span.iter().map(|(_, (_, surface))| surface).sum::<f32>();
                groups.push(Group {
                    items: text.segment(&words, &self.table),
                    surface: surface / span.len() as f32,
                });
            } else if role != Role::Context {
                let said: Vec<&str> = words.iter().filter_map(Token::word).collect();
                others.push((role, said.join(" ")));
                if role == Role::Denied {
                    denied.extend(text.segment(&words, &self.table));
                }
            }
        }
        // "bark without its roughness"; but "not soft, scratchy" is scratchy.
        let is_quality = |item: &Item| item.class == Class::Touch || phrase::is_quality(&item.text);
        if !groups.iter().flat_map(|group| &group.items).any(is_quality) {
            let denied = denied.into_iter().filter(is_quality);
            groups.extend(denied.map(Group::denied));
        }
        (phrase_of(one_thing(groups)), others, tokens.len())
    }
}

impl<T: WordVectors, S> Reader<T, S> {
    /// Whether every word is English.
    fn knows_all(&self, tokens: &[Token]) -> bool {
        tokens.iter().filter_map(Token::word).all(|word| {
            // Of other letters, only those of micrometres are English.
            let foreign = |c: char| c.is_alphabetic() && !c.is_ascii() && c != 'μ';
            !without_accents(word).contains(foreign) && spelling::is_known(word, &self.table)
        })
    }
}

/// A name of several words is of the surface as a whole.
fn names(flags: &[Flags], tagged: &mut [(Role, f32)]) {
    let mut start = 0;
    for end in 1..=tagged.len() {
        if flags[end - 1][NAME] == 0.0 {
            start = end;
        } else if flags[end - 1][NAME_END] > 0.0 {
            let name = &mut tagged[start..end];
            let surface = name
                .iter()
                .map(|(_, surface)| *surface)
                .fold(0.0, libm::fmaxf);
            if name.iter().any(|(role, _)| *role == Role::Surface) {
                let context = name.iter_mut().filter(|(role, _)| *role == Role::Context);
                context.for_each(|tagged| *tagged = (Role::Surface, surface));
            }
            start = end;
        }
    }
}

/// Words that stand together are of one thing: what is between a quality and its thing parts them no more than
/// "grey" does in "wet grey slate".
fn attributes(tokens: &[Token], flags: &[Flags], tagged: &mut [(Role, f32)]) {
    let word = |n: usize| tokens[n].word().filter(|word| !is_grammar(word));
    let is_quality = |n: usize| {
        let listed = |w| phrase::is_adjective(w) || lexicon::is_quality(w) || flags[n][TOUCH] > 0.0;
        word(n).is_some_and(listed)
    };
    let is_thing = |n: usize| !is_quality(n) && word(n).is_some_and(lexicon::is_name);
    let mut start = 0;
    while start < tagged.len() {
        let count = (start..tagged.len())
            .take_while(|n| word(*n).is_some())
            .count();
        let run: Vec<usize> = (start..start + count).collect();
        let is = |n: &usize, role: Role| tagged[*n].0 == role;
        let said = |n: &&usize| is(n, Role::Surface);
        let more: Vec<usize> = match run.iter().filter(said).rfind(|n| !is_quality(**n)) {
            Some(thing) => run
                .iter()
                .copied()
                .filter(|n| n < thing && is_quality(*n))
                .collect(),
            // The thing behind its quality; "bread soaked in milk".
            None => run.iter().find(said).map_or_else(Vec::new, |first| {
                let mut things = run.iter().copied().filter(|n| is_thing(*n));
                let before = things.clone().rfind(|n| n < first);
                things.rfind(|n| n > first).or(before).into_iter().collect()
            }),
        };
        let context: Vec<usize> = more.into_iter().filter(|n| is(n, Role::Context)).collect();
        for n in context {
            tagged[n] = (Role::Surface, 0.5);
        }
        start += count.max(1);
    }
}

/// A text before it is read.
struct Text<'a> {
    prompt: Cow<'a, str>,
    tokens: Vec<Token>,
    /// What was taken out of it.
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

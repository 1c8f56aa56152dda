//! A prompt as items: names, longest first, and what every other word is.

use crate::lexicon::closed_class::{
    is_act, is_colour, is_covering, is_determiner, is_function, is_link, is_part, is_picture, meant,
};
use crate::lexicon::word_sense::Sense;
use crate::words::{
    Token,
    grade::{self, Grade},
};
use crate::{
    lexicon::{self, LONGEST},
    phrase,
};

/// Class of an item.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Class {
    /// A name.
    Name,
    /// A word that says how something feels.
    Touch,
    /// A word of degree or comparison: "very", "more".
    Degree,
    /// A denial: "not", "without".
    Denial,
    /// A word that joins: "of", "with", "that".
    Link,
    /// Another word of grammar.
    Function,
    /// A word of touching, or of the prompt itself: "texture", "stroking".
    Act,
    /// A word that names something that can be touched, and that no list holds.
    Thing,
    /// Any other word.
    Other,
    /// The end of a clause.
    Break,
}

/// A part of a prompt.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Item {
    /// The word, or the name as the corpus spells it.
    pub(super) text: String,
    /// The words as they were said.
    pub(super) said: String,
    pub(super) class: Class,
    /// Tokens that it takes.
    pub(super) tokens: usize,
}

impl Item {
    /// An item of one token.
    pub(super) fn new(text: &str, class: Class) -> Self {
        Self {
            text: text.to_owned(),
            said: text.to_owned(),
            class,
            tokens: 1,
        }
    }
}

pub(super) fn is_name(item: &Item) -> bool {
    item.class == Class::Name
}

const COMPARED: &[&str] = &["more", "less", "least", "most", "too", "half"];

/// Divides words into items. `context` is what the whole prompt says of its numbers, if it has some, and `sense` what
/// a word says that no list holds.
pub(super) fn segment(
    tokens: &[Token],
    context: Option<grade::Context>,
    sense: impl Fn(&str) -> Sense,
) -> Vec<Item> {
    let mut items = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        if let Some((count, grade)) = context.and_then(|about| grade::read(&tokens[at..], about)) {
            items.push(Item {
                tokens: count,
                ..Item::new(&grade.to_string(), Class::Touch)
            });
            at += count;
            continue;
        }
        let words: Vec<&str> = tokens[at..]
            .iter()
            .map_while(Token::word)
            .take(LONGEST)
            .collect();
        let Some(&word) = words.first() else {
            items.push(Item::new("", Class::Break));
            at += 1;
            continue;
        };
        // "extremely rough concrete" is rough concrete no more.
        let compared = items.last().is_some_and(|item: &Item| {
            matches!(item.class, Class::Degree | Class::Denial) || is_adverb(item)
        });
        // "the back of", "an oyster's inside": a part, and no name.
        let owned = items
            .last()
            .is_some_and(|item: &Item| item.text.ends_with("'s"));
        let part = is_part(word) && (owned || words.get(1).is_some_and(|next| *next == "of"));
        if words.get(1) == Some(&"coloured") {
            items.push(Item {
                tokens: 2,
                ..Item::new(&format!("{word}-coloured"), Class::Other)
            });
            at += 2;
        } else if part {
            items.push(Item::new(word, Class::Thing));
            at += 1;
        } else if let Some((count, name)) = longest(&words, compared) {
            items.push(Item {
                said: words[..count].join(" "),
                tokens: count,
                ..Item::new(name, Class::Name)
            });
            at += count;
        } else if let Some((count, meant)) = meant(&words) {
            let class = if meant == "with" {
                Class::Link
            } else {
                Class::Denial
            };
            items.push(Item {
                said: words[..count].join(" "),
                tokens: count,
                ..Item::new(meant, class)
            });
            at += count;
        } else if words.starts_with(&["at", "all"]) {
            items.push(Item {
                tokens: 2,
                ..Item::new("at all", Class::Link)
            });
            at += 2;
        } else {
            let mut class = class(word, &sense);
            // "a photo of" depicts an object; "a photo" is one.
            if is_picture(word) && words.get(1).is_none_or(|next| *next != "of") {
                class = Class::Thing;
            }
            let covering = items.last().is_some_and(|item: &Item| {
                is_covering(&item.text) || (item.class == Class::Touch && item.text.ends_with("ed"))
            });
            if covering && ["in", "by", "from"].contains(&word) {
                class = Class::Link;
            }
            // "less texture", "without its texture"
            let sized = |item: &Item| matches!(item.class, Class::Degree | Class::Denial);
            let before = items
                .iter()
                .rev()
                .find(|item: &&Item| !is_determiner(&item.text));
            if class == Class::Act && phrase::is_quality(word) && before.is_some_and(sized) {
                class = Class::Touch;
            }
            items.push(Item::new(word, class));
            at += 1;
        }
    }
    for n in 1..items.len() {
        // "nylon brush", "bristly brush": at its end a name is no verb.
        let ends = items
            .get(n + 1)
            .is_none_or(|next| next.class == Class::Break);
        let before = matches!(items[n - 1].class, Class::Name | Class::Touch);
        let noun = items[n].class == Class::Act && ends && before;
        if let Some(name) = lexicon::name(&[&items[n].text]).filter(|_| noun) {
            items[n] = Item {
                said: items[n].said.clone(),
                ..Item::new(name, Class::Name)
            };
        }
        // "awfully rough"
        if items[n].class == Class::Touch && is_adverb(&items[n - 1]) {
            items[n - 1].class = Class::Degree;
        }
    }
    if context.is_some() {
        numbered(&mut items);
    }
    items
}

/// A number beside sandpaper is its grit: "220 sandpaper", "sandpaper no. 80".
fn numbered(items: &mut Vec<Item>) {
    let paper = |item: Option<&Item>| {
        item.is_some_and(|item| item.class == Class::Name && grade::is_abrasive(&item.text))
    };
    let mut n = 0;
    while n < items.len() {
        let number = items[n].text.trim_start_matches('-').parse::<u32>().ok();
        let mut first = n;
        while first > 0
            && (items[first - 1].class == Class::Break
                || NUMBER.contains(&items[first - 1].said.as_str()))
        {
            first -= 1;
        }
        let before = first.checked_sub(1).and_then(|at| items.get(at));
        if let Some(number) = number.filter(|_| paper(items.get(n + 1)) || paper(before)) {
            let said = Grade::of(&format!("{number} grit"));
            let text = said.map(|grade| grade.to_string());
            let tokens = items[first..=n].iter().map(|item| item.tokens).sum();
            let new = text.map(|text| Item {
                tokens,
                ..Item::new(&text, Class::Touch)
            });
            n -= items.splice(first..=n, new).count() - 1;
        }
        n += 1;
    }
}

/// Words before a number.
const NUMBER: &[&str] = &["no", "nr", "number", "grade", "size"];

/// Returns true for an adverb on no list.
pub(super) fn is_adverb(item: &Item) -> bool {
    const ADJECTIVES: &[&str] = &[
        "lovely", "friendly", "lively", "ugly", "early", "likely", "homely", "cuddly", "costly",
        "daily", "weekly", "family", "only", "silly",
    ];
    let adverb = item.text.len() > 4 && item.text.ends_with("ly");
    item.class == Class::Other && adverb && !ADJECTIVES.contains(&item.text.as_str())
}

/// The longest name that words begin with, and how many it takes. A word of grammar is no name by
/// itself, and neither is a degree before a quality ("rock hard").
fn longest(words: &[&str], compared: bool) -> Option<(usize, &'static str)> {
    let first = words[0];
    if compared && phrase::is_quality(first) {
        return None;
    }
    let degree =
        phrase::is_degree(first) && words.get(1).is_some_and(|next| phrase::is_quality(next));
    lexicon::longest(words, |count, name| {
        let alone = count == 1 && (is_function(first) || is_act(first) || degree);
        // "crisp linen" has no crisps.
        let other = count == 1 && name != first && phrase::is_quality(first);
        !is_determiner(first) && !alone && !other
    })
}

fn class(word: &str, sense: impl Fn(&str) -> Sense) -> Class {
    if COMPARED.contains(&word) || phrase::is_degree(word) {
        Class::Degree
    } else if is_link(word) {
        Class::Link
    } else if is_function(word) {
        Class::Function
    } else if is_act(word) {
        Class::Act
    } else if phrase::is_quality(word) || lexicon::is_quality(word) {
        Class::Touch
    } else if is_colour(word) || word.ends_with("'s") {
        Class::Other
    } else {
        match sense(word) {
            Sense { touch: true, .. } => Class::Touch,
            Sense { thing: true, .. } => Class::Thing,
            Sense { .. } => Class::Other,
        }
    }
}

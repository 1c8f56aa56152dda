//! Which words of a text say what is touched, as one phrase.

use super::{
    Reading,
    closed_class::{is_colour, is_determiner},
    parts,
    segment::{Class, Item},
};
use crate::{
    lexicon, phrase,
    words::{grade::Grade, singular},
};

/// Words that stand together and say something of the surface.
#[derive(Debug, Clone)]
pub(super) struct Group {
    pub(super) items: Vec<Item>,
    /// How surely they do, up to 1.
    pub(super) surface: f32,
}

/// Whether the tables alone say what a text is: it has nothing but names, qualities and what joins them.
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
        Class::Function => is_determiner(&item.text) && !PERSONS.contains(&item.text.as_str()),
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
const FEW: usize = 3;
/// Words for people, who stand in sentences alone.
const PERSONS: &[&str] = &[
    "i", "you", "he", "she", "we", "they", "me", "him", "us", "them", "who",
];
/// Parts that are as their owner is, and need its name.
const OWNED: &[&str] = &[
    "back", "belly", "coat", "feather", "fur", "hair", "hide", "leaf", "mane", "muzzle", "peel",
    "pelt", "rind", "scale", "shell", "skin", "snout", "stem", "tail", "tongue",
];

impl Group {
    /// What is not there: "not slippery", "without grit".
    pub(super) fn denied(quality: Item) -> Self {
        let denial = if phrase::is_adjective(&quality.text) {
            "not"
        } else {
            "without"
        };
        let denial = Item {
            text: denial.to_owned(),
            said: denial.to_owned(),
            class: Class::Denial,
        };
        Self {
            items: vec![
                denial,
                Item {
                    class: Class::Touch,
                    ..quality
                },
            ],
            surface: 1.0,
        }
    }

    fn content(&self) -> impl Iterator<Item = &Item> {
        self.items.iter().filter(|item| is_content(item))
    }

    /// Whether it names or describes something, and does not only say how it feels.
    fn is_thing(&self) -> bool {
        self.content().any(is_thing)
    }

    /// Whether it ends in a part that needs its owner's name.
    fn is_owned(&self) -> bool {
        let mut things = self.content().filter(|item| is_thing(item));
        let one = things.next().filter(|_| things.next().is_none());
        one.is_some_and(|item| OWNED.contains(&&*singular(&item.text)))
    }
}

fn is_thing(item: &Item) -> bool {
    is_content(item) && item.class != Class::Touch && !is_adjective(item)
}

/// Whether a word says how something is, by the tables, or by its ending if no table holds it: "wet", "riven".
fn is_adjective(item: &Item) -> bool {
    const ENDINGS: &[&str] = &["ed", "en", "ish", "less", "like", "y"];
    let text = item.text.as_str();
    match item.class {
        Class::Name => phrase::is_adjective(text) || lexicon::is_quality(text),
        _ => ENDINGS.iter().any(|end| text.ends_with(end)),
    }
}

fn is_content(item: &Item) -> bool {
    match item.class {
        Class::Name | Class::Touch | Class::Thing => true,
        Class::Other => !is_colour(&item.text),
        _ => false,
    }
}

/// One phrase of groups: their qualities, and then the things.
pub(super) fn phrase_of(groups: Vec<Group>) -> Vec<String> {
    let (mut words, mut things) = (Vec::new(), Vec::new());
    for group in groups {
        let [qualities, thing] = divided(tidy(group.items));
        words.extend(qualities);
        things.extend(thing);
    }
    words.extend(parts::divide(things));
    words.into_iter().map(|item| item.text).collect()
}

/// The groups of a sentence without all things but the surest, which stands last, behind its owner if it is a part.
pub(super) fn one_thing(groups: Vec<Group>) -> Vec<Group> {
    let (mut things, mut kept): (Vec<Group>, Vec<Group>) =
        groups.into_iter().partition(Group::is_thing);
    // With a name rather than without; of equals, the last.
    let rank = |group: &Group| {
        (
            group.items.iter().any(|item| item.class == Class::Name),
            group.surface,
        )
    };
    let surest = |things: &[Group]| {
        let ranks: Vec<(bool, f32)> = things.iter().map(rank).collect();
        let order = |a: &usize, b: &usize| {
            let by_name = ranks[*a].0.cmp(&ranks[*b].0);
            by_name.then(ranks[*a].1.total_cmp(&ranks[*b].1))
        };
        (0..things.len()).max_by(order)
    };
    let Some(n) = surest(&things) else {
        return kept;
    };
    let part = things.iter().rposition(Group::is_owned);
    let thing = things.remove(part.unwrap_or(n));
    if thing.is_owned()
        && let Some(owner) = surest(&things)
    {
        kept.push(things.remove(owner));
    }
    kept.push(Group {
        items: of_material(thing.items),
        ..thing
    });
    kept
}

/// Without what carries a material with a quality: "handle greasy rubber".
fn of_material(items: Vec<Item>) -> Vec<Item> {
    let quality = |item: &Item| is_content(item) && !is_thing(item);
    let begins = |n: &usize| {
        let carried = is_thing(&items[n - 1]) && quality(&items[*n]);
        carried && items[*n..].iter().any(is_thing)
    };
    let start = (1..items.len()).rev().find(begins).unwrap_or(0);
    items[start..].to_vec()
}

/// Qualities behind what they are of, and the rest: "iron that is rusty".
fn divided(items: Vec<Item>) -> [Vec<Item>; 2] {
    let last = items.iter().rposition(is_thing);
    let Some(last) = last.filter(|last| last + 1 < items.len()) else {
        let quality = items.iter().all(|item| !is_thing(item));
        return if quality {
            [items, Vec::new()]
        } else {
            [Vec::new(), items]
        };
    };
    const JOIN: &[&str] = &["and", "but", "is", "are", "was", "that", "has", "have"];
    let (thing, behind) = items.split_at(last + 1);
    let joins = |item: &Item| JOIN.contains(&item.text.as_str());
    let says = |item: &Item| {
        matches!(item.class, Class::Degree | Class::Denial)
            || (is_content(item) && !is_thing(item))
            || item.text == "at all"
    };
    if !behind.iter().all(|item| says(item) || joins(item)) || behind[0].class == Class::Denial {
        return [Vec::new(), items];
    }
    let qualities = behind.iter().filter(|item| says(item));
    [qualities.cloned().collect(), thing.to_vec()]
}

/// A group without the words of grammar at its ends, those inside that join nothing, and what stands between a quality and
/// its thing and says nothing of touch: "tacky transparent vinyl".
fn tidy(mut items: Vec<Item>) -> Vec<Item> {
    for n in (1..items.len().max(1) - 1).rev() {
        let dull = items[n].class == Class::Other || is_colour(&items[n].text);
        let inside = items[n - 1].class == Class::Touch && items[n + 1].class == Class::Name;
        if dull && inside && !is_adjective(&items[n]) {
            items.remove(n);
        }
    }
    let says =
        |item: &Item| is_content(item) || matches!(item.class, Class::Degree | Class::Denial);
    let opens = |item: &Item| ["between", "without"].contains(&item.text.as_str());
    let closes = |item: &Item| is_content(item) || item.text == "at all";
    let Some(first) = items.iter().position(|item| says(item) || opens(item)) else {
        return Vec::new();
    };
    let last = items.iter().rposition(closes).unwrap_or(items.len() - 1);
    let joins = |item: &Item| item.class == Class::Link && !is_determiner(&item.text);
    let kept = items.into_iter().take(last + 1).skip(first);
    kept.filter(|item| says(item) || opens(item) || joins(item))
        .collect()
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

/// All words of a text but those that ask.
pub(super) fn whole(items: &[Item]) -> Vec<String> {
    let said = items
        .iter()
        .filter(|item| !item.said.is_empty() && item.class != Class::Break);
    said.map(|item| item.said.clone()).collect()
}

/// What is encoded of a text in which nothing is touched: all words of content.
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

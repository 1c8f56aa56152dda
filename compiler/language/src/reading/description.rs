//! Short descriptions of what no name says: "a manhole lid in a downpour". They are encoded as a whole, since what stands
//! behind the thing changes it.

use super::segment::{Class, Item};
use crate::lexicon::closed_class::{is_colour, is_covering, is_place};

/// Returns true if a text describes one object that no part of it names alone.
pub(super) fn is_whole(items: &[Item]) -> bool {
    has_unknown_head(items) || is_description(items)
}

/// Subjects that begin a clause about an object.
const SUBJECTS: &[&str] = &[
    "that",
    "which",
    "who",
    "i",
    "we",
    "you",
    "he",
    "she",
    "they",
    "everybody",
    "everyone",
    "people",
    "someone",
    "somebody",
];
/// Words for who asks, and for the owner of an object.
const PERSONS: &[&str] = &[
    "i", "me", "my", "you", "your", "we", "us", "our", "his", "her", "their", "please", "yours",
    "mine",
];

fn is_name(item: &Item) -> bool {
    item.class == Class::Name
}

/// Returns true if the head noun of a prompt is in no list, and names only modify it: "the welds on a farm gate", "the
/// clods thrown up by a mole". The head is the last word after an article at the beginning.
fn has_unknown_head(items: &[Item]) -> bool {
    let frame = |item: &&Item| {
        let article = ["a", "an", "the"].contains(&item.text.as_str());
        !article
            && matches!(
                item.class,
                Class::Act | Class::Function | Class::Link | Class::Degree
            )
    };
    let start = items.iter().take_while(frame).count();
    let rest = &items[start..];
    let article = rest
        .first()
        .is_some_and(|item| ["a", "an", "the"].contains(&item.text.as_str()));
    if !article && start > 0 {
        return false;
    }
    let rest = &rest[usize::from(article)..];
    let content = |item: &&Item| {
        matches!(
            item.class,
            Class::Name | Class::Touch | Class::Thing | Class::Other
        )
    };
    let count = rest.iter().take_while(content).count();
    let (phrase, after) = rest.split_at(count);
    let joins = |item: &Item| {
        let text = item.text.as_str();
        text == "of" || is_place(text) || is_covering(text)
    };
    let unknown = |item: &Item| {
        matches!(item.class, Class::Thing | Class::Other)
            && !is_colour(&item.text)
            && !item.text.ends_with("'s")
            // "drawing on", but "the lagging of"
            && (article || !item.text.ends_with("ing"))
    };
    !phrase.iter().any(is_name)
        && phrase.last().is_some_and(unknown)
        && after.first().is_some_and(joins)
        // "a friend of mine has"
        && !after.get(1).is_some_and(|item| ["mine", "yours", "ours"].contains(&item.text.as_str()))
}

/// Returns true if a prompt describes an object at length and does not mention the speaker: "an insect hotel packed
/// with cones", "a manhole lid in a downpour". The words after the name cannot be dropped one by one.
fn is_description(items: &[Item]) -> bool {
    let kept: Vec<bool> = items
        .iter()
        .map(|item| matches!(item.class, Class::Name | Class::Thing))
        .collect();
    let is = |item: &Item, words: &[&str]| words.contains(&item.text.as_str());
    let talks = |item: &Item| matches!(item.class, Class::Act | Class::Break) || is(item, PERSONS);
    if items.iter().any(talks) {
        return false;
    }
    let other = |item: &Item| item.class == Class::Other;
    if items
        .first()
        .is_some_and(|item| is(item, &["what", "when", "where", "who", "how", "why"]))
    {
        return items.iter().any(other);
    }
    let article = items
        .first()
        .is_some_and(|item| is(item, &["a", "an", "the", "no"]));
    let Some(name) = (0..items.len()).find(|&n| kept[n] && is_name(&items[n])) else {
        return false;
    };
    // "the tray of a tea trolley": both together are the thing.
    let noun = |n: usize| matches!(items[n].class, Class::Name | Class::Thing) && kept[n];
    let whole =
        |n: &usize| items[*n].text == "of" && (0..*n).any(noun) && (*n..items.len()).any(noun);
    if article && (0..items.len()).any(|n| whole(&n)) {
        return true;
    }
    let after = &items[name + 1..];
    // "in a downpour" happens to it; "in the hall" is where it is.
    let place = |n: &usize| {
        let here = |next: &Item| is(next, &["the", "this", "that"]);
        let state = is(&after[*n], &["in", "under", "on", "out", "off"])
            && !after.get(n + 1).is_some_and(here);
        let begins = is_place(&after[*n].text) || is(&after[*n], SUBJECTS);
        begins && !state
    };
    let own = (0..after.len()).take_while(|n| !place(n));
    let own: Vec<&Item> = own.map(|n| &after[n]).collect();
    let state = own
        .iter()
        .any(|item| is_place(&item.text) && item.class != Class::Link);
    let says = |item: &&Item| matches!(item.class, Class::Name | Class::Thing | Class::Touch);
    let look = |item: &&Item| is_colour(&item.text) || item.text.ends_with("'s");
    let mut own = own.iter().copied();
    if article {
        own.any(|item| other(item) || (state && says(&item)))
    } else {
        state && own.clone().any(|item| says(&item)) && !own.any(|item| look(&item))
    }
}

//! Groups of words into one phrase: qualities, the thing, and what it has.

use super::{
    parts,
    segment::{self, Class, Item},
};
use crate::{
    lexicon::{
        self,
        closed_class::{is_colour, is_covering, is_determiner},
        substance,
    },
    phrase,
    words::grade::Grade,
};

/// Words that stand together and say something of the surface.
#[derive(Debug, Clone)]
pub(super) struct Group {
    items: Vec<Item>,
    /// Confidence that they do, up to 1.
    surface: f32,
}

impl Group {
    pub(super) fn new(items: Vec<Item>, surface: f32) -> Self {
        Self {
            items: parts::owner_first(items),
            surface,
        }
    }

    /// A denied quality: "not slippery", "without grit".
    pub(super) fn denied(quality: Item) -> Self {
        let denial = if phrase::is_adjective(&quality.text) {
            "not"
        } else {
            "without"
        };
        let quality = Item {
            class: Class::Touch,
            ..quality
        };
        Self::new(vec![Item::new(denial, Class::Denial), quality], 1.0)
    }

    /// Returns true if the group says how something feels.
    pub(super) fn is_felt(&self) -> bool {
        self.items.iter().any(is_felt)
    }

    /// Its thing: what is named or described before "with", "in" and the like, which only say more of it.
    fn head(&self) -> Option<&Item> {
        let own = self.items.iter().take_while(|item| !adds(item));
        own.filter(|item| is_thing(item)).last()
    }
}

/// Returns true for a word that introduces a modifier of the preceding thing.
fn adds(item: &Item) -> bool {
    ["with", "in", "by", "from", "without"].contains(&item.text.as_str())
}

/// Returns true if an item says how something feels.
pub(super) fn is_felt(item: &Item) -> bool {
    item.class == Class::Touch || phrase::is_quality(&item.text)
}

pub(super) fn is_content(item: &Item) -> bool {
    match item.class {
        Class::Name | Class::Touch | Class::Thing => true,
        Class::Other => !is_colour(&item.text),
        _ => false,
    }
}

pub(super) fn is_thing(item: &Item) -> bool {
    is_content(item) && item.class != Class::Touch && !is_adjective(item)
}

/// Returns true for an adjective, by the tables or, for a word on no list, by its form: "wet", "riven".
pub(super) fn is_adjective(item: &Item) -> bool {
    const ENDINGS: &[&str] = &["ed", "en", "ish", "less", "like", "y"];
    let text = item.text.as_str();
    match item.class {
        Class::Name => {
            let listed = phrase::is_adjective(text) || lexicon::is_quality(text);
            listed || lexicon::is_adjectival(text)
        }
        _ => ENDINGS.iter().any(|end| text.ends_with(end)),
    }
}

/// Joins groups into a phrase: their qualities, the things, then the modifiers of the things.
pub(super) fn phrase_of(groups: Vec<Group>) -> Vec<String> {
    let named = groups.iter().any(|group| group.head().is_some());
    let groups = said_once(groups);
    let (mut words, mut things, mut more) = (Vec::new(), Vec::new(), Vec::new());
    for group in groups {
        let headless = named && group.head().is_none();
        let items = tidy(group.items);
        if headless {
            let [qualities, tail] = added(items);
            words.extend(qualities);
            more.extend(tail);
        } else {
            let [qualities, thing] = divided(items);
            words.extend(qualities);
            things.extend(thing);
        }
    }
    words.extend(parts::divide(things));
    words.extend(more);
    words.into_iter().map(|item| item.text).collect()
}

/// Groups that say something, and of those that say the same the last: "frosting, smooth frosting".
fn said_once(groups: Vec<Group>) -> Vec<Group> {
    let says = |group: &Group, text: &str| group.items.iter().any(|item| item.text == text);
    let repeated = |n: usize| {
        let mut content = groups[n].items.iter().filter(|item| is_content(item));
        content.all(|item| groups[n + 1..].iter().any(|later| says(later, &item.text)))
    };
    let kept = (0..groups.len()).filter(|n| !repeated(*n));
    kept.map(|n| groups[n].clone()).collect()
}

/// Qualities of another group's thing, and what it has: "very slippery", "with soap".
fn added(items: Vec<Item>) -> [Vec<Item>; 2] {
    let nouns = |item: &Item| !is_content(item) || phrase::is_noun(&item.text);
    if items.iter().all(nouns) && items.iter().any(is_content) && !items.iter().any(is_denial) {
        let with = items.iter().all(|item| item.text != "with");
        let with = with.then(|| Item::new("with", Class::Link));
        return [Vec::new(), with.into_iter().chain(items).collect()];
    }
    let mut start = items.iter().position(adds).unwrap_or(items.len());
    if start > 0 && is_covering(&items[start - 1].text) {
        start -= 1;
    }
    let (qualities, tail) = items.split_at(start);
    [qualities.to_vec(), tail.to_vec()]
}

fn is_denial(item: &Item) -> bool {
    item.class == Class::Denial
}

/// Groups with the qualities of a face as those of what has it: "gneiss, weathered face".
fn of_one_face(mut groups: Vec<Group>) -> Vec<Group> {
    let is_face = |head: &Item| parts::is_face(&head.text);
    if groups.iter().filter_map(Group::head).all(is_face) {
        return groups;
    }
    for group in &mut groups {
        if group.head().is_some_and(is_face)
            && let Some(last) = group.items.iter().rposition(is_thing)
        {
            group.items.remove(last);
        }
    }
    groups
}

/// Returns true if the only thing of the groups is a part that needs its owner's name.
pub(super) fn needs_owner(groups: &[Group]) -> bool {
    let mut things = groups
        .iter()
        .flat_map(|group| &group.items)
        .filter(|item| is_thing(item));
    let part = things
        .next()
        .is_some_and(|thing| parts::is_owned(&thing.text));
    part && things.next().is_none()
}

/// The groups of a sentence without all things but the surest, which stands last, behind its owner if it is a part.
pub(super) fn one_thing(groups: Vec<Group>) -> Vec<Group> {
    let (mut things, mut kept): (Vec<Group>, Vec<Group>) = of_one_face(groups)
        .into_iter()
        .partition(|group| group.head().is_some());
    // With a name rather than without, and what is a material rather than what is of one; of equals, the last.
    let rank = |group: &Group| {
        let named = group.items.iter().any(|item| item.class == Class::Name);
        let material = group
            .head()
            .is_some_and(|head| substance(&head.text).is_some());
        f32::from(u8::from(named)) * 2.0 + f32::from(u8::from(material)) * MATERIAL + group.surface
    };
    let surest = |things: &[Group]| {
        let order = |a: &usize, b: &usize| rank(&things[*a]).total_cmp(&rank(&things[*b]));
        (0..things.len()).max_by(order)
    };
    let Some(n) = surest(&things) else {
        return kept;
    };
    let is_owned = |group: &Group| group.head().is_some_and(|head| parts::is_owned(&head.text));
    let part = things.iter().rposition(is_owned);
    let thing = things.remove(part.unwrap_or(n));
    if is_owned(&thing)
        && let Some(owner) = surest(&things)
    {
        kept.push(things.remove(owner));
    }
    kept.push(thing);
    kept
}

/// Rank advantage of a material over an object made of it, as a probability.
const MATERIAL: f32 = 0.3;

/// Qualities behind what they are of, and the rest: "iron that is rusty".
fn divided(items: Vec<Item>) -> [Vec<Item>; 2] {
    let Some(last) = items.iter().rposition(is_thing) else {
        return [items, Vec::new()];
    };
    const JOIN: &[&str] = &["and", "but", "is", "are", "was", "that", "has", "have"];
    let (thing, behind) = items.split_at(last + 1);
    // "rubber of Shore A 60"
    let graded = behind.iter().any(|item| Grade::of(&item.text).is_some());
    let joins = |item: &Item| JOIN.contains(&item.text.as_str()) || (graded && item.text == "of");
    let says = |item: &Item| {
        matches!(item.class, Class::Degree | Class::Denial)
            || (is_content(item) && !is_thing(item))
            || item.text == "at all"
    };
    let qualities = behind.iter().all(|item| says(item) || joins(item));
    if !qualities || behind.first().is_none_or(is_denial) {
        return [Vec::new(), items];
    }
    let qualities = behind.iter().filter(|item| says(item));
    [qualities.cloned().collect(), thing.to_vec()]
}

/// Returns true if a word before a name says nothing of touch: "pure fleece", "tacky transparent vinyl", "strap
/// plastic".
fn is_dull(items: &[Item], n: usize) -> bool {
    let (item, next) = (&items[n], &items[n + 1]);
    if next.class != Class::Name || is_adjective(item) || item.text.ends_with("'s") {
        return false;
    }
    match item.class {
        // What carries a material.
        Class::Thing => substance(&next.text).is_some(),
        class => {
            let alone = n == 0 || items[n - 1].class == Class::Touch;
            alone && (class == Class::Other || is_colour(&item.text))
        }
    }
}

/// A group without the words of grammar at its ends, those inside that join nothing, and what says nothing of touch.
fn tidy(mut items: Vec<Item>) -> Vec<Item> {
    items.retain(|item| !segment::is_adverb(item));
    for n in (0..items.len().saturating_sub(1)).rev() {
        if is_dull(&items, n) {
            items.remove(n);
        }
    }
    let says =
        |item: &Item| is_content(item) || matches!(item.class, Class::Degree | Class::Denial);
    let opens = |item: &Item| ["between", "with", "without"].contains(&item.text.as_str());
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

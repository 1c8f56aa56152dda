//! Parts of things: the handle of a toothbrush is a handle, and the ends of a rope are rope.

use super::segment::{Class, Item, is_name};
use crate::lexicon::closed_class::is_determiner;
use crate::words::singular;
use crate::{
    lexicon::{self, is_own_part, substance},
    phrase::is_quality,
};

/// Parts that are as the whole is.
const WHOLE: &[&str] = &[
    "back", "body", "end", "face", "finish", "head", "layer", "length", "lump", "middle", "piece",
    "point", "rim", "roll", "sheet", "side", "slab", "square", "strip", "surface", "tip", "top",
];

/// Parts that are where the whole is touched.
const FACES: &[&str] = &["back", "face", "finish", "rim", "side", "surface", "top"];

/// Parts that are as their owner is, and need its name.
const OWNED: &[&str] = &[
    "back", "belly", "coat", "feather", "fur", "hair", "hide", "leaf", "mane", "muzzle", "peel",
    "pelt", "rind", "scale", "shell", "skin", "snout", "stem", "tail", "tongue",
];

/// Returns true for a part that needs its owner's name.
pub(super) fn is_owned(word: &str) -> bool {
    is(OWNED, &singular(word))
}

/// Returns true for a part at which the whole is touched.
pub(super) fn is_face(word: &str) -> bool {
    is(FACES, &singular(word))
}

/// Items with the owner before a part that needs its name: "skin of a toad".
pub(super) fn owner_first(mut items: Vec<Item>) -> Vec<Item> {
    for n in 0..items.len() {
        if items.get(n).is_some_and(|item| is_owned(&item.text))
            && let Some(owner) = owner(&items, n, &["of", "from", "on"])
        {
            let part = items.remove(n);
            let mut own = items
                .splice(n..owner.end - 1, [])
                .skip(1)
                .collect::<Vec<_>>();
            own.retain(|item| !is_determiner(&item.text));
            own.push(part);
            items.splice(n..n, own);
        }
    }
    items
}

/// Items without what a part belongs to, or without the part.
pub(super) fn divide(mut items: Vec<Item>) -> Vec<Item> {
    let mut n = 0;
    while n < items.len() {
        let part = singular(&items[n].text);
        if is_own_part(&part) {
            own(&mut items, n);
        } else if is(WHOLE, &part) {
            whole(&mut items, n);
        }
        n += 1;
    }
    items
}

/// Returns true for a part, whether one of its own or one that feels as the whole does.
pub(super) fn is_part(word: &str) -> bool {
    let part = singular(word);
    is_own_part(&part) || is(WHOLE, &part)
}

fn is(parts: &[&str], part: &str) -> bool {
    parts.contains(&part)
}

/// The owner after "of" and the like, with its articles: from..to, the last of them its name.
fn owner(items: &[Item], n: usize, links: &[&str]) -> Option<std::ops::Range<usize>> {
    items
        .get(n + 1)
        .filter(|item| links.contains(&item.text.as_str()))?;
    let before = |item: &&Item| is_determiner(&item.text) || item.class == Class::Touch;
    let skipped = items[n + 2..].iter().take_while(before).count();
    let name = n + 2 + skipped;
    items.get(name).filter(|item| is_name(item))?;
    Some(n + 2..name + 1)
}

/// "the handle of a toothbrush", "toothbrush handle".
fn own(items: &mut Vec<Item>, n: usize) {
    let thing =
        |item: &Item| is_name(item) && substance(&item.text).is_none() && !is_quality(&item.text);
    let owned = |item: &Item| item.text.ends_with("'s");
    let at = if let Some(owner) = owner(items, n, &["of"]) {
        let last = owner.end - 1;
        if !thing(&items[last]) {
            return;
        }
        // Of "a wooden spoon", the handle is wooden.
        match items[last].said.split(' ').next().and_then(substance) {
            Some(of) => {
                items.splice(owner, [Item::new(of, Class::Name)]);
                n
            }
            None => {
                let mut kept: Vec<Item> = items.drain(n + 1..owner.end).collect();
                kept.retain(|item| item.class == Class::Touch);
                let qualities = kept.len();
                items.splice(n..n, kept);
                n + qualities
            }
        }
    } else if n > 0 && (thing(&items[n - 1]) || owned(&items[n - 1])) {
        items.remove(n - 1);
        n - 1
    } else {
        return;
    };
    items[at].class = Class::Name;
}

/// "the ends of a rope", "rope end", "a rope's end".
fn whole(items: &mut Vec<Item>, n: usize) {
    // "the cutting edge of a guillotine" is no guillotine.
    let content = |item: &Item| {
        !matches!(
            item.class,
            Class::Function | Class::Act | Class::Link | Class::Break
        )
    };
    let plain = !n
        .checked_sub(1)
        .is_some_and(|before| content(&items[before]));
    if plain && owner(items, n, &["of"]).is_some() {
        items.splice(n..n + 2, []);
    } else if n > 0
        && is_name(&items[n - 1])
        && items.get(n + 1).is_none_or(|next| next.text != "of")
    {
        items.remove(n);
    } else {
        let before = n.checked_sub(1).map(|at| items[at].text.as_str());
        let owner = before.and_then(|text| text.strip_suffix("'s"));
        if let Some(name) = owner.and_then(|name| lexicon::name(&[name])) {
            items.splice(n - 1..=n, [Item::new(name, Class::Name)]);
        }
    }
}

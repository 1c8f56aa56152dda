//! Parts of things: the handle of a toothbrush is a handle, and the ends of a rope are rope.

use super::{
    closed_class::is_determiner,
    segment::{Class, Item, is_name},
};
use crate::words::singular;
use crate::{
    lexicon::{self, is_own_part, substance},
    phrase::is_quality,
};

/// Parts that are as the whole is.
const WHOLE: &[&str] = &[
    "body", "end", "head", "middle", "piece", "point", "side", "surface", "tip", "top",
];

/// Items without what a part belongs to, or without the part; the words that went are added to those that are `gone`.
pub(super) fn divide(mut items: Vec<Item>, gone: &mut Vec<String>) -> Vec<Item> {
    let mut n = 0;
    while n < items.len() {
        let part = singular(&items[n].text);
        if is_own_part(&part) {
            own(&mut items, n, gone);
        } else if is(WHOLE, &part) {
            whole(&mut items, n, gone);
        }
        n += 1;
    }
    items
}

fn is(parts: &[&str], part: &str) -> bool {
    parts.contains(&part)
}

/// The owner after "of", with its articles: from..to, the last of them its name.
fn owner(items: &[Item], n: usize) -> Option<std::ops::Range<usize>> {
    items.get(n + 1).filter(|item| item.text == "of")?;
    let before = |item: &&Item| is_determiner(&item.text) || item.class == Class::Touch;
    let skipped = items[n + 2..].iter().take_while(before).count();
    let name = n + 2 + skipped;
    items.get(name).filter(|item| is_name(item))?;
    Some(n + 2..name + 1)
}

/// "the handle of a toothbrush", "toothbrush handle".
fn own(items: &mut Vec<Item>, n: usize, gone: &mut Vec<String>) {
    let thing =
        |item: &Item| is_name(item) && substance(&item.text).is_none() && !is_quality(&item.text);
    let owned = |item: &Item| item.text.ends_with("'s");
    let at = if let Some(owner) = owner(items, n) {
        let last = owner.end - 1;
        if !thing(&items[last]) {
            return;
        }
        gone.push(items[last].said.clone());
        // Of "a wooden spoon", the handle is wooden.
        match items[last].said.split(' ').next().and_then(substance) {
            Some(of) => {
                items.splice(owner, [named(of)]);
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
        gone.push(items.remove(n - 1).said);
        n - 1
    } else {
        return;
    };
    items[at].class = Class::Name;
}

/// "the ends of a rope", "rope end", "a rope's end".
fn whole(items: &mut Vec<Item>, n: usize, gone: &mut Vec<String>) {
    let said = items[n].said.clone();
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
    if plain && owner(items, n).is_some() {
        items.splice(n..n + 2, []);
    } else if n > 0
        && is_name(&items[n - 1])
        && items.get(n + 1).is_none_or(|next| next.text != "of")
    {
        items.remove(n);
    } else if let Some(name) = n
        .checked_sub(1)
        .and_then(|at| items[at].text.strip_suffix("'s"))
    {
        let Some(name) = lexicon::name(&[name]) else {
            return;
        };
        items.splice(n - 1..=n, [named(name)]);
    } else {
        return;
    }
    gone.push(said);
}

fn named(name: &str) -> Item {
    Item {
        text: name.to_owned(),
        said: name.to_owned(),
        class: Class::Name,
    }
}

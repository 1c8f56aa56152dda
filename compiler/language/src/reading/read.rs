//! Which items of a prompt say something of a surface.

use super::{
    Reading,
    closed_class::{ACROSS, PLACES, TOOLS, is_act, is_colour, is_determiner},
    description::{SUBJECTS, has_unknown_head, is_description},
    segment::{Class, Item, is_name},
};
use crate::{lexicon, phrase, words::grade::Grade};

/// What follows one of these happened to an object: "a chin after the barber".
const EVENTS: &[&str] = &["after", "before", "until"];

/// Reads items; what is no prose is left as it is.
pub(super) fn read(items: &[Item], prose: bool) -> Reading {
    if !prose || !items.iter().any(is_name) || has_unknown_head(items) {
        return unnamed(items);
    }
    let kept = spared(items);
    if is_description(items, &kept) {
        unnamed(items)
    } else {
        named(items, kept)
    }
}

/// What a prompt that names something says of it.
fn named(items: &[Item], mut kept: Vec<bool>) -> Reading {
    degrees(items, &mut kept);
    links(items, &mut kept);
    let content = |n: &usize| {
        matches!(
            items[*n].class,
            Class::Name | Class::Touch | Class::Thing | Class::Other
        )
    };
    let ignored = (0..items.len()).filter(|n| !kept[*n]).filter(content);
    let ignored = ignored.map(|n| items[n].text.clone()).collect();
    let words = (0..items.len()).filter(|n| kept[*n]);
    let words: Vec<String> = words.map(|n| items[n].text.clone()).collect();
    let names = (0..items.len()).filter(|n| kept[*n] && items[*n].class == Class::Name);
    Reading {
        says: true,
        names: names.map(|n| items[n].text.clone()).collect(),
        words,
        ignored,
        ..Reading::default()
    }
}

/// Whether a word is an article or a small number.
fn is_counted(word: &str) -> bool {
    const WORDS: &[&str] = &["a", "an", "the", "two", "three", "four", "five", "six"];
    WORDS.contains(&word)
}

/// Whether a word stands where a noun does.
fn stands_as_noun(items: &[Item], n: usize) -> bool {
    let before = n.checked_sub(1).map(|before| &items[before]);
    let joined = before.is_some_and(|item| {
        is_determiner(&item.text)
            || matches!(item.class, Class::Name | Class::Touch | Class::Thing)
            || ["of", "with", "without", "and", "or", "than", "like"].contains(&item.text.as_str())
    });
    joined
        || items
            .get(n + 1)
            .is_some_and(|next| is_name(next) || next.text == "of")
}

/// Names and words of touch, without those of places, of owners, and of what touches.
fn spared(items: &[Item]) -> Vec<bool> {
    let mut kept = vec![false; items.len()];
    let word = |n: usize| items.get(n).map_or("", |item| item.text.as_str());
    // Whether a name stands before, and whether what follows is a place, or a clause about it.
    let (mut named, mut place, mut clause, mut event) = (false, false, false, false);
    for (n, item) in items.iter().enumerate() {
        let text = item.text.as_str();
        let before = n.checked_sub(1).map_or("", word);
        match item.class {
            Class::Break => (place, clause, event) = (false, false, false),
            _ if event => kept[n] = true,
            _ if named && !place && !clause && EVENTS.contains(&text) => {
                event = true;
                kept[n] = true;
                // "two days after"
                let time = |m: &usize| items[*m].class == Class::Other;
                let times: Vec<usize> = (0..n).rev().take_while(time).collect();
                times.into_iter().for_each(|m| kept[m] = true);
            }
            _ if item.class == Class::Link && ["in", "by", "from"].contains(&text) => {}
            _ if PLACES.contains(&text) || (ACROSS.contains(&text) && named) => place |= named,
            _ if text == "with" || text == "but" || text == "without" => place = false,
            _ if named && SUBJECTS.contains(&text) => clause = true,
            Class::Name => {
                let shade = is_shade(items, n) && later(items, n + 1);
                let joined = ["like", "than", "as", "with", "and", "in", "by"].contains(&before);
                let elsewhere = place || shade || (clause && !joined);
                let said = !elsewhere && !explores(items, n);
                kept[n] = said;
                named |= said;
            }
            // "pale yellow"
            Class::Touch => kept[n] = !is_colour(word(n + 1)),
            Class::Thing => {
                kept[n] = !place && !clause && !is_shade(items, n) && stands_as_noun(items, n);
            }
            _ => {}
        }
    }
    if kept
        .iter()
        .zip(items)
        .any(|(kept, item)| *kept && item.class == Class::Name)
    {
        return kept;
    }
    // Nothing but places and tools: the last of them is meant.
    for (kept, item) in kept.iter_mut().zip(items) {
        *kept |= item.class == Class::Name;
    }
    kept
}

/// Whether a name is a colour or a picture of what follows: "orange", "emerald green", "leopard
/// print", "watercolour painting of".
fn is_shade(items: &[Item], n: usize) -> bool {
    let colour = |n: usize| items.get(n).is_some_and(|item| is_colour(&item.text));
    let picture = items
        .get(n + 1)
        .is_some_and(|item| item.class == Class::Act)
        && items.get(n + 2).is_some_and(|item| item.text == "of");
    let of = items.get(n + 1).is_some_and(|item| item.text == "of");
    let depicts = items[n].text.rsplit(' ').next().is_some_and(is_act);
    colour(n) || colour(n + 1) || picture || (depicts && of)
}

/// Whether a name stands behind an item.
fn later(items: &[Item], from: usize) -> bool {
    items[from..].iter().any(|item| item.class == Class::Name)
}

/// Whether a name is what a surface is explored with: "a finger over", "with my pen".
fn explores(items: &[Item], n: usize) -> bool {
    if !TOOLS.iter().any(|tool| *tool == items[n].text) {
        return false;
    }
    let grammar = |item: &&Item| !matches!(item.class, Class::Name | Class::Touch | Class::Break);
    let after = items[n + 1..].iter().take_while(grammar);
    // "a nail on my desk" is a nail, "drawing with a nail on it" is not.
    let used = items[..n]
        .iter()
        .any(|item| item.class == Class::Act || item.text == "with");
    let across = after
        .clone()
        .any(|item| ACROSS.contains(&item.text.as_str()) && (used || item.text != "on"));
    let is = after
        .clone()
        .any(|item| ["is", "as", "was"].contains(&item.text.as_str()));
    let mut before = items[..n].iter().rev().take_while(grammar);
    let with = before.any(|item| item.text == "with");
    ((across || is) && later(items, n + 1)) || (with && items[..n].iter().any(is_name))
}

/// Degrees and denials stay where a quality, or for a denial a name, follows.
fn degrees(items: &[Item], kept: &mut [bool]) {
    for n in (0..items.len()).rev() {
        let denial = items[n].class == Class::Denial;
        if !denial && items[n].class != Class::Degree {
            continue;
        }
        const BETWEEN: &[&str] = &[
            "as", "be", "been", "being", "feel", "feels", "look", "looks", "at all",
        ];
        let between = |text: &str| is_determiner(text) || BETWEEN.contains(&text);
        let mut after = (n + 1..items.len()).filter(|&m| !between(&items[m].text));
        kept[n] = after
            .next()
            .is_some_and(|m| kept[m] && (items[m].class != Class::Name || denial));
    }
}

/// Links stay between what stays.
fn links(items: &[Item], kept: &mut [bool]) {
    let content: Vec<usize> = (0..items.len()).filter(|n| kept[*n]).collect();
    for pair in content.windows(2) {
        let gap = pair[0] + 1..pair[1];
        // A clause that ended says nothing of what follows it.
        let broken = items[gap.clone()]
            .iter()
            .any(|item| item.class == Class::Break);
        let others = items[gap.clone()]
            .iter()
            .any(|item| item.class == Class::Other);
        for n in gap {
            let text = items[n].text.as_str();
            let joins = ["but", "and"].contains(&text)
                || (["of", "with", "without"].contains(&text) && !broken);
            let article = is_counted(text) && kept[n - 1];
            let link = items[n].class == Class::Link && (joins || !(broken || others));
            kept[n] = link || article;
        }
    }
    if items.first().is_some_and(|item| item.text == "between") {
        kept[0] = true;
    }
    for n in 0..items.len() {
        let next = (n + 1..items.len()).find(|m| kept[*m]);
        if items[n].text == "between" && next.is_some_and(|m| is_name(&items[m])) {
            kept[n] = true;
        }
        if items[n].text == "at all" && n > 0 && kept[n - 1] {
            kept[n] = true;
        }
    }
}

/// What is left of a prompt that names nothing known: all but what asks.
fn unnamed(items: &[Item]) -> Reading {
    let asks = |item: &Item| {
        matches!(
            item.class,
            Class::Function | Class::Act | Class::Link | Class::Break
        )
    };
    let first = items.iter().position(|item| !asks(item));
    let last = items.iter().rposition(|item| !asks(item));
    let range = match (first, last) {
        // Where nothing asks, its article stays, as the encoder learned phrases.
        (Some(1), Some(last)) if is_determiner(&items[0].text) => 0..last + 1,
        (Some(first), Some(last)) => first..last + 1,
        _ => 0..items.len(),
    };
    let words = items[range.clone()]
        .iter()
        .filter(|item| item.class != Class::Break);
    let mut words: Vec<String> = words.map(|item| item.said.clone()).collect();
    if words.is_empty() {
        words = items.iter().map(|item| item.said.clone()).collect();
        words.retain(|word| !word.is_empty());
    }
    // Of a word of no list, the classifier cannot tell "minty" and "barking" from touch by themselves.
    let listed = |word: &str| {
        phrase::is_quality(word) || lexicon::is_quality(word) || Grade::of(word).is_some()
    };
    let says = |item: &Item| match item.class {
        Class::Name | Class::Thing => true,
        Class::Touch => listed(&item.text),
        // Its distance from what the model knows decides whether it is an object.
        Class::Other => !is_colour(&item.text),
        _ => false,
    };
    Reading {
        words,
        says: items[range].iter().any(says),
        ..Reading::default()
    }
}

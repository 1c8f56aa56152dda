//! The material that gives way and that a text is about, by name: the honey of "cold honey on a plate".

use super::{
    table::{Material, materials},
    words::is_said,
};
use asperity_language::lexicon::key;
use std::{collections::HashMap, sync::LazyLock};

/// Words after which a text is about something else.
const PLACES: [&str; 16] = [
    "on", "onto", "upon", "in", "into", "inside", "over", "under", "beneath", "behind", "from",
    "at", "by", "around", "through", "against",
];
/// Words after a name that are about its surface.
const SURFACES: [&str; 4] = ["side", "surface", "face", "layer"];
/// What a foam, a sponge or a powder may be of, and hardly gives way then.
const HARD: [&str; 16] = [
    "metal",
    "aluminium",
    "aluminum",
    "steel",
    "iron",
    "copper",
    "brass",
    "bronze",
    "nickel",
    "ceramic",
    "porcelain",
    "glass",
    "concrete",
    "plaster",
    "stone",
    "wooden",
];
/// Words that say that what flows has become solid.
const SOLID: [&str; 6] = [
    "dried",
    "drying",
    "hardened",
    "frozen",
    "cured",
    "solidified",
];
/// Words of a name at most.
const LONGEST: usize = 4;

static NAMES: LazyLock<HashMap<String, &'static Material>> = LazyLock::new(|| {
    let names = materials().flat_map(|material| {
        let names = material.names.iter().chain([&material.name]);
        names.filter_map(move |name| Some((key(name)?, material)))
    });
    names.collect()
});

/// What a text names.
pub(super) struct Named<'a> {
    /// The material.
    pub material: &'static Material,
    /// The other words of the text, in their order.
    pub others: Vec<&'a str>,
    /// True if these say nothing but how it gives way.
    pub alone: bool,
}

impl Named<'_> {
    /// False for dried glue.
    pub(super) fn gives_way(&self) -> bool {
        let flows = (self.material.law.drag).is_some_and(|drag| drag.viscous_n_s_m2 > 0.0);
        !(flows && self.others.iter().any(|word| SOLID.contains(word)))
    }
}

/// The named material; `None` where the head of the text is no name of the table.
pub(super) fn named(text: &str) -> Option<Named<'_>> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let place = words.iter().position(|word| PLACES.contains(word));
    let words = &words[..place.unwrap_or(words.len())];
    let begin = words
        .iter()
        .rposition(|word| *word == "of")
        .map_or(0, |of| of + 1);
    let end = words
        .iter()
        .position(|word| *word == "with")
        .unwrap_or(words.len());
    let mut head = words.get(begin..end)?;
    while let [before @ .., last] = head
        && (is_said(last) || SURFACES.contains(last))
    {
        head = before;
    }
    let (from, material) =
        suffixes(head).find_map(|(from, name)| Some((from, *NAMES.get(&name)?)))?;
    if head.iter().any(|word| HARD.contains(word)) {
        return None;
    }
    let name = key(&material.name).unwrap_or_default();
    let in_name = |n: usize, word: &str| {
        let own = begin + from[0] == n || (begin + from[1]..begin + head.len()).contains(&n);
        own || name.split(' ').any(|own| own == word)
    };
    let words = words.iter().enumerate();
    let others = words.filter(|(n, word)| !in_name(*n, word));
    let others: Vec<&str> = others.map(|(_, word)| *word).collect();
    Some(Named {
        material,
        alone: others.iter().all(|word| is_said(word)),
        others,
    })
}

/// The keys of the last words, the most first, each after one of the words before and by itself, with where both begin.
fn suffixes<'a>(head: &'a [&'a str]) -> impl Iterator<Item = ([usize; 2], String)> {
    (1..=head.len().min(LONGEST)).rev().flat_map(move |count| {
        let from = head.len() - count;
        let last = head[from..].join(" ");
        let before = (0..from).rev().map({
            let last = last.clone();
            move |word| ([word, from], format!("{} {last}", head[word]))
        });
        let both = before.chain([([from, from], last)]);
        both.filter_map(|(from, name)| Some((from, key(&name)?)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_head_of_a_text_is_named_and_its_other_words_are_kept() {
        for (text, name, others) in [
            ("honey", "honey", ""),
            ("cold runny honey on a hard plate", "honey", "cold runny"),
            ("thick golden syrup", "honey", "thick golden"),
            ("wet packed beach sand", "wet sand", "packed beach"),
            ("a jar of honey", "honey", "a jar of"),
            ("carpet with a deep pile", "cut-pile carpet", "with a deep"),
            ("foam not springy", "upholstery foam", "not springy"),
            ("duct tape sticky side", "sticky tape", "duct side"),
        ] {
            let found = named(text).unwrap_or_else(|| panic!("{text}"));
            let others_found = found.others.join(" ");
            assert_eq!(
                (&*found.material.name, &*others_found),
                (name, others),
                "{text}"
            );
        }
        for text in [
            "oak",
            "honey oak",
            "metal foam",
            "a honey jar",
            "sandpaper",
            "steel under water",
            "",
        ] {
            assert!(named(text).is_none(), "{text}");
        }
        assert!(named("very runny honey").unwrap().alone && !named("manuka honey").unwrap().alone);
        assert!(!named("dried honey").unwrap().gives_way());
        assert!(named("dried mown grass").unwrap().gives_way());
    }
}

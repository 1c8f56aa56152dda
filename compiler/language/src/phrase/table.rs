//! Words that change how a material feels.

use crate::lexicon::closed_class::is;
use std::{collections::HashMap, sync::LazyLock};

/// Lines `word TAB rough TAB slippery TAB hard`, each −1, 0 or 1; sorted by bytes.
type Table = LazyLock<HashMap<&'static str, Signs>>;

/// Adjectives.
static ADJECTIVES: Table = LazyLock::new(|| read(include_str!("adjectives.tsv")));
/// States of a material: participles and the like that say how it feels, unless they are part of a name, as in "boiled
/// sweet".
static STATES: Table = LazyLock::new(|| read(include_str!("states.tsv")));
/// Nouns of qualities, for "without its grit".
static NOUNS: Table = LazyLock::new(|| read(include_str!("nouns.tsv")));
/// Adjectives that are qualities in an edit alone.
static EDIT_ADJECTIVES: Table = LazyLock::new(|| read(include_str!("edit_adjectives.tsv")));
static EDIT_NOUNS: Table = LazyLock::new(|| read(include_str!("edit_nouns.tsv")));

/// Where rough, slippery and hard go.
pub(super) type Signs = [i8; 3];

/// Lines that are none are left out; a test finds every line.
fn read(table: &'static str) -> HashMap<&'static str, Signs> {
    let line = |line: &'static str| {
        let mut fields = line.split('\t');
        let word = fields.next()?;
        let mut sign = || fields.next()?.parse().ok();
        Some((word, [sign()?, sign()?, sign()?]))
    };
    table.lines().filter_map(line).collect()
}

/// Every adjective of a quality, and every state.
pub fn quality_words() -> impl Iterator<Item = &'static str> {
    ADJECTIVES.keys().chain(STATES.keys()).copied()
}

/// The signs of a quality's adjective, plain.
pub(super) fn adjective(word: &str) -> Option<Signs> {
    ADJECTIVES.get(word).copied()
}

/// The same of a state.
pub(super) fn state(word: &str) -> Option<Signs> {
    STATES.get(word).copied()
}

/// The signs of an adjective or a verb that is a quality in an edit alone: in a prompt it names a
/// material, or is better left to the text vector.
pub(super) fn edit_adjective(word: &str) -> Option<Signs> {
    EDIT_ADJECTIVES.get(word).copied()
}

/// The same of a noun.
pub(super) fn edit_noun(word: &str) -> Option<Signs> {
    EDIT_NOUNS.get(word).copied()
}

/// Returns `Some(true)` for a word before a noun that asks for more of it, `Some(false)` for less; in an edit also for
/// verbs.
pub(super) fn direction(word: &str, edit: bool) -> Option<bool> {
    const MORE: [&str; 4] = ["more", "extra", "added", "additional"];
    const LESS: [&str; 2] = ["less", "fewer"];
    if MORE.contains(&word) || (edit && is(word, &["raise"])) {
        Some(true)
    } else if LESS.contains(&word) || (edit && is(word, &["lower"])) {
        Some(false)
    } else {
        None
    }
}

/// The signs of an adjective's comparative or superlative: "rougher", "grippiest".
pub(super) fn compared(word: &str, adjective: impl Fn(&str) -> Option<Signs>) -> Option<Signs> {
    let stem = word
        .strip_suffix("er")
        .or_else(|| word.strip_suffix("est"))?;
    adjective(stem)
        .or_else(|| adjective(&format!("{stem}e")))
        .or_else(|| adjective(&format!("{}y", stem.strip_suffix('i')?)))
        .or_else(|| {
            // A doubled consonant: flat, flatter.
            let last = stem.chars().last()?;
            let single = stem.strip_suffix(last)?;
            single.ends_with(last).then(|| adjective(single)).flatten()
        })
}

/// The signs of a quality's noun: of a list, or "roughness", "scratchiness".
pub(super) fn noun(word: &str) -> Option<Signs> {
    let stem = || word.strip_suffix("ness");
    let y = || adjective(&format!("{}y", stem()?.strip_suffix('i')?));
    let own = NOUNS.get(word).copied();
    own.or_else(|| adjective(stem()?)).or_else(y)
}

/// Returns true for the noun of a quality: "grit", "roughness".
pub(crate) fn is_noun(word: &str) -> bool {
    noun(word).is_some()
}

/// Range of a degree: least and most steps.
pub(super) type Range = (f64, f64);

/// Without a word of degree.
pub(super) const PLAIN: Range = (1.0, 1.5);
/// A little.
pub(super) const LITTLE: Range = (0.4, 0.5);
/// With stress.
pub(super) const VERY: Range = (1.85, 2.6);
/// Denied with stress upon the degree: "not very".
pub(super) const NOT_VERY: Range = (-0.8, -0.6);
/// Denied.
pub(super) const NOT: Range = (-1.3, -1.0);
/// Denied with stress.
pub(super) const NOT_AT_ALL: Range = (-2.0, -1.7);

/// Words of degree, by their class. Ranges do not meet, so that one more degree is felt.
const DEGREES: [(&str, Range); 5] = [
    ("hardly", (-0.3, -0.1)),
    ("little", LITTLE),
    ("fairly", (0.65, 0.75)),
    ("very", VERY),
    ("extremely", (2.95, 3.6)),
];

/// The range of a word of degree.
pub(super) fn degree(word: &str) -> Option<Range> {
    let found = DEGREES.iter().find(|(class, _)| is(word, &[class]));
    found.map(|(_, range)| *range)
}

/// The range of a word before a quality: of degree, or any other adverb ("awfully"), which stresses.
pub(super) fn degree_before(word: &str) -> Option<Range> {
    let adverb = word.len() > 4 && word.ends_with("ly") && adjective(word).is_none();
    degree(word).or_else(|| adverb.then_some(VERY))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_sorted_whole_and_say_something() {
        let tables = [
            (include_str!("adjectives.tsv"), &ADJECTIVES),
            (include_str!("states.tsv"), &STATES),
            (include_str!("nouns.tsv"), &NOUNS),
            (include_str!("edit_adjectives.tsv"), &EDIT_ADJECTIVES),
            (include_str!("edit_nouns.tsv"), &EDIT_NOUNS),
        ];
        for (text, table) in tables {
            let words: Vec<&str> = text
                .lines()
                .filter_map(|line| line.split('\t').next())
                .collect();
            assert!(
                words.windows(2).all(|pair| pair[0] < pair[1]),
                "sorted, each once"
            );
            for word in words {
                let signs = table.get(word).expect(word);
                assert!(signs.iter().any(|sign| *sign != 0), "{word}");
                assert!(signs.iter().all(|sign| sign.abs() <= 1), "{word}");
            }
        }
    }

    #[test]
    fn comparatives_are_their_adjectives() {
        for (word, plain) in [
            ("rougher", "rough"),
            ("coarser", "coarse"),
            ("grippier", "grippy"),
            ("flattest", "flat"),
        ] {
            assert_eq!(compared(word, adjective), adjective(plain), "{word}");
            assert!(compared(word, adjective).is_some(), "{word}");
        }
        for other in ["rubber", "leather", "paper", "water", "silver"] {
            assert_eq!(compared(other, adjective), None, "{other}");
        }
    }

    #[test]
    fn degrees_do_not_meet() {
        let mut ranges: Vec<Range> = DEGREES.iter().map(|(_, range)| *range).collect();
        ranges.extend([PLAIN, NOT, NOT_AT_ALL]);
        // "Hardly" denies, but less than "not" does.
        let hardly = degree("hardly").expect("a degree");
        assert!(NOT.1 < hardly.0 && hardly.1 < 0.0);
        ranges.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert!(ranges.iter().all(|(least, most)| least <= most));
        assert!(ranges.windows(2).all(|pair| pair[0].1 < pair[1].0));
    }
}

//! The table of names for the compiler's prompt reader.

use super::{EMBEDDED, EMBEDDED_LEXICON, schema};
use asperity::sources::prompt::{
    phrase,
    reading::{Token, in_one_word, is_colour, is_grammar, key, normalise},
    woods,
};
use std::collections::{BTreeMap, BTreeSet};

/// Files of the lexicon that list things. The others list qualities, or things with qualities.
const THINGS: [&str; 14] = [
    "lexicon/substances.csv",
    "lexicon/finishes.csv",
    "lexicon/household.csv",
    "lexicon/clothing.csv",
    "lexicon/food.csv",
    "lexicon/plants.csv",
    "lexicon/animals.csv",
    "lexicon/body.csv",
    "lexicon/tools.csv",
    "lexicon/vehicles.csv",
    "lexicon/buildings.csv",
    "lexicon/nature.csv",
    "lexicon/leisure.csv",
    "lexicon/objects.csv",
];
/// Files of the lexicon whose phrases end with the thing that they speak of.
const HEADS: [&str; 2] = ["lexicon/bases.csv", "lexicon/modifiers.csv"];
/// Lines `text,name`: trade names, and words of trades and regions, for names of what feels as they do.
const TRADE_NAMES: &str = include_str!("../../../corpora/trade_names.csv");
/// Words of a name of the lexicon at most: longer ones are descriptions.
const MOST_WORDS: usize = 4;
/// Things before whose names a word stands that is a name by itself.
const OFTEN: usize = 5;
/// Words that make a phrase more than a name.
const JOINS: [&str; 24] = [
    "in", "on", "from", "with", "by", "for", "to", "at", "under", "over", "that", "which", "is",
    "the", "after", "before", "without", "not", "like", "than", "and", "or", "your", "my",
];

/// Lines `key TAB name` in the order of their keys, the name left out where it equals the key. Of
/// several names of one key, or of keys that are alike in one word, the first counts: materials, then synonyms, then the
/// lexicon, then woods, then trade names; of the lexicon that which is its own key.
///
/// # Panics
/// If the committed corpus is broken, which a test of this crate finds first.
#[must_use]
pub fn table() -> String {
    let families: Vec<_> = EMBEDDED
        .iter()
        .map(|(file, text)| schema::parse(file, text).expect("the committed corpus"))
        .collect();
    let materials = || families.iter().flat_map(|family| &family.material);
    let mut names = Names::default();
    for material in materials() {
        names.add(&material.name);
    }
    for name in materials().flat_map(|material| &material.synonyms) {
        names.add(name);
    }
    let things: Vec<String> = EMBEDDED_LEXICON
        .iter()
        .filter(|(file, _)| THINGS.contains(file) || *file == "everyday.toml")
        .flat_map(|(file, text)| things(file, text))
        .collect();
    // "blue brick" is brick.
    let known: BTreeSet<String> = names.by_key.keys().cloned().collect();
    let coloured = |name: &String| {
        let rest = name.split_once(' ').filter(|(first, _)| is_colour(first));
        rest.and_then(|(_, rest)| key(rest))
            .is_some_and(|key| known.contains(&key))
    };
    let things: Vec<String> = things.into_iter().filter(|name| !coloured(name)).collect();
    // "a piece of wood", "plain wood", "rough wood": "wood" is a name.
    let heads: Vec<String> = EMBEDDED_LEXICON
        .iter()
        .filter(|(file, _)| HEADS.contains(file))
        .flat_map(|(file, text)| heads(file, text))
        .collect();
    let is_key = |name: &&String| key(name).is_some_and(|key| key == **name);
    let keys_first = things.iter().filter(is_key).chain(&things).chain(&heads);
    keys_first.for_each(|name| names.add(name));
    for wood in woods() {
        // By itself, hardly any text says that it is of wood: "ipe".
        let whole = match wood.ends_with("wood") {
            true => wood.to_owned(),
            false => format!("{wood} wood"),
        };
        names.add_as(wood, &whole);
        names.add_as(&whole, &whole);
    }
    for (said, name) in trade_names() {
        let known = key(&name).and_then(|key| names.by_key.get(&key).cloned());
        names.add_as(&said, &known.expect("the name of a trade name"));
    }
    // "glass" and "nylon" are no plurals without their s: they stand before or behind others.
    let mut firsts: BTreeMap<&str, usize> = BTreeMap::new();
    for (first, _) in things.iter().filter_map(|name| name.split_once(' ')) {
        *firsts.entry(first).or_default() += 1;
    }
    let often = firsts.iter().filter(|(_, times)| **times >= OFTEN);
    let often = often.map(|(first, _)| *first);
    for word in often.chain(heads.iter().map(String::as_str)) {
        if let Some(name) = names.by_key.get_mut(word) {
            word.clone_into(name);
        }
    }
    let line = |(key, name): (&String, &String)| {
        if key == name {
            format!("{key}\n")
        } else {
            format!("{key}\t{name}\n")
        }
    };
    names.by_key.iter().map(line).collect()
}

/// Trade names, and the names of what feels as they do.
///
/// # Panics
/// As [`table`].
#[must_use]
pub fn trade_names() -> Vec<(String, String)> {
    let mut reader = csv::Reader::from_reader(TRADE_NAMES.as_bytes());
    let rows: Result<_, _> = reader.deserialize().collect();
    rows.expect("the committed trade names")
}

/// Names by their keys, and by their keys in one word.
#[derive(Default)]
struct Names {
    by_key: BTreeMap<String, String>,
    by_letters: BTreeMap<String, String>,
}

impl Names {
    fn add(&mut self, name: &str) {
        self.add_as(name, &name.to_lowercase());
    }

    /// Adds what is said for a name, unless it is there.
    fn add_as(&mut self, said: &str, name: &str) {
        let Some(key) = key(said) else { return };
        let letters = self.by_letters.entry(in_one_word(&key));
        let name = letters.or_insert_with(|| name.to_owned());
        self.by_key.entry(key).or_insert_with(|| name.clone());
    }
}

/// Files of the lexicon that say how things feel.
const QUALITIES: [&str; 3] = [
    "lexicon/words.csv",
    "lexicon/modifiers.csv",
    "lexicon/negations.csv",
];

/// Words of those phrases that by themselves say nothing of touch, and name nothing.
const NEITHER: [&str; 14] = [
    "all", "animal", "before", "free", "garden", "gone", "half", "kitchen", "left", "neither",
    "new", "nor", "old", "set",
];

/// Words, a line each and sorted, by which the lexicon says how something feels: all of its words of touch,
/// and the words that stand before a name.
///
/// # Panics
/// As [`table`].
#[must_use]
pub fn qualities() -> String {
    let table = table();
    let named: BTreeSet<&str> = table
        .lines()
        .filter_map(|line| line.split('\t').next())
        .collect();
    let is_named = |word: &str| key(word).is_some_and(|key| named.contains(key.as_str()));
    let mut found = BTreeSet::new();
    for (file, text) in EMBEDDED_LEXICON
        .iter()
        .filter(|(file, _)| QUALITIES.contains(file))
    {
        let entries = super::lexicon::parse([(*file, *text)]).expect("the committed lexicon");
        for entry in entries {
            let words = words(&entry.text);
            let thing = words.last().is_some_and(|word| is_named(word));
            let qualities = words.len() - usize::from(thing);
            found.extend(words.into_iter().take(qualities));
        }
    }
    found.retain(|word| {
        word.len() > 2
            && !NEITHER.contains(&word.as_str())
            && !is_grammar(word)
            && !phrase::is_degree(word)
            && !is_colour(word)
            && !is_named(word)
    });
    found.iter().map(|word| format!("{word}\n")).collect()
}

fn words(text: &str) -> Vec<String> {
    let tokens = normalise(text);
    let words = tokens.iter().filter_map(Token::word);
    words.map(str::to_owned).collect()
}

/// Names of things in a file of the lexicon.
fn things(file: &str, text: &str) -> Vec<String> {
    let entries = super::lexicon::parse([(file, text)]).expect("the committed lexicon");
    let everyday = file == "everyday.toml";
    entries
        .into_iter()
        .map(|entry| entry.text)
        .filter(|text| {
            let text = bare(text).to_lowercase();
            let words: Vec<&str> = text
                .split(|c: char| !c.is_alphanumeric() && c != '\'')
                .collect();
            let quality = |word: &&str| phrase::is_lasting(word) || phrase::is_degree(word);
            let last = words.last().is_some_and(quality);
            // In the everyday lexicon, things and things with qualities stand side by side.
            let qualified = everyday && words.iter().any(quality);
            words.len() <= MOST_WORDS
                && !words.iter().any(|word| JOINS.contains(word))
                && !last
                && !qualified
        })
        .map(|text| bare(&text).to_owned())
        .collect()
}

/// Returns the head words of the phrases in a file of the lexicon: the last word, where another precedes it.
fn heads(file: &str, text: &str) -> Vec<String> {
    let entries = super::lexicon::parse([(file, text)]).expect("the committed lexicon");
    let head = |entry: super::LexiconEntry| {
        let words = words(&entry.text);
        let count = words.len();
        let plain = (2..=4).contains(&count) && !words.iter().any(|word| word == "that");
        let head = words.into_iter().next_back()?;
        let says = NEITHER.contains(&head.as_str())
            || is_grammar(&head)
            || is_colour(&head)
            || phrase::is_quality(&head)
            || phrase::is_degree(&head);
        (plain && !says).then_some(head)
    };
    entries.into_iter().filter_map(head).collect()
}

/// A name without its article.
fn bare(name: &str) -> &str {
    let articles = ["a ", "an ", "the ", "some "];
    let found = articles
        .iter()
        .find_map(|article| name.strip_prefix(article));
    found.unwrap_or(name)
}

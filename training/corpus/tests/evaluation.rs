//! The prompts of `training/corpora/evaluation` are well formed, and no training text holds those of the pairs.

use asperity_corpus::{
    leaks::TrainingTexts,
    reference::{self, ReferenceOptions, check::words},
};
use asperity_tests::figures;
use serde::Deserialize;
use std::{
    collections::{BTreeMap, BTreeSet},
    path::{Path, PathBuf},
    sync::LazyLock,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Pairs {
    rough: Vec<[String; 2]>,
    slippery: Vec<[String; 2]>,
    hard: Vec<[String; 2]>,
}

impl Pairs {
    fn read(file: &str) -> Self {
        parse(&corpora().join(file))
    }

    fn by_attribute(&self) -> [(&str, &[[String; 2]]); 3] {
        [
            ("rough", &self.rough),
            ("slippery", &self.slippery),
            ("hard", &self.hard),
        ]
    }

    fn prompts(&self) -> impl Iterator<Item = &String> {
        let all = self.rough.iter().chain(&self.slippery).chain(&self.hard);
        all.flatten()
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Modifiers {
    modifiers: Vec<Modified>,
    between: Vec<Between>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Modified {
    noun: String,
    from: String,
    to: String,
    attribute: String,
    direction: String,
    modifier: String,
    kind: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Between {
    more: String,
    less: String,
    phrase: String,
    attribute: String,
}

/// Prompts of the trainer's probes.
#[derive(Deserialize)]
struct Probes {
    paraphrases: Vec<[String; 2]>,
    directions: Vec<Direction>,
    orders: Vec<[String; 3]>,
}

#[derive(Deserialize)]
struct Direction {
    from: String,
    to: String,
}

const ATTRIBUTES: [&str; 3] = ["rough", "slippery", "hard"];

fn corpora() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../corpora")
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn parse<T: serde::de::DeserializeOwned>(path: &Path) -> T {
    toml::from_str(&read(path)).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Lower-case words with one space between them and around them.
fn padded(text: &str) -> String {
    format!(" {} ", words(text).join(" "))
}

/// Everything that the shipped model was trained on.
static TRAINED: LazyLock<TrainingTexts> = LazyLock::new(|| {
    let options = ReferenceOptions {
        instances: 1,
        ..ReferenceOptions::default()
    };
    let (corpus, lexicon) = reference::load(&options).unwrap();
    TrainingTexts::of(&corpus, &lexicon)
});

fn share_a_pair<'a>(texts: impl Iterator<Item = &'a String>) -> usize {
    texts.filter(|text| TRAINED.share_a_pair_with(text)).count()
}

#[test]
fn there_are_enough_pairs_and_none_twice() {
    let pairs = Pairs::read("pairs.toml");
    let mut count = 0;
    for (attribute, rows) in pairs.by_attribute() {
        assert!(rows.len() >= 130, "{attribute}: {}", rows.len());
        count += rows.len();
    }
    assert!(count >= 400, "{count}");
    let mut seen = BTreeSet::new();
    for prompt in pairs.prompts() {
        assert!(seen.insert(padded(prompt)), "{prompt:?} appears twice");
    }
}

#[test]
fn no_prompt_of_a_pair_is_a_training_text_or_shares_a_phrase_with_one() {
    let pairs = Pairs::read("pairs.toml");
    let leaks = |text: &&String| TRAINED.hold(text) || TRAINED.share_a_phrase_with(text);
    let found: Vec<&String> = pairs.prompts().filter(leaks).collect();
    assert!(found.is_empty(), "{found:#?}");
}

/// Counts the evaluation texts that share something with the training, as pages state it.
#[test]
fn what_is_shared_with_training_is_stated() {
    let pairs = Pairs::read("pairs.toml");
    let modifiers: Modifiers = parse(&corpora().join("evaluation/modifiers.toml"));
    let held = |of: fn(&Modified) -> &String| {
        let texts = modifiers.modifiers.iter().map(of);
        texts.filter(|text| TRAINED.hold(text)).count().to_string()
    };
    let probes: Probes = parse(&corpora().join("probes.toml"));
    let directions = probes.directions.iter().flat_map(|d| [&d.from, &d.to]);
    let among = |texts: Vec<&String>| {
        let held = texts.iter().filter(|text| TRAINED.hold(text)).count();
        [held.to_string(), texts.len().to_string()]
    };
    let [paraphrases, paraphrases_of] = among(probes.paraphrases.iter().flatten().collect());
    let [directions, directions_of] = among(directions.collect());
    let [orders, orders_of] = among(probes.orders.iter().flatten().collect());
    figures::hold(
        "leaks",
        "-p asperity-corpus --test it what_is_shared",
        [
            ("pairs", pairs.prompts().count().to_string()),
            ("pairs_bigrams", share_a_pair(pairs.prompts()).to_string()),
            ("modifiers_from", held(|m| &m.from)),
            ("modifiers_to", held(|m| &m.to)),
            ("paraphrases", paraphrases),
            ("paraphrases_of", paraphrases_of),
            ("directions", directions),
            ("directions_of", directions_of),
            ("orders", orders),
            ("orders_of", orders_of),
        ],
    );
}
#[test]
fn modifiers_are_many_and_well_formed() {
    let file: Modifiers = parse(&corpora().join("evaluation/modifiers.toml"));
    let count = |of: fn(&Modified) -> &String| -> usize {
        file.modifiers.iter().map(of).collect::<BTreeSet<_>>().len()
    };
    assert!(file.modifiers.len() >= 180);
    assert!(count(|m| &m.noun) >= 60 && count(|m| &m.modifier) >= 40);
    assert!(count(|m| &m.kind) >= 8 && !file.between.is_empty());
    let mut seen = BTreeMap::new();
    for m in &file.modifiers {
        assert!(ATTRIBUTES.contains(&m.attribute.as_str()), "{}", m.to);
        assert!(["more", "less"].contains(&m.direction.as_str()), "{}", m.to);
        assert_ne!(padded(&m.from), padded(&m.to));
        assert_eq!(seen.insert((&m.from, &m.to), ()), None, "{}", m.to);
    }
    for b in &file.between {
        assert!(ATTRIBUTES.contains(&b.attribute.as_str()), "{}", b.phrase);
        assert!(b.phrase.contains(&b.more) && b.phrase.contains(&b.less));
    }
    for to in file.modifiers.iter().map(|m| &m.to) {
        assert!(!TRAINED.hold_verbatim(to), "{to:?} is a training text");
    }
}

#[test]
fn touchable_things_and_nonsense_are_many_lines_without_repetition() {
    for (file, least) in [("touchable.txt", 500), ("nonsense.txt", 100)] {
        let text = read(&corpora().join("evaluation").join(file));
        let lines: BTreeSet<&str> = text.lines().collect();
        assert!(lines.len() >= least, "{file}: {}", lines.len());
        assert_eq!(lines.len(), text.lines().count(), "{file} repeats a line");
        assert!(
            lines
                .iter()
                .all(|line| *line == line.trim() && !line.is_empty()),
            "{file}"
        );
    }
}

#[test]
fn no_touchable_thing_is_a_training_text() {
    let text = read(&corpora().join("evaluation/touchable.txt"));
    let found: Vec<&str> = text.lines().filter(|line| TRAINED.hold(line)).collect();
    assert!(found.is_empty(), "{found:?}");
}

//! The prompts of `training/corpora/evaluation` are well formed, and no training text holds those of the pairs.

use asperity_corpus::reference::{
    self, ReferenceOptions,
    check::words,
    schema::{self, MaterialEntry},
};
use serde::Deserialize;
use std::{
    collections::{BTreeMap, BTreeSet},
    path::{Path, PathBuf},
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

/// Files of a folder with an ending; none if there is no folder.
fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Vec::new();
    };
    entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|found| found == extension))
        .collect()
}

/// Lower-case words with one space between them and around them.
fn padded(text: &str) -> String {
    format!(" {} ", words(text).join(" "))
}

/// Every material.
fn materials() -> Vec<MaterialEntry> {
    let others = ["everyday.toml", "pairs.toml", "probes.toml"];
    files(&corpora(), "toml")
        .into_iter()
        .filter(|path| !others.iter().any(|other| path.ends_with(other)))
        .flat_map(|path| {
            let family = schema::parse(&path.display().to_string(), &read(&path));
            family.unwrap().material
        })
        .collect()
}

/// Phrases of the lexicon, names and synonyms: short enough to be part of a prompt.
fn short_texts(materials: &[MaterialEntry]) -> BTreeSet<String> {
    let options = ReferenceOptions {
        instances: 1,
        ..ReferenceOptions::default()
    };
    let (_, lexicon) = reference::load(&options).unwrap();
    let names = materials
        .iter()
        .flat_map(|m| m.synonyms.iter().chain([&m.name]));
    let phrases = lexicon.iter().map(|entry| &entry.text);
    names.chain(phrases).map(|text| padded(text)).collect()
}

/// Words that mean something, by themselves and in the order of their bytes, without plurals.
fn content(text: &str) -> Vec<String> {
    const OTHERS: [&str; 20] = [
        "a", "an", "the", "of", "some", "piece", "plain", "in", "on", "with", "and", "for", "to",
        "at", "by", "from", "is", "that", "s", "it",
    ];
    let all = words(text).into_iter().map(|word| word.to_string());
    let kept = all.filter(|word| !OTHERS.contains(&word.as_str()));
    kept.map(|word| word.trim_end_matches('s').to_owned())
        .collect()
}

fn sorted(mut words: Vec<String>) -> Vec<String> {
    words.sort();
    words
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
fn no_pair_shares_a_phrase_with_a_training_text() {
    let materials = materials();
    let captions = materials.iter().flat_map(|m| {
        let training = m.training.iter().map(|caption| &caption.text);
        training.map(|text| padded(text))
    });
    let all: BTreeSet<String> = captions.chain(short_texts(&materials)).collect();
    let equal: BTreeSet<Vec<String>> = all.iter().map(|text| sorted(content(text))).collect();
    let long: BTreeSet<&String> = all.iter().filter(|text| content(text).len() > 1).collect();
    let longest = long.iter().map(|text| text.split(' ').count());
    let longest = longest.max().expect("training texts");
    let mut faults = Vec::new();
    for prompt in Pairs::read("pairs.toml").prompts() {
        if equal.contains(&sorted(content(prompt))) {
            faults.push(format!("{prompt:?} is a training text"));
        }
        let its_words = words(prompt);
        for length in 1..=longest.min(its_words.len()) {
            for part in its_words.windows(length) {
                let part = format!(" {} ", part.join(" "));
                if long.contains(&part) {
                    faults.push(format!("{prompt:?} holds {part:?}"));
                }
            }
        }
        let whole = padded(prompt);
        if content(prompt).len() > 1
            && let Some(text) = all.iter().find(|text| text.contains(&whole))
        {
            faults.push(format!("{prompt:?} is inside {text:?}"));
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
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
    let materials = materials();
    let mut trained = short_texts(&materials);
    trained.extend(
        materials
            .iter()
            .flat_map(|m| m.training.iter().map(|caption| padded(&caption.text))),
    );
    for to in file.modifiers.iter().map(|m| &m.to) {
        assert!(!trained.contains(&padded(to)), "{to:?} is a training text");
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
    let materials = materials();
    let mut trained = short_texts(&materials);
    trained.extend(
        materials
            .iter()
            .flat_map(|m| m.training.iter().map(|caption| padded(&caption.text))),
    );
    let text = read(&corpora().join("evaluation/touchable.txt"));
    let found: Vec<&str> = text
        .lines()
        .filter(|line| {
            ["", "a ", "an ", "the "]
                .iter()
                .any(|article| trained.contains(&padded(&format!("{article}{line}"))))
        })
        .collect();
    assert!(found.is_empty(), "{found:?}");
}

//! The same thing, said differently, feels the same: every material of the corpus in rewordings that add
//! nothing about touch.

use super::PROMPTS;
use asperity::model::attributes::{self, Attributes};
use asperity_tests::{
    figures,
    size::{least, sized},
};
use rayon::prelude::*;
use serde::Deserialize;
use std::{
    collections::{BTreeMap, HashMap},
    sync::Mutex,
};

#[derive(Deserialize)]
struct RewordingKind {
    development: Vec<String>,
    held_out: Vec<String>,
}

/// Least share of each kind within [`TOLERANCES`] of the bare name.
const LEAST_SHARES: [(&str, f64); 5] = [
    ("form", 0.99),
    ("asking", 0.95),
    ("look", 0.97),
    ("chatter", 0.93),
    ("place_owner", 0.93),
];
/// Roughness in dB, and the logarithms of hardness and μ.
const TOLERANCES: [f64; 3] = [2.0, 0.15, 0.10];
/// The worst rewordings that are shown; those held out are only counted.
const SHOWN: usize = 10;

/// A reworded name, and how far its texture is from that of the bare name, in tolerances.
struct Reworded<'a> {
    kind: &'a str,
    held_out: bool,
    prompt: String,
    words: String,
    distance: f64,
}

fn kinds() -> BTreeMap<String, RewordingKind> {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../training/corpora/evaluation/rewordings.toml"
    );
    toml::from_str(&std::fs::read_to_string(file).expect(file)).expect(file)
}

fn worded(template: &str, name: &str) -> String {
    let title: Vec<String> = name.split(' ').map(capital).collect();
    template
        .replace("{UPPER}", &name.to_uppercase())
        .replace("{Title}", &title.join(" "))
        .replace("{}", name)
}

fn capital(word: &str) -> String {
    let mut letters = word.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}

/// The largest difference of two textures, in tolerances.
pub(super) fn distance(a: &Attributes, b: &Attributes) -> f64 {
    let level = |a: &Attributes| a.rough_db.expect("a level");
    let hard = |a: &Attributes| a.hard_hz.expect("taps").ln();
    let differences = [
        level(a) - level(b),
        hard(a) - hard(b),
        a.mu.ln() - b.mu.ln(),
    ];
    let tolerances = differences.iter().zip(TOLERANCES);
    tolerances.map(|(d, t)| d.abs() / t).fold(0.0, f64::max)
}

#[test]
fn a_name_in_other_words_is_the_same_texture() {
    let kinds = kinds();
    let whole = sized("held-out rewordings of names", 0, 1) == 1;
    let (materials, templates) = (
        sized("every so many materials", 25, 1),
        sized("every so many rewordings", 3, 1),
    );
    let anchors = &PROMPTS.model().description().anchors;
    let names: Vec<&str> = anchors.iter().map(|anchor| anchor.name.as_str()).collect();
    let names: Vec<&str> = names.into_iter().step_by(materials).collect();
    // What is read alike is compiled once.
    let compiled: Mutex<HashMap<Vec<String>, Attributes>> = Mutex::default();
    let felt = |prompt: &str| {
        let words = PROMPTS.read(prompt).words;
        if let Some(found) = compiled.lock().expect("no panic").get(&words) {
            return *found;
        }
        let found = attributes::of(&PROMPTS.texture(prompt).expect(prompt));
        compiled.lock().expect("no panic").insert(words, found);
        found
    };
    let bare: Vec<Attributes> = names.par_iter().map(|name| felt(name)).collect();
    let all: Vec<(&str, bool, &String)> = kinds
        .iter()
        .flat_map(|(kind, texts)| {
            let held_out = texts.held_out.iter().filter(move |_| whole);
            let development = texts.development.iter().step_by(templates);
            let development = development.map(move |text| (kind.as_str(), false, text));
            development.chain(held_out.map(move |text| (kind.as_str(), true, text)))
        })
        .collect();
    let reworded: Vec<Reworded<'_>> = names
        .par_iter()
        .zip(&bare)
        .flat_map_iter(|(name, bare)| {
            let felt = &felt;
            all.iter().map(move |&(kind, held_out, template)| {
                let prompt = worded(template, name);
                Reworded {
                    kind,
                    held_out,
                    distance: distance(&felt(&prompt), bare),
                    words: PROMPTS.read(&prompt).text(),
                    prompt,
                }
            })
        })
        .collect();
    let (mut missed, mut rows) = (Vec::new(), Vec::new());
    for (kind, least_share) in LEAST_SHARES {
        let all = || reworded.iter().filter(|r| r.kind == kind);
        let mut worst: Vec<&Reworded<'_>> = all().filter(|r| r.distance > 1.0).collect();
        let (right, count) = (all().count() - worst.len(), all().count());
        let held_out = all().filter(|r| r.held_out);
        let (held_out, wrong) = (
            held_out.count(),
            worst.iter().filter(|r| r.held_out).count(),
        );
        println!(
            "{kind}: {right} of {count}; held out: {} of {held_out}",
            held_out - wrong
        );
        rows.push([right, count, held_out - wrong, held_out]);
        if right < least(least_share, count) {
            missed.push(format!("{kind}: {right} of {count}"));
        }
        worst.retain(|r| !r.held_out);
        worst.sort_by(|a, b| b.distance.total_cmp(&a.distance));
        for r in worst.iter().take(SHOWN) {
            println!("  {:.1}: {:?} as {:?}", r.distance, r.prompt, r.words);
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
    let [form, asking, look, chatter, place] = rows[..] else {
        unreachable!("five kinds")
    };
    let all = |row: [usize; 4]| figures::tenths_of_percent(row[0], row[1]);
    let apart = |row: [usize; 4]| figures::tenths_of_percent(row[2], row[3]);
    let extremes = |right: usize, of: usize| {
        let shares = rows
            .iter()
            .map(|row| 100.0 * row[right] as f64 / row[of] as f64);
        let (least, most) = shares.fold((100.0, 0.0), |(least, most): (f64, f64), share| {
            (least.min(share), most.max(share))
        });
        [least, most].map(|share| format!("{share:.0}"))
    };
    let ([least, most], [least_apart, most_apart]) = (extremes(0, 1), extremes(2, 3));
    figures::hold_at_full(
        "rewordings",
        "-p asperity --test it rewordings",
        [
            ("form", all(form)),
            ("asking", all(asking)),
            ("look", all(look)),
            ("chatter", all(chatter)),
            ("place", all(place)),
            ("form_apart", apart(form)),
            ("asking_apart", apart(asking)),
            ("look_apart", apart(look)),
            ("chatter_apart", apart(chatter)),
            ("place_apart", apart(place)),
            ("least", least),
            ("most", most),
            ("least_apart", least_apart),
            ("most_apart", most_apart),
        ],
    );
}

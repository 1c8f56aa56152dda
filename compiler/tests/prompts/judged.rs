//! Phrases that were judged before the code that reads them was written: compounds, parts, conditions,
//! and numbers in order.

use super::PROMPTS;
use asperity::{
    model::attributes::{self, Attributes},
    sources::prompt::reading::VERSION,
};
use asperity_tests::{
    figures,
    size::{least, sized},
};
use rayon::prelude::*;
use serde::Deserialize;
use std::collections::BTreeMap;

const FOLDER: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../training/corpora/evaluation/"
);
/// Least share of phrases of which every claim holds, and of steps of series in order.
const LEAST_PHRASES: f64 = 0.9;
const LEAST_STEPS: f64 = 0.97;
/// Two that feel alike are no further apart: dB, and the logarithms of frequency and friction.
const ALIKE: [f64; 3] = [4.0, 0.3, 0.25];
/// Largest fall of the centroid of the vibration from a grit to the next finer one.
const MOST_FALL: f64 = 0.03;

fn evaluation(file: &str) -> String {
    let path = format!("{FOLDER}{file}");
    std::fs::read_to_string(&path).expect(&path)
}

fn read(prompt: &str) -> Attributes {
    attributes::of(&PROMPTS.texture(prompt).expect(prompt))
}

/// An attribute on a scale on which differences are alike, and how far apart two that feel alike may be.
fn scale(attribute: &str, a: &Attributes) -> (f64, f64) {
    let (value, alike) = match attribute {
        "rough" => (a.rough_db, ALIKE[0]),
        "hard" => (a.hard_hz.map(f64::ln), ALIKE[1]),
        "mu" => (Some(a.mu.ln()), ALIKE[2]),
        other => panic!("{other} is no attribute"),
    };
    (value.expect(attribute), alike)
}

/// `ATTRIBUTE < | > | ~ PHRASE`.
struct Claim {
    attribute: String,
    relation: String,
    other: String,
}

impl Claim {
    fn parse(text: &str) -> Self {
        let mut words = text.splitn(3, ' ');
        let mut word = || words.next().expect("ATTRIBUTE RELATION PHRASE").to_owned();
        Self {
            attribute: word(),
            relation: word(),
            other: word(),
        }
    }

    fn holds(&self, phrase: &Attributes) -> bool {
        let (here, alike) = scale(&self.attribute, phrase);
        let (there, _) = scale(&self.attribute, &read(&self.other));
        match self.relation.as_str() {
            "<" => here < there,
            ">" => here > there,
            "~" => (here - there).abs() <= alike,
            other => panic!("{other} is no relation"),
        }
    }
}

/// Kind, phrase and claims of every line.
fn lines(text: &str) -> Vec<(&str, &str, Vec<Claim>)> {
    text.lines()
        .map(|line| {
            let fields: Vec<&str> = line.split('\t').collect();
            let [kind, _, phrase, claims] = fields[..] else {
                panic!("{line}: KIND, HEAD, PHRASE, CLAIMS");
            };
            (kind, phrase, claims.split("; ").map(Claim::parse).collect())
        })
        .collect()
}

/// Counts the correct cases of each kind, and all of them.
fn kinds<'a>(judged: &[(&'a str, bool)]) -> BTreeMap<&'a str, [usize; 2]> {
    let mut kinds: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
    for (kind, right) in judged {
        let [rights, all] = kinds.entry(kind).or_default();
        *rights += usize::from(*right);
        *all += 1;
    }
    println!("{kinds:?}");
    kinds
}

#[test]
fn compounds_parts_and_conditions_feel_as_they_were_judged() {
    let text = evaluation("phrases.tsv");
    let stride = sized("every so many phrases", 8, 1);
    let lines: Vec<_> = lines(&text).into_iter().step_by(stride).collect();
    let judged: Vec<(&str, bool)> = lines
        .par_iter()
        .map(|(kind, phrase, claims)| {
            let felt = read(phrase);
            let missed = claims.iter().filter(|claim| !claim.holds(&felt));
            let missed: Vec<_> = missed
                .map(|claim| [&*claim.attribute, &*claim.relation, &*claim.other].join(" "))
                .collect();
            if !missed.is_empty() {
                let read = PROMPTS.read(phrase).text();
                println!("{phrase} as {read:?} is not {}", missed.join("; "));
            }
            (*kind, missed.is_empty())
        })
        .collect();
    let kinds = kinds(&judged);
    let right: usize = kinds.values().map(|[right, _]| right).sum();
    assert!(right >= least(LEAST_PHRASES, judged.len()), "{right}");
    let [compounds, conditions, parts] = ["compound", "condition", "part"].map(|kind| kinds[kind]);
    figures::hold_at_full(
        "phrases",
        "-p asperity --test it compounds_parts",
        [
            ("right", right.to_string()),
            ("of", judged.len().to_string()),
            ("compounds", compounds[0].to_string()),
            ("compounds_of", compounds[1].to_string()),
            ("conditions", conditions[0].to_string()),
            ("conditions_of", conditions[1].to_string()),
            ("parts", parts[0].to_string()),
            ("parts_of", parts[1].to_string()),
        ],
    );
}

#[derive(Deserialize)]
struct File {
    series: Vec<Series>,
}

#[derive(Deserialize)]
struct Series {
    kind: String,
    attribute: String,
    /// Phrases in falling order of the attribute.
    falls: Vec<String>,
}

#[test]
fn numbers_woods_and_finishes_are_in_order() {
    let file: File = toml::from_str(&evaluation("series.toml")).expect("series.toml");
    let stride = sized("every so many series", 4, 1);
    let series: Vec<&Series> = file.series.iter().step_by(stride).collect();
    let steps: Vec<(&str, bool)> = series
        .par_iter()
        .flat_map_iter(|series| {
            let felt: Vec<f64> = series
                .falls
                .iter()
                .map(|phrase| scale(&series.attribute, &read(phrase)).0)
                .collect();
            let steps = felt.windows(2).zip(series.falls.windows(2));
            let steps: Vec<_> = steps
                .map(|(felt, phrases)| {
                    let falls = felt[0] > felt[1];
                    if !falls {
                        println!("{}: {phrases:?} do not fall: {felt:.2?}", series.kind);
                    }
                    (series.kind.as_str(), falls)
                })
                .collect();
            steps
        })
        .collect();
    let right: usize = kinds(&steps).values().map(|[right, _]| right).sum();
    assert!(right >= least(LEAST_STEPS, steps.len()), "{right}");
    figures::hold_at_full(
        "series",
        "-p asperity --test it numbers_woods",
        [
            ("series", series.len().to_string()),
            ("right", right.to_string()),
            ("of", steps.len().to_string()),
        ],
    );
}

#[test]
fn every_notation_of_a_grit_is_the_same_paper_and_finer_ones_are_no_duller() {
    let centroid = |prompt: &str| read(prompt).sharp_hz.expect(prompt);
    let grits = [12, 16, 20, 24, 30, 36, 40, 50, 60, 80];
    for pair in grits.windows(2) {
        let [coarse, fine] = [pair[0], pair[1]].map(|grit| centroid(&format!("P{grit} sandpaper")));
        assert!(
            fine >= (1.0 - MOST_FALL) * coarse,
            "P{}: {coarse} to {fine} Hz",
            pair[1]
        );
    }
    for grit in [60, 150, 400, 1500] {
        let one = read(&format!("P{grit} sandpaper"));
        for other in [
            format!("{grit}-grit sandpaper"),
            format!("{grit} grit sand paper"),
            format!("sandpaper, grit {grit}"),
            format!("#{grit} sandpaper"),
            format!("Sandpaper ({grit})"),
            format!("P{grit}"),
        ] {
            assert_eq!(read(&other), one, "{other}");
        }
    }
    let both = PROMPTS.texture("P80 P400 sandpaper").unwrap();
    assert_eq!(attributes::of(&both), read("P400 sandpaper"));
}

#[test]
fn shore_d_is_shore_a_fifty_units_up() {
    for (d, a) in [
        ("Shore D 10 rubber", "Shore A 60 rubber"),
        ("rubber, 40D Shore", "Shore A 90 rubber"),
    ] {
        assert_eq!(read(d), read(a), "{d}");
    }
}

#[test]
fn the_version_of_the_reader_follows_what_it_reads() {
    let [phrases, rated] = ["phrases.tsv", "rated.tsv"].map(evaluation);
    let [things, nonsense, near, rewordings] = [
        "touchable.txt",
        "nonsense.txt",
        "near_words.txt",
        "rewordings.toml",
    ]
    .map(evaluation);
    let series: File = toml::from_str(&evaluation("series.toml")).expect("series.toml");
    let mut prompts: Vec<String> = lines(&phrases)
        .iter()
        .map(|line| line.1.to_owned())
        .collect();
    let first = |line: &str| line.split('\t').next().unwrap_or_default().to_owned();
    prompts.extend(rated.lines().map(first));
    prompts.extend(series.series.into_iter().flat_map(|series| series.falls));
    let plain = [things, nonsense, near, rewordings.replace("{}", "gravel")];
    prompts.extend(
        plain
            .iter()
            .flat_map(|text| text.lines())
            .map(str::to_owned),
    );
    let mut crc = crc32fast::Hasher::new();
    for prompt in prompts {
        let read = PROMPTS.read(&prompt);
        crc.update(format!("{:?} {:?}", read.phrase, read.ignored).as_bytes());
        crc.update(read.text().as_bytes());
    }
    let version = format!("{:08x}", crc.finalize());
    assert_eq!(
        VERSION, version,
        "set it in compiler/language/src/reading/mod.rs"
    );
}

//! Sentences of writers who have not seen the reader: what is touched in them feels like what they name.
//!
//! Work on the reader looks at `open` and `second`. `sealed` is scored once, when that work is done:
//! `ASPERITY_SEALED=1 ASPERITY_TEST_SIZE=full cargo test -p asperity --test it sentences -- --nocapture`.

use super::{PROMPTS, rewordings::distance};
use asperity::{
    learned::Certainty,
    model::attributes::{self, Attributes},
};
use asperity_tests::{
    figures,
    size::{Size, least, sized},
};
use rayon::prelude::*;
use sha2::{Digest as _, Sha256};
use std::{cmp::Ordering, collections::BTreeMap, fs, path::PathBuf};

/// Scores, and the minimum share of each in a sample; `docs/figures/sentences_*.toml` hold the whole sets exactly.
const LEAST_SHARES: [(&str, f64); 6] = [
    ("sentences that name what is touched", 0.7),
    ("denials", 0.8),
    ("sentences without a surface", 0.8),
    ("qualities in frames", 0.8),
    ("names in other orders", 0.97),
    ("touchable things", 0.97),
];
/// Qualities that names are said with in other orders.
const QUALITIES: [&str; 5] = ["rough", "wet", "polished", "very soft", "slippery"];

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../training/corpora/evaluation/sentences")
}

fn lines(set: &str, file: &str) -> Vec<String> {
    let path = folder().join(set).join(file);
    let text =
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    text.lines().map(str::to_owned).collect()
}

fn felt(prompt: &str) -> Attributes {
    attributes::of(&PROMPTS.texture(prompt).expect(prompt))
}

/// Returns true if two prompts feel the same.
fn same(prompt: &str, bare: &str) -> bool {
    distance(&felt(prompt), &felt(bare)) <= 1.0
}

/// Returns true if a prompt is rated as naming nothing that is touched.
fn none(prompt: &str) -> bool {
    PROMPTS.project(prompt).expect(prompt).certainty == Certainty::NoContact
}

/// The level of every sentence, and whether what is touched in it was compiled.
fn levels() -> Vec<(Certainty, bool)> {
    let sets = sets().iter();
    let lines: Vec<String> = sets.flat_map(|set| lines(set, "sentences.tsv")).collect();
    let level = |line: &String| {
        let mut fields = line.split('\t').skip(1);
        let (text, bare) = (fields.next().expect(line), fields.next().expect(line));
        let certainty = PROMPTS.project(text).expect(line).certainty;
        (certainty, bare != "-" && same(text, bare))
    };
    lines.par_iter().map(level).collect()
}

/// The share of pairs of a met and an unmet request of which the unmet one has the lower level; of one level, half.
fn detected(levels: &[(Certainty, bool)]) -> f64 {
    let (met, unmet): (Vec<_>, Vec<_>) = levels.iter().partition(|(_, met)| *met);
    let half = |(met, _): &(Certainty, bool)| -> f64 {
        let order = unmet.iter().map(|(level, _)| match met.cmp(level) {
            Ordering::Greater => 1.0,
            Ordering::Equal => 0.5,
            Ordering::Less => 0.0,
        });
        order.sum()
    };
    met.iter().map(half).sum::<f64>() / (met.len() * unmet.len()) as f64
}

/// Claim: requests that are not met are those of low levels.
#[test]
fn the_level_of_a_sentence_tells_whether_it_is_met() {
    if Size::asked() != Size::Full {
        println!("skipped: it takes the whole set (ASPERITY_TEST_SIZE=full)");
        return;
    }
    let levels = levels();
    let detected = detected(&levels);
    println!("unmet requests below met ones: {detected:.3}");
    let of = LEVELS.map(|level| {
        let own: Vec<bool> = levels
            .iter()
            .filter(|(found, _)| *found == level)
            .map(|(_, met)| *met)
            .collect();
        let met = own.iter().filter(|met| **met).count();
        println!("{level}: {met} of {} met", own.len());
        [met, own.len()]
    });
    assert!(detected >= LEAST_DETECTED, "{detected}");
    let mut figures = vec![("detected".to_owned(), format!("{detected:.2}"))];
    for (level, [met, all]) in LEVELS.iter().zip(of) {
        figures.push((level.to_string(), figures::percent(met, all)));
        figures.push((format!("{level}_met"), met.to_string()));
        figures.push((format!("{level}_of"), all.to_string()));
    }
    figures::hold_at_full(
        &format!("certainty_{}", name()),
        "-p asperity --test it the_level_of_a_sentence",
        figures,
    );
}

/// Claim: the shares that reports state are those of all three sets together.
#[test]
fn reports_state_the_measured_shares() {
    let files = ["certainty_seen.toml", "certainty_sealed.toml"];
    let sets =
        files.map(|file| figures::Set::read(&figures::folder().join(file)).expect("figures"));
    for level in LEVELS {
        let sum = |of: &str| -> f64 {
            let counts = sets
                .iter()
                .map(|set| &set.figures[&format!("{level}_{of}")]);
            counts
                .map(|count| count.parse::<f64>().expect("a count"))
                .sum()
        };
        let share = sum("met") / sum("of");
        assert!(
            (level.share() - share).abs() <= CALIBRATED,
            "{level}: {share}"
        );
    }
}

/// Every level, the lowest first.
const LEVELS: [Certainty; 4] = [
    Certainty::NoContact,
    Certainty::Guess,
    Certainty::Close,
    Certainty::Known,
];
/// The least probability with which an unmet request has a lower level than a met one.
const LEAST_DETECTED: f64 = 0.75;
/// The share that reports state is no further from the measured one.
const CALIBRATED: f64 = 0.03;

fn sealed() -> bool {
    std::env::var_os("ASPERITY_SEALED").is_some()
}

fn sets() -> &'static [&'static str] {
    if sealed() {
        &["sealed"]
    } else {
        &["open", "second"]
    }
}

/// The sets together, in the names of figures.
fn name() -> &'static str {
    if sealed() { "sealed" } else { "seen" }
}

/// Names in other orders, qualities and touchable things are those of `second` where a set has none.
fn list(set: &str, file: &str) -> Vec<String> {
    lines(if set == "sealed" { "second" } else { set }, file)
}

/// Scores the sets: each claim with all its prompts, and whether it holds for them.
fn scores() -> Vec<(&'static str, Vec<(String, bool)>)> {
    let mut all = sets().iter().map(|set| score(set));
    let mut scores = all.next().expect("a set");
    for more in all {
        for ((_, judged), (_, own)) in scores.iter_mut().zip(more) {
            judged.extend(own);
        }
    }
    scores
}

/// Scores a set: each claim with all its prompts, and whether it holds for them.
fn score(set: &str) -> Vec<(&'static str, Vec<(String, bool)>)> {
    let sentences: Vec<(String, String, String)> = lines(set, "sentences.tsv")
        .iter()
        .map(|line| {
            let mut fields = line.split('\t').map(str::to_owned);
            let mut field = || fields.next().expect("three fields");
            (field(), field(), field())
        })
        .step_by(sized("every so many sentences", 25, 1))
        .collect();
    let (denied, said): (Vec<_>, Vec<_>) =
        sentences.iter().partition(|(kind, ..)| kind == "denial");
    let (silent, said): (Vec<_>, Vec<_>) = said.into_iter().partition(|(.., bare)| bare == "-");
    let judged = |all: &[&(String, String, String)], holds: fn(&str, &str) -> bool| {
        let judge = |(kind, text, bare): &&(String, String, String)| {
            (format!("{kind}: {text}"), holds(text, bare))
        };
        all.par_iter().map(judge).collect::<Vec<_>>()
    };
    let some = sized("every so many frames and names", 97, 1);
    let frames = lines(set, "frames.txt");
    let pairs: Vec<(String, String)> = list(set, "qualities.tsv")
        .iter()
        .filter_map(|line| line.split_once('\t'))
        .flat_map(|(said, bare)| {
            frames
                .iter()
                .map(move |frame| (frame.replace("{}", said), bare.to_owned()))
        })
        .step_by(some)
        .collect();
    let anchors = &PROMPTS.model().description().anchors;
    let orders = list(set, "orders.txt");
    let ordered: Vec<(String, String)> = anchors
        .iter()
        .zip(QUALITIES.iter().cycle())
        .flat_map(|(anchor, quality)| {
            let name = &anchor.name;
            orders.iter().map(move |order| {
                (
                    order.replace("{q}", quality).replace("{n}", name),
                    format!("{quality} {name}"),
                )
            })
        })
        .step_by(some)
        .collect();
    let alike = |pairs: &[(String, String)]| {
        let judge = |(said, bare): &(String, String)| (said.clone(), same(said, bare));
        pairs.par_iter().map(judge).collect::<Vec<_>>()
    };
    let things: Vec<String> = list(set, "touchable.txt")
        .into_iter()
        .step_by(some)
        .collect();
    let touched = things.par_iter().map(|thing| (thing.clone(), !none(thing)));
    let scores = [
        judged(&said, same),
        judged(&denied, same),
        judged(&silent, |text, _| none(text)),
        alike(&pairs),
        alike(&ordered),
        touched.collect(),
    ];
    LEAST_SHARES
        .iter()
        .map(|(claim, _)| *claim)
        .zip(scores)
        .collect()
}

#[test]
fn a_sentence_feels_like_what_is_touched_in_it() {
    let (mut missed, mut rights) = (Vec::new(), Vec::new());
    for ((claim, judged), (_, share)) in scores().into_iter().zip(LEAST_SHARES) {
        let right = judged.iter().filter(|(_, holds)| *holds).count();
        println!("{claim}: {right} of {}", judged.len());
        rights.push([right, judged.len()]);
        let mut kinds: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
        for (text, holds) in &judged {
            if let Some((kind, _)) = text.split_once(": ").filter(|_| claim == LEAST_SHARES[0].0) {
                let (right, of) = kinds.entry(kind).or_default();
                *right += usize::from(*holds);
                *of += 1;
            }
        }
        for (kind, (right, of)) in kinds {
            println!("  {kind}: {right} of {of}");
        }
        // Of the sealed set, nothing but numbers is shown.
        if !sealed() {
            let wrong = judged.iter().filter(|(_, holds)| !holds);
            wrong
                .take(10)
                .for_each(|(text, _)| println!("  not: {text}"));
        }
        if !sealed() && right < least(share, judged.len()) {
            missed.push(format!("{claim}: {right} of {}", judged.len()));
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
    let [said, denied, silent, framed, ordered, _] = rights[..] else {
        unreachable!("six claims")
    };
    let names = ["said", "denied", "silent", "framed", "ordered"];
    let figures = names
        .into_iter()
        .zip([said, denied, silent, framed, ordered]);
    let figures = figures.flat_map(|(name, [right, of])| {
        [
            (name.to_owned(), right.to_string()),
            (format!("{name}_of"), of.to_string()),
        ]
    });
    figures::hold_at_full(
        &format!("sentences_{}", name()),
        "-p asperity --test it a_sentence_feels",
        figures,
    );
}

/// The sets are those that their writers left, but for four sentences whose build is taught.
#[test]
fn the_sets_are_as_their_writers_left_them() {
    let listed = fs::read_to_string(folder().join("SHA256SUMS")).expect("the list");
    for line in listed.lines() {
        let (hash, file) = line.split_once("  ").expect("a hash and a file");
        let bytes = fs::read(folder().join(file)).expect(file);
        let found: String = Sha256::digest(bytes)
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect();
        assert_eq!(found, hash, "{file}");
    }
    assert_eq!(listed.lines().count(), 12);
}

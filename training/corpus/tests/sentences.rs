//! The tagger of the prompt reader is taught nothing that it is tested on.

use asperity_corpus::sentences;
use asperity_language::{
    roles::Role,
    words::{Token, normalise},
};
use std::{collections::HashMap, fs, path::PathBuf};

/// Words of a held-out sentence that may stand beside each other in a written text.
const RUN: usize = 6;

fn words(text: &str) -> Vec<String> {
    let tokens = normalise(text).into_iter();
    tokens
        .filter_map(|token| token.word().map(str::to_owned))
        .collect()
}

/// Words with a slot for each run of those that are felt; none where less than two others are left.
fn construction(words: impl Iterator<Item = (String, bool)>) -> Option<String> {
    let mut all: Vec<String> = Vec::new();
    for (word, felt) in words {
        let slot = felt && all.last().is_some_and(|last| last == "_");
        if !slot {
            all.push(if felt { "_".into() } else { word });
        }
    }
    let others = all.iter().filter(|word| *word != "_").count();
    (others >= 2).then(|| all.join(" "))
}

/// Constructions and sentences of the three sets of `evaluation/sentences`.
fn held_out() -> (HashMap<String, String>, Vec<String>) {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../corpora/evaluation/sentences");
    let (mut constructions, mut all) = (HashMap::new(), Vec::new());
    for set in ["open", "second", "sealed"] {
        let read = |file: &str| fs::read_to_string(folder.join(set).join(file)).expect(file);
        for line in read("sentences.tsv").lines() {
            let mut fields = line.split('\t').skip(1);
            let (sentence, felt) = (fields.next().expect(line), fields.next().expect(line));
            let felt = words(felt);
            let pairs = words(sentence).into_iter().map(|word| {
                let is_felt = felt.contains(&word);
                (word, is_felt)
            });
            constructions.extend(construction(pairs).map(|found| (found, sentence.to_owned())));
            all.push(sentence.to_owned());
        }
        let mut frames = read("frames.txt");
        // Names are said in the other orders of the first two.
        if set != "sealed" {
            frames += &read("orders.txt");
        }
        for line in frames.lines() {
            let line = line.replace("{}", " xslot ").replace("{n}", " xslot ");
            let line = line.replace("{q}", " xslot ");
            let pairs = words(&line).into_iter().map(|word| {
                let slot = word == "xslot";
                (word, slot)
            });
            constructions.extend(construction(pairs).map(|found| (found, line.clone())));
            all.push(line.replace("xslot", ""));
        }
    }
    (constructions, all)
}

/// Claim: no sentence and no construction of a held-out set is in what the tagger is taught, and no long run of words; and
/// every mark is around whole words.
#[test]
fn no_held_out_sentence_or_construction_is_taught_and_no_mark_divides_a_word() {
    let (constructions, held_out) = held_out();
    let mut runs: HashMap<Vec<String>, &str> = HashMap::new();
    for sentence in &held_out {
        for run in words(sentence).windows(RUN + 1) {
            runs.insert(run.to_vec(), sentence);
        }
    }
    let mut taught = sentences::texts().expect("the texts");
    let frames = sentences::frames().expect("the frames");
    taught.extend(frames.into_iter().map(|frame| ("frames".into(), frame)));
    let mut leaks = Vec::new();
    for (file, line) in &taught {
        let spans = sentences::spans(line).expect(line);
        let Some(tokens) = sentences::tokens(&spans) else {
            leaks.push(format!("{file}: {line}"));
            continue;
        };
        let felt = |(token, role): &(Token, Role)| {
            let word = token.word()?.to_owned();
            Some((word, *role != Role::Context))
        };
        let construction = construction(tokens.iter().filter_map(felt));
        let text = words(&sentences::text(&spans));
        let built = construction.and_then(|found| constructions.get(&found).map(String::as_str));
        let run = || text.windows(RUN + 1).find_map(|run| runs.get(run).copied());
        if let Some(held_out) = built.or_else(run) {
            leaks.push(format!("{file}: {line}\n  is in: {held_out}"));
        }
    }
    assert!(taught.len() > 5000 && held_out.len() > 800);
    assert!(leaks.is_empty(), "take them out:\n{}", leaks.join("\n"));
}

/// Claim: a filled text has the roles of its slots, and what says nothing of touch has none.
#[test]
fn slots_are_filled_in_their_roles() {
    use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng as _};
    let words = sentences::Words::read().expect("the words");
    let spans = sentences::spans("a big {o OBJECT} of {s QUALITY} DULL {s NAME}").expect("marks");
    for seed in 0..50 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let filled = sentences::filled(&spans, &words, &mut random);
        let tokens = sentences::tokens(&filled).expect("whole words");
        let roles = |word: &str| {
            let found = tokens.iter().find(|(token, _)| token.word() == Some(word));
            found.map(|(_, role)| *role)
        };
        assert_eq!(roles("a"), Some(Role::Context));
        assert_eq!(roles("big"), Some(Role::Context), "{filled:?}");
        let surface = tokens.iter().filter(|(_, role)| *role == Role::Surface);
        assert!(surface.count() >= 2, "{filled:?}");
    }
}

#[test]
fn marks_that_are_not_closed_or_of_no_role_are_refused() {
    for line in [
        "{s gravel",
        "gravel}",
        "{x gravel}",
        "{gravel}",
        "{s a {s b}}",
    ] {
        assert_eq!(sentences::spans(line), None, "{line}");
    }
    let spans = sentences::spans("the {s iron}'s rust").expect("marks");
    assert_eq!(spans[1], (Role::Surface, "iron's".to_owned()));
}

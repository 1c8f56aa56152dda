//! Agreement of known, close and guessed prompts with a person's ratings.

use super::PROMPTS;
use asperity::{learned::Certainty, model::attributes};
use asperity_tests::{figures, size::sized};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// A person who tells two things apart rates them further apart, on scales of 0 to 100.
const APART: f64 = 20.0;

/// A phrase, how sure it is, what was rated and what came out: rough, slippery, hard.
type Rated = (String, Certainty, [f64; 3], [f64; 3]);

fn rated() -> Vec<Rated> {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../training/corpora/evaluation/rated.tsv"
    );
    let text = std::fs::read_to_string(file).expect(file);
    let stride = sized("every so many rated phrases", 6, 1);
    let lines: Vec<&str> = text.lines().step_by(stride).collect();
    let line = |line: &&str| {
        let mut fields = line.split('\t');
        let phrase = fields.next().expect(line).to_owned();
        let ratings: Vec<f64> = fields.map(|x| x.parse().expect(line)).collect();
        let a = attributes::of(&PROMPTS.texture(&phrase).expect(line));
        let felt = [a.rough_db.expect(line), -a.mu, a.hard_hz.expect(line)];
        // What is not touched is a guess as well.
        let certainty = PROMPTS.project(&phrase).expect(line).certainty;
        let certainty = certainty.max(Certainty::Guess);
        (phrase, certainty, ratings.try_into().expect(line), felt)
    };
    lines.par_iter().map(line).collect()
}

#[test]
fn what_is_known_comes_out_right_more_often_than_a_guess() {
    let rated = rated();
    let mut table: BTreeMap<Certainty, [usize; 2]> = BTreeMap::new();
    for (n, first) in rated.iter().enumerate() {
        for second in &rated[..n] {
            let of = table.entry(first.1.min(second.1)).or_default();
            for k in 0..3 {
                let [rating, felt] = [(first.2[k], second.2[k]), (first.3[k], second.3[k])]
                    .map(|(first, second)| first - second);
                if rating.abs() >= APART {
                    of[0] += usize::from((rating > 0.0) == (felt > 0.0));
                    of[1] += 1;
                }
            }
        }
    }
    for level in [Certainty::Guess, Certainty::Close, Certainty::Known] {
        let phrases = rated.iter().filter(|rated| rated.1 == level).count();
        let [right, all] = table.get(&level).copied().unwrap_or_default();
        let share = right as f64 / all.max(1) as f64;
        println!("{level}: {phrases} phrases, {right} of {all} comparisons, {share:.3}");
    }
    let share = |level| {
        table
            .get(&level)
            .map(|[right, all]| *right as f64 / *all as f64)
    };
    let [guess, close, known] = [Certainty::Guess, Certainty::Close, Certainty::Known]
        .map(|level| share(level).expect("some of each"));
    assert!(guess < close && close < known, "{guess} {close} {known}");
    let line = |level| {
        let phrases = rated.iter().filter(|rated| rated.1 == level).count();
        let [right, all] = table[&level];
        let percent = figures::tenths_of_percent(right, all);
        let all = figures::count(all as u64);
        format!("| {level} | {phrases} | {all} | {percent} % |\n")
    };
    let lines = [Certainty::Known, Certainty::Close, Certainty::Guess].map(line);
    let head = "| certainty | phrases | comparisons | in the rated order |\n|---|---:|---:|---:|\n";
    figures::hold_at_full(
        "certainty",
        "-p asperity --test it certainty",
        [("table", head.to_owned() + &lines.concat())],
    );
}

//! Effects of modifiers on a material, and prompts that are reported as guesses.

use super::PROMPTS;
use asperity::learned::Certainty;
use asperity::model::attributes::{self, Attributes};
use asperity::sources::prompt::phrase::{Phrase, parse};
use asperity_tests::{
    figures,
    size::{least, sized},
};
use rayon::prelude::*;
use serde::Deserialize;

#[derive(Deserialize)]
struct File {
    modifiers: Vec<Modified>,
    between: Vec<Between>,
}

#[derive(Deserialize)]
struct Modified {
    from: String,
    to: String,
    attribute: String,
    direction: String,
    kind: String,
}

#[derive(Deserialize)]
struct Between {
    more: String,
    less: String,
    phrase: String,
    attribute: String,
}

fn evaluation(file: &str) -> String {
    let folder = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../training/corpora/evaluation/"
    );
    std::fs::read_to_string(format!("{folder}{file}")).expect(file)
}

/// An attribute on a scale on which a person notices 1.
fn scale(attribute: &str, a: &Attributes) -> f64 {
    match attribute {
        "rough" => a.rough_db.expect("a level") / 1.6,
        "slippery" => -a.mu.ln() / 1.1_f64.ln(),
        _ => a.hard_hz.expect("taps").ln() / 1.15_f64.ln(),
    }
}

fn read(prompt: &str) -> Attributes {
    attributes::of(&PROMPTS.texture(prompt).expect(prompt))
}

#[test]
fn modifiers_move_the_right_way_and_are_noticed() {
    let file: File = toml::from_str(&evaluation("modifiers.toml")).expect("modifiers.toml");
    let stride = sized("every so many modifiers", 12, 1);
    let modifiers: Vec<&Modified> = file.modifiers.iter().step_by(stride).collect();
    let steps: Vec<(f64, &Modified)> = modifiers
        .into_par_iter()
        .map(|m| {
            let step = scale(&m.attribute, &read(&m.to)) - scale(&m.attribute, &read(&m.from));
            (if m.direction == "more" { step } else { -step }, m)
        })
        .collect();
    let count = |holds: fn(f64) -> bool| steps.iter().filter(|(step, _)| holds(*step)).count();
    let (right, noticed, all) = (count(|x| x > 0.0), count(|x| x > 1.0), steps.len());
    for (step, m) in steps.iter().filter(|(step, _)| *step <= 0.0) {
        println!(
            "{} {step:.1}: {} to {} ({})",
            m.attribute, m.from, m.to, m.kind
        );
    }
    println!("{right} of {all} the right way, {noticed} noticed");
    let plain = |m: &Modified| parse(&PROMPTS.read(&m.to).words) == Phrase::Plain;
    let mut divided = Vec::new();
    for (who, grammar) in [
        ("read by the grammar", true),
        ("left to the text vector", false),
    ] {
        let steps = steps.iter().filter(|(_, m)| plain(m) != grammar);
        let steps: Vec<f64> = steps.map(|(step, _)| *step).collect();
        let count = |least: f64| steps.iter().filter(|&&step| step > least).count();
        let (right, noticed, all) = (count(0.0), count(1.0), steps.len());
        println!("{who}: {right} of {all} the right way, {noticed} noticed");
        divided.push([right, noticed, all]);
    }
    let [by_grammar, by_text] = divided[..] else {
        unreachable!("two of them")
    };
    figures::hold_at_full(
        "modifiers",
        "-p asperity --test it modifiers",
        [
            ("right", right.to_string()),
            ("noticed", noticed.to_string()),
            ("of", all.to_string()),
            ("right_percent", figures::percent(right, all)),
            ("noticed_percent", figures::percent(noticed, all)),
            ("grammar_right", by_grammar[0].to_string()),
            ("grammar_noticed", by_grammar[1].to_string()),
            ("grammar_of", by_grammar[2].to_string()),
            ("text_right", by_text[0].to_string()),
            ("text_noticed", by_text[1].to_string()),
            ("text_of", by_text[2].to_string()),
        ],
    );
    assert!(right >= least(LEAST_RIGHT, all), "{right} of {all}");
    assert!(noticed >= least(LEAST_NOTICED, all), "{noticed} of {all}");
    for b in file.between.iter().step_by(stride) {
        let [more, less, middle] =
            [&b.more, &b.less, &b.phrase].map(|p| scale(&b.attribute, &read(p)));
        assert!(
            more >= middle && middle >= less,
            "{}: {less} {middle} {more}",
            b.phrase
        );
    }
}

/// Least share of the modifiers that move the right way.
const LEAST_RIGHT: f64 = 0.97;
/// Least share that a person notices.
const LEAST_NOTICED: f64 = 0.95;
/// Largest share of touchable things that are a guess.
const MOST_THINGS: f64 = 0.05;
/// Least share of nonsense that is a guess.
const LEAST_NONSENSE: f64 = 0.98;

#[test]
fn what_people_touch_is_familiar_and_nonsense_is_not() {
    let unfamiliar = |file: &str, stride: usize| {
        let text = evaluation(file);
        let lines: Vec<&str> = text.lines().step_by(stride).collect();
        let far = lines.par_iter().filter(|line| {
            let unfamiliar = PROMPTS.project(line).expect(line).certainty <= Certainty::Guess;
            if unfamiliar == (file == "touchable.txt") {
                println!("{file}: {line} as {:?}", PROMPTS.read(line).text());
            }
            unfamiliar
        });
        let count = far.count();
        println!("{file}: {count} of {} unfamiliar", lines.len());
        [count, lines.len()]
    };
    let things = sized("every so many things", 5, 1);
    let lines = sized("every so many lines of nonsense", 2, 1);
    let things = unfamiliar("touchable.txt", things);
    let nonsense = unfamiliar("nonsense.txt", lines);
    let share = |[count, of]: [usize; 2]| count as f64 / of as f64;
    assert!(share(things) <= MOST_THINGS);
    assert!(share(nonsense) >= LEAST_NONSENSE);
    figures::hold_at_full(
        "familiar",
        "-p asperity --test it familiar",
        [
            ("things", things[0].to_string()),
            ("things_of", things[1].to_string()),
            ("things_percent", figures::percent(things[0], things[1])),
            ("nonsense", nonsense[0].to_string()),
            ("nonsense_of", nonsense[1].to_string()),
            (
                "nonsense_percent",
                figures::percent(nonsense[0], nonsense[1]),
            ),
        ],
    );
}

#[test]
fn a_name_is_its_material() {
    let anchors = &PROMPTS.model().description().anchors;
    let stride = sized("every so many names", 10, 1);
    let asked: Vec<_> = anchors.iter().step_by(stride).collect();
    let right = asked.par_iter().filter(|anchor| {
        let z = PROMPTS.project(&anchor.name).expect("a name").z;
        let dot = |other: &[f32]| -> f32 {
            let norm = other.iter().map(|x| x * x).sum::<f32>().sqrt();
            other.iter().zip(&z).map(|(x, y)| x * y).sum::<f32>() / norm
        };
        anchors.iter().all(|other| dot(&other.z) <= dot(&anchor.z))
    });
    let right = right.count();
    println!("{right} of {} names", asked.len());
    assert!(right * 100 >= asked.len() * 95);
    figures::hold_at_full(
        "names",
        "-p asperity --test it a_name_is_its_material",
        [
            ("right", right.to_string()),
            ("of", asked.len().to_string()),
        ],
    );
}

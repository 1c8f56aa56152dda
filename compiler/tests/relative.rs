//! Edits in words go the way that the words say, and far enough to be noticed.

use asperity::{
    learned::inference::Backend,
    model::attributes::Attributes,
    passes::reduce::Fidelity,
    pipeline::Request,
    sources::{
        latents::{LatentEditor, Latents},
        prompt::PromptCompiler,
    },
};
use asperity_tests::size::sized;
use rayon::prelude::*;
use std::sync::LazyLock;

static PROMPTS: LazyLock<PromptCompiler> = LazyLock::new(|| {
    PromptCompiler::embedded(&Backend::Portable).expect("the shipped model loads")
});

/// A prompt, an edit in words, and the directions of the attributes; written for this test by the author of
/// the grammar.
const EDITS: &str = include_str!("relative_edits.tsv");

/// An attribute on a scale on which a person notices 1: 1.6 dB, 10 % of friction, 15 % in Hz.
fn scale(attribute: &str, a: &Attributes) -> f64 {
    match attribute {
        "rough" => a.rough_db.expect("a level") / 1.6,
        "slippery" => -libm::log(a.mu) / libm::log(1.1),
        "hard" => libm::log(a.hard_hz.expect("taps")) / libm::log(1.15),
        other => panic!("{other}"),
    }
}

fn latents(prompt: &str) -> Latents {
    let projection = PROMPTS.project(prompt).expect(prompt);
    let meaning = PROMPTS.meaning(&projection).expect(prompt);
    Latents::whole(meaning.z).shifted(meaning.shift)
}

/// The smallest step of an edit in the ways that it should go, in what a person notices.
fn step(editor: &LatentEditor<'_>, line: &str) -> f64 {
    let request = Request {
        fidelity: Fidelity::Auto,
        ..Request::default()
    };
    let fields: Vec<&str> = line.split('\t').collect();
    let [thing, text, ways] = fields[..] else {
        panic!("{line:?}");
    };
    let before = latents(thing);
    let after = editor.worded(&before, text, &request).expect(line).latents;
    let [before, after] =
        [before, after].map(|z| editor.kept_attributes(&z, &request).expect(line));
    let steps = ways.split(' ').map(|way| {
        let (attribute, sign) = way.split_at(way.len() - 1);
        let step = scale(attribute, &after) - scale(attribute, &before);
        if sign == "+" { step } else { -step }
    });
    steps.fold(f64::INFINITY, f64::min)
}

#[test]
fn edits_in_words_go_the_right_way_and_are_noticed() {
    let editor = LatentEditor::new(&PROMPTS);
    let lines: Vec<&str> = EDITS.lines().collect();
    assert_eq!(lines.len(), 60);
    let stride = sized("every so many edits", 4, 1);
    let lines: Vec<&str> = lines.into_iter().step_by(stride).collect();
    let steps: Vec<f64> = lines.par_iter().map(|line| step(&editor, line)).collect();
    for (line, step) in lines.iter().zip(&steps).filter(|(_, step)| **step <= 1.0) {
        println!("{step:+.2}: {line}");
    }
    let count = |least: f64| steps.iter().filter(|step| **step > least).count();
    let (right, noticed, all) = (count(0.0), count(1.0), steps.len());
    println!("{right} of {all} go the right way, {noticed} are noticed");
    assert!(right * 100 >= all * 95, "{right} of {all}");
    assert!(noticed * 100 >= all * 85, "{noticed} of {all}");
}

//! Which words moved which attribute, by occlusion: the prompt is read again without each word.

use super::latent_editor::LatentEditor;
use crate::{
    edit_memory::{AXES, Latents},
    learned::{Latent, description::LATENT},
    sources::prompt::{self, Interpretation},
};
use asperity_io::{diagnostic::Fault, shown::rounded};
use asperity_texture::model::attributes::{self, Attributes};
use rayon::prelude::*;
use serde::Serialize;
use serde_json::Value;
use std::fmt::Write as _;

/// Effect of a word.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WordEffect {
    /// The word as it stands in the prompt.
    pub word: String,
    /// Steps of the slider that the word moved it by.
    pub rough: f64,
    /// The same.
    pub sharp: f64,
    /// The same.
    pub hard: f64,
    /// The same.
    pub slippery: f64,
}

/// Effects of the words of a prompt, in order.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Explanation {
    /// Interpretation of the words: those encoded, then those left out.
    pub reading: Vec<Interpretation>,
    /// Interpretation of the whole phrase.
    pub phrase: String,
    /// Every word.
    pub words: Vec<WordEffect>,
}

/// Words that are looked at.
const MOST_WORDS: usize = 64;
/// Most words of which every subset is read; each one more doubles the prompts to be read.
const MOST_TOGETHER: usize = 6;

/// Attributes a prompt to its words. A word's effect is what taking it away does, in the mean over
/// all orders in which the words could be taken away (its Shapley value), so that words which say
/// the same share it. Articles and prepositions, and every word where more than six
/// say something, are taken away from the whole prompt alone. Without any word, the mean of all
/// materials is left.
///
/// # Errors
/// [`Fault`] for an empty prompt or a failing network.
pub fn explain(editor: &LatentEditor<'_>, text: &str) -> Result<Explanation, Fault> {
    let words: Vec<&str> = text.split_whitespace().take(MOST_WORDS).collect();
    let telling: Vec<usize> = (0..words.len()).filter(|&n| tells(words[n])).collect();
    let together: &[usize] = if telling.len() <= MOST_TOGETHER {
        &telling
    } else {
        &[]
    };
    // First the prompts with some of those words, by the bits of a number; then those without one of the others.
    let some = |set: usize| -> Vec<usize> {
        let left = |n: &usize| {
            together
                .iter()
                .position(|t| t == n)
                .is_none_or(|k| set >> k & 1 == 1)
        };
        (0..words.len()).filter(left).collect()
    };
    let sets = 1_usize << together.len();
    let alone: Vec<usize> = (0..words.len()).filter(|n| !together.contains(n)).collect();
    let without = alone
        .iter()
        .map(|&out| (0..words.len()).filter(|&n| n != out).collect());
    let kept: Vec<Vec<usize>> = (0..sets).map(some).chain(without).collect();
    let texts: Vec<String> = kept
        .iter()
        .map(|kept| {
            let says = kept.iter().any(|&n| tells(words[n]));
            let kept: Vec<&str> = kept.iter().map(|&n| words[n]).collect();
            if says { kept.join(" ") } else { String::new() }
        })
        .collect();
    let read = texts.iter().filter(|text| !text.is_empty());
    let read: Vec<&str> = read.map(String::as_str).collect();
    editor.prompt_compiler().read_ahead(&read);
    let places: Result<Vec<[f64; 4]>, Fault> =
        texts.par_iter().map(|text| places(editor, text)).collect();
    let places = places?;
    let count = together.len();
    let effects = (0..words.len()).map(|word| {
        let Some(own) = together.iter().position(|&n| n == word) else {
            let at = sets + alone.iter().position(|&n| n == word).unwrap_or(0);
            return apart(&places[sets - 1], &places[at], 1.0);
        };
        let mut sum = [0.0; 4];
        for set in (0..sets).filter(|set| set >> own & 1 == 0) {
            let others = set.count_ones() as usize;
            // The share of orders in which just these words are there before it.
            let share = 1.0 / (count * choices(count - 1, others)) as f64;
            let more = apart(&places[set | 1 << own], &places[set], share);
            sum.iter_mut()
                .zip(more)
                .for_each(|(sum, more)| *sum += more);
        }
        sum
    });
    let effects = effects
        .zip(&words)
        .map(|([rough, sharp, hard, slippery], word)| WordEffect {
            word: (*word).to_owned(),
            rough,
            sharp,
            hard,
            slippery,
        });
    let reading = editor.prompt_compiler().read(text);
    Ok(Explanation {
        reading: reading.interpretations(),
        phrase: reading.together(),
        words: effects.collect(),
    })
}

/// Ways to choose `k` of `n`.
fn choices(n: usize, k: usize) -> usize {
    (0..k).fold(1, |ways, i| ways * (n - i) / (i + 1))
}

fn apart(with: &[f64; 4], without: &[f64; 4], share: f64) -> [f64; 4] {
    std::array::from_fn(|axis| share * (with[axis] - without[axis]))
}

/// Returns true if a word describes a surface by itself.
fn tells(word: &str) -> bool {
    const SILENT: [&str; 24] = [
        "a", "an", "the", "and", "or", "of", "on", "in", "for", "from", "with", "without", "to",
        "at", "by", "as", "is", "it", "its", "that", "this", "like", "but", "my",
    ];
    let word = word
        .trim_matches(|c: char| !c.is_alphanumeric())
        .to_lowercase();
    !word.is_empty() && !SILENT.contains(&word.as_str())
}

/// Where a text lies on the sliders; the mean of all materials where it is empty.
fn places(editor: &LatentEditor<'_>, text: &str) -> Result<[f64; 4], Fault> {
    let attributes = if prompt::check(text).is_ok() {
        seen(editor, text)?
    } else {
        editor.attributes(&Latents::whole(mean(editor)))?
    };
    Ok(AXES.map(|axis| editor.scale().place(axis, &attributes).unwrap_or(0.0)))
}

fn seen(editor: &LatentEditor<'_>, text: &str) -> Result<Attributes, Fault> {
    Ok(attributes::of(&editor.prompt_compiler().texture(text)?))
}

fn mean(editor: &LatentEditor<'_>) -> Latent {
    let anchors = &editor.prompt_compiler().model().description().anchors;
    let mut sum = [0.0; LATENT];
    for anchor in anchors {
        sum.iter_mut()
            .zip(&anchor.z)
            .for_each(|(s, &z)| *s += f64::from(z));
    }
    sum.map(|s| (s / anchors.len().max(1) as f64) as f32)
}

impl Explanation {
    /// Adds `words`, `reading` and `phrase` to the report of the prompt, an object.
    pub fn add_to(&self, report: &mut Value) {
        // Plain structures of numbers and strings always serialise.
        report["words"] = serde_json::to_value(&self.words).unwrap_or_default();
        report["reading"] = serde_json::to_value(&self.reading).unwrap_or_default();
        report["phrase"] = self.phrase.as_str().into();
    }

    /// A table for people: a row a word, a column a slider.
    #[must_use]
    pub fn text(&self) -> String {
        let read = self
            .reading
            .iter()
            .map(|interpretation| &interpretation.text);
        let words = self.words.iter().map(|effect| &effect.word).chain(read);
        let width = words.map(|word| word.chars().count()).max();
        let width = width.unwrap_or(0).clamp("together".len(), 32);
        let mut text = String::new();
        for Interpretation { text: word, role } in &self.reading {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  {word:<width$}  {role}");
        }
        let _ = writeln!(text, "  {:<width$}  {}\n", "together", self.phrase);
        let _ = writeln!(
            text,
            "  {:<width$}  {:>6}  {:>6}  {:>6}  {:>8}",
            "word", "rough", "sharp", "hard", "slippery"
        );
        for word in &self.words {
            let WordEffect {
                word,
                rough,
                sharp,
                hard,
                slippery,
            } = word;
            let [rough, sharp, hard, slippery] =
                [rough, sharp, hard, slippery].map(|steps| rounded(*steps, 0));
            let _ = writeln!(
                text,
                "  {word:<width$}  {rough:>+6.0}  {sharp:>+6.0}  {hard:>+6.0}  {slippery:>+8.0}"
            );
        }
        text
    }
}

//! Which words moved which attribute, by occlusion: the prompt is read again without each word.

use super::{
    error::EditError,
    latents::Latents,
    scale::{AXES, Axis},
    studio::Studio,
};
use crate::{
    front_ends::{
        learned::{Latent, description::LATENT},
        prompt,
    },
    model::attributes::{self, Attributes},
};
use rayon::prelude::*;
use serde::Serialize;
use std::fmt::Write as _;

/// What one word did.
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

/// What the words of a prompt did, in their order.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Explanation {
    /// Every word.
    pub words: Vec<WordEffect>,
}

/// Words that are looked at; each costs a run of the text encoder.
const MOST_WORDS: usize = 64;

/// Attributes a prompt to its words. Of a single word the mean of all materials is taken away
/// instead.
///
/// # Errors
/// [`EditError`] for an empty prompt or a failing network.
pub fn explain(studio: &Studio<'_>, text: &str) -> Result<Explanation, EditError> {
    let words: Vec<&str> = text.split_whitespace().take(MOST_WORDS).collect();
    let with = seen(studio, text)?;
    let effects: Result<Vec<WordEffect>, EditError> = (0..words.len())
        .into_par_iter()
        .map(|index| {
            let rest: Vec<&str> = words
                .iter()
                .enumerate()
                .filter(|(other, _)| *other != index)
                .map(|(_, word)| *word)
                .collect();
            let rest = rest.join(" ");
            let without = if prompt::check(&rest).is_ok() {
                seen(studio, &rest)?
            } else {
                studio.attributes(&Latents::whole(mean(studio)))?
            };
            let moved = |axis: Axis| {
                let place = |attributes| studio.scale().place(axis, attributes).unwrap_or(0.0);
                place(&with) - place(&without)
            };
            let [rough, sharp, hard, slippery] = AXES.map(moved);
            Ok(WordEffect {
                word: words[index].to_owned(),
                rough,
                sharp,
                hard,
                slippery,
            })
        })
        .collect();
    Ok(Explanation { words: effects? })
}

fn seen(studio: &Studio<'_>, text: &str) -> Result<Attributes, EditError> {
    Ok(attributes::of(&studio.author().texture(text)?))
}

fn mean(studio: &Studio<'_>) -> Latent {
    let anchors = &studio.author().model().description().anchors;
    let mut sum = [0.0; LATENT];
    for anchor in anchors {
        sum.iter_mut()
            .zip(&anchor.z)
            .for_each(|(s, &z)| *s += f64::from(z));
    }
    sum.map(|s| (s / anchors.len().max(1) as f64) as f32)
}

impl Explanation {
    /// A table for people: a row a word, a column a slider.
    #[must_use]
    pub fn text(&self) -> String {
        let width = self.words.iter().map(|w| w.word.chars().count()).max();
        let width = width.unwrap_or(0).clamp(4, 32);
        let mut text = format!(
            "  {:<width$}  {:>6}  {:>6}  {:>6}  {:>8}\n",
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
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "  {word:<width$}  {rough:>+6.0}  {sharp:>+6.0}  {hard:>+6.0}  {slippery:>+8.0}"
            );
        }
        text
    }
}

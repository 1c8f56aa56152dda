//! Certainty of a prompt's interpretation.

use super::{
    phrase::Phrase,
    prompt_compiler::PromptCompiler,
    reading::{Correction, Reading},
};
use crate::learned::Certainty;
use asperity_language::lexicon::is_name;

/// The probability with which every word of a sentence should be known to be felt, or not.
const SURE: f32 = 0.7;

impl PromptCompiler {
    /// Rates a reading: known if it is a single name, with qualities and numbers at most; close if it is composed of
    /// known things, or lies near the training data; else a guess. It is one level lower if a word is felt or not with
    /// a probability below [`SURE`]. A corrected misspelling is at most close, and a guess if it may be another word.
    pub(super) fn certainty(&self, reading: &Reading, unfamiliar: bool) -> Certainty {
        let certainty = self.certainty_as_read(reading, unfamiliar);
        let certainty = match certainty {
            Certainty::Known if reading.sure < SURE => Certainty::Close,
            Certainty::Close if reading.sure < SURE => Certainty::Guess,
            certainty => certainty,
        };
        let corrected = |correction: &&Correction| reading.holds(&correction.corrected);
        match reading.correction.as_ref().filter(corrected) {
            Some(correction) if correction.doubtful => Certainty::Guess,
            Some(_) => certainty.min(Certainty::Close),
            None => certainty,
        }
    }

    fn certainty_as_read(&self, reading: &Reading, unfamiliar: bool) -> Certainty {
        let near = if unfamiliar {
            Certainty::Guess
        } else {
            Certainty::Close
        };
        if !reading.contact {
            return Certainty::NoContact;
        }
        if !reading.says {
            return Certainty::Guess;
        }
        match &reading.phrase {
            Phrase::Plain => match &reading.words[..] {
                [name] if is_name(name) => Certainty::Known,
                _ => near,
            },
            Phrase::Part { .. } => Certainty::Known,
            // Of words that lie near anything, what they are changed by says little.
            Phrase::Changed { base, .. } | Phrase::Graded { base, .. } => {
                self.certainty(&self.read_surface(base), unfamiliar)
            }
            composed => {
                let things = composed.things();
                let known = |thing: &&str| {
                    self.certainty(&self.read_surface(thing), true) == Certainty::Known
                };
                if things.iter().all(known) {
                    Certainty::Close
                } else {
                    near
                }
            }
        }
    }
}

//! How well what a prompt says is known.

use super::{lexicon::is_name, phrase::Phrase, prompt_compiler::PromptCompiler, reading::Reading};
use crate::learned::Certainty;

impl PromptCompiler {
    /// What was read is known where it is one name, with qualities and numbers at most; close where it is put
    /// together of known things, or lies near to what the model was trained on; else a guess.
    pub(super) fn certainty(&self, reading: &Reading, unfamiliar: bool) -> Certainty {
        let near = if unfamiliar {
            Certainty::Guess
        } else {
            Certainty::Close
        };
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
                self.certainty(&self.read(base), unfamiliar)
            }
            composed => {
                let things = composed.things();
                let known =
                    |thing: &&str| self.certainty(&self.read(thing), true) == Certainty::Known;
                if things.iter().all(known) {
                    Certainty::Close
                } else {
                    near
                }
            }
        }
    }
}

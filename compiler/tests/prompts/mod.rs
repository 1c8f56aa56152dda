//! Compiled prompts of the shipped model, on the portable back end.

mod certainty;
mod clip;
mod completion;
mod judged;
mod latents;
mod modifiers;
mod reading;
mod rewordings;
mod sentences;
mod spelling;
mod together;
mod words;

use asperity::{
    learned::inference::Backend,
    sources::prompt::{Options, PromptCompiler},
};
use std::sync::LazyLock;

/// Loaded once: the tests of this file only ask it.
pub(crate) static PROMPTS: LazyLock<PromptCompiler> = LazyLock::new(|| {
    PromptCompiler::embedded(&Backend::Portable).expect("the shipped model loads")
});

/// The asset of a prompt without its picture.
pub(crate) fn compiled(prompt: &str) -> Vec<u8> {
    let options = Options::default().without_preview();
    PROMPTS.compile(prompt, &options).unwrap().lowered.bytes
}

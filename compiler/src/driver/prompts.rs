//! Prompts, compiled one by one.

use super::{Compiled, Failure, compile};
use crate::sources::{
    Tools,
    prompt::{Author, Options, Prompt},
};

impl Author {
    /// Compiles a prompt.
    ///
    /// # Errors
    /// [`PromptError`](crate::prompt::PromptError) with the stage that failed, or what keeps any texture from passing.
    pub fn author(&self, prompt: &str, options: &Options) -> Result<Compiled, Failure> {
        let source = Prompt {
            text: prompt.to_owned(),
            seed: options.seed,
            picture: None,
        };
        compile(&source, &options.request, &Tools::of(self))
    }
}

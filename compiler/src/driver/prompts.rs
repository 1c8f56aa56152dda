//! Prompts, compiled one by one.

use super::{Compiled, Failure};
use crate::sources::{
    Tools,
    prompt::{Options, Prompt, PromptCompiler},
};

impl PromptCompiler {
    /// Compiles a prompt.
    ///
    /// # Errors
    /// [`PromptError`](crate::sources::prompt::PromptError) with the stage that failed, or what keeps any texture from passing.
    pub fn compile(&self, prompt: &str, options: &Options) -> Result<Compiled, Failure> {
        let source = Prompt {
            text: prompt.to_owned(),
            seed: options.seed,
            picture: None,
        };
        super::compile(&source, &options.request, &Tools::of(self))
    }
}

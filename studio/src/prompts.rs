//! The prompt compiler, which is loaded once and not before the page is there.

use crate::{error::ApiError, http::Status};
use asperity::{
    diagnostic::Failure,
    sources::{
        latents::{LatentEditor, Scale},
        prompt::PromptCompiler,
    },
};
use std::sync::OnceLock;

/// Loads the prompt compiler. Programs without the networks pass none.
pub type LoadPrompts = fn() -> Result<PromptCompiler, Failure>;

/// The prompt compiler, or that there is none.
pub(crate) struct Prompts {
    load: Option<LoadPrompts>,
    loaded: OnceLock<Result<Loaded, ApiError>>,
}

/// A prompt compiler that was loaded.
pub(crate) struct Loaded {
    pub(crate) compiler: PromptCompiler,
    /// The scale of its sliders.
    pub(crate) scale: Scale,
}

impl Loaded {
    /// Returns the editor, which mixes and edits latents.
    pub(crate) fn editor(&self) -> LatentEditor<'_> {
        LatentEditor::new(&self.compiler)
    }
}

impl Prompts {
    pub(crate) fn new(load: Option<LoadPrompts>) -> Self {
        Self {
            load,
            loaded: OnceLock::new(),
        }
    }

    /// Returns true if there is a prompt compiler, loaded or not.
    pub(crate) fn exist(&self) -> bool {
        self.load.is_some()
    }

    /// Returns what loads a prompt compiler.
    ///
    /// # Errors
    /// Where there is none.
    pub(crate) fn loader(&self) -> Result<LoadPrompts, ApiError> {
        self.load.ok_or_else(|| {
            ApiError::new(
                Status::Unprocessable,
                "this server does not compile prompts and does not edit textures",
                "open the page of `asperity studio`, which does both",
            )
        })
    }

    /// The prompt compiler. The first call loads it, others wait meanwhile.
    ///
    /// # Errors
    /// Where there is none, or it cannot be loaded.
    pub(crate) fn get(&self) -> Result<&Loaded, ApiError> {
        let load = self.loader()?;
        let loaded = self.loaded.get_or_init(|| {
            let compiler = load().map_err(|error| ApiError::of(error.as_ref()))?;
            let scale = Scale::of(compiler.model().description());
            Ok(Loaded { compiler, scale })
        });
        loaded.as_ref().map_err(Clone::clone)
    }
}

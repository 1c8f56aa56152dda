//! Sources of a texture: words, recordings, HaTT's materials, effects of other tools, a model of your own, an asset,
//! latents, a formula.
//!
//! A source is a type that implements [`Source`], in a file or a folder of its own. It reads its input and models the
//! texture; the [driver](crate::driver) does what all of them have in common. A line in the [`Registry`] lets manifests
//! name it. A texture that a program already holds is a source as well:
//!
//! ```
//! use asperity::{sources::{builtin, SourceOutput, Tools}, driver, pipeline::Request};
//!
//! let mut texture = builtin::texture();
//! texture.friction.mu = 0.2;
//! let compiled = driver::compile(&SourceOutput::new(texture), &Request::default(), &Tools::default())?;
//! assert_eq!(compiled.attributes().mu, 0.2);
//! # Ok::<(), asperity::driver::Failure>(())
//! ```

pub mod asset;
pub mod builtin;
pub mod effects;
pub mod hatt;
pub mod import;
pub mod key;
mod kind;
pub mod latents;
pub mod libraries;
pub mod model_file;
pub mod prompt;
pub mod recording;
mod registry;
pub mod surface;

pub use crate::compiled::Findings;
pub use kind::{Operand, SourceEntry, SourceKind};
pub use registry::Registry;

use crate::learned::Certainty;
use crate::{
    compiled::ErrorReference,
    edit_memory::Memory,
    learned::LearnedModel,
    pipeline::{Clock, Pipeline, Request, Ringing},
};
use asperity_io::{
    diagnostic::{Failure, Fault},
    input::{self, InputProblem},
};
use asperity_texture::model::TextureModel;
use key::Parts;
use libraries::OpenLibraries;
use prompt::PromptCompiler;
use std::{
    borrow::Cow,
    fmt,
    path::{Path, PathBuf},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

/// The origin of a texture, which it reads and models. [`driver::compile`](crate::driver::compile) does
/// what is the same for all of them.
pub trait Source: Send + Sync {
    /// Returns the prefix of error messages: mostly its file.
    fn origin(&self) -> String {
        String::new()
    }

    /// Files that it reads, none of which an output may replace.
    fn inputs(&self) -> Vec<PathBuf> {
        Vec::new()
    }

    /// Returns true if it needs the learned model, which takes a while to load.
    fn needs_model(&self) -> bool {
        false
    }

    /// Its prompt, if it is one: many are read together, and one names its texture.
    fn prompt(&self) -> Option<&str> {
        None
    }

    /// The texture, and what there is to know of it. Passes of its own are run, and so timed, by
    /// `pipeline`.
    ///
    /// # Errors
    /// Why there is no texture, which names its file and field.
    fn model(
        &self,
        request: &Request,
        tools: &Tools<'_>,
        pipeline: &mut Pipeline,
    ) -> Result<SourceOutput, Failure>;
}

/// A source that manifests can name, whose textures are cached.
pub trait ManifestSource: Source + fmt::Debug {
    /// Adds what decides its texture besides the request and the model, so that the cache tells it
    /// from others: the names and contents of its files, and its options.
    ///
    /// # Errors
    /// Why a file cannot be read.
    fn key(&self, parts: Parts, tools: &Tools<'_>) -> Result<Parts, Failure>;
}

/// Resources available to sources besides their files.
#[derive(Clone, Copy, Default)]
pub struct Tools<'a> {
    /// The learned model, which decodes latents and completes what was not recorded.
    pub model: Option<&'a LearnedModel>,
    /// Compiler of prompts.
    pub prompt_compiler: Option<&'a PromptCompiler>,
    /// A path and its bytes, where they are in memory already: the file is not read then, and need not be there.
    pub given: Option<(&'a Path, &'a [u8])>,
    /// Libraries that stay open while textures are taken of them.
    pub libraries: Option<&'a OpenLibraries>,
    /// Clock that times the passes.
    pub clock: Clock,
    /// Set, by another thread, once no more is wanted: the next texture is then refused.
    pub stop: Option<&'a AtomicBool>,
}

impl<'a> Tools<'a> {
    /// Those of a prompt compiler: its model, too.
    #[must_use]
    pub fn of(prompt_compiler: &'a PromptCompiler) -> Self {
        Self {
            model: Some(prompt_compiler.model()),
            prompt_compiler: Some(prompt_compiler),
            ..Self::default()
        }
    }

    /// Returns the compiler of prompts.
    ///
    /// # Errors
    /// Where none was given.
    pub fn prompt_compiler(&self) -> Result<&'a PromptCompiler, Failure> {
        Ok(self.prompt_compiler.ok_or_else(no_model)?)
    }

    /// The bytes of a file: those that were given under its path, or those that are read.
    pub(crate) fn file(
        &self,
        path: &Path,
        kind: input::InputKind,
    ) -> Result<Cow<'a, [u8]>, InputProblem> {
        match self.given {
            Some((given, bytes)) if given == path => {
                input::admit(bytes, kind)?;
                Ok(Cow::Borrowed(bytes))
            }
            _ => input::read(path, kind).map(Cow::Owned),
        }
    }

    /// Refuses to begin another texture once no more is wanted.
    pub(crate) fn go_on(&self) -> Result<(), Failure> {
        match self.stop {
            Some(stop) if stop.load(Ordering::Relaxed) => {
                Err(Fault::new("the work was stopped", "start it again").into())
            }
            _ => Ok(()),
        }
    }

    /// The learned model.
    ///
    /// # Errors
    /// Where none was given.
    pub fn model(&self) -> Result<&'a LearnedModel, Failure> {
        Ok(self.model.ok_or_else(no_model)?)
    }
}

fn no_model() -> Fault {
    let what = "the source needs the learned model, and none is loaded";
    Fault::new(what, "load one, such as `embedded::model()`")
}

/// A texture before its passes, and what its source knows of it.
#[derive(Debug, Clone)]
pub struct SourceOutput {
    /// The whole texture.
    pub texture: TextureModel,
    /// The asset, if there is one already. It is taken as it is, but for its name: nothing is
    /// reduced, lowered or measured again.
    pub asset: Option<Vec<u8>>,
    /// Reference for the compile error; if `None`, the error is that of the reduction alone.
    pub truth: Option<ErrorReference>,
    /// Treatment of a texture that rings.
    pub ringing: Ringing,
    /// Edit memory of the asset, so that it can be mixed and edited.
    pub memory: Option<Memory>,
    /// A picture that was made elsewhere, as PNG, in the place of a preview.
    pub picture: Option<Vec<u8>>,
    /// Certainty of the prompt's interpretation.
    pub certainty: Option<Certainty>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
    /// Additional findings of the source.
    pub findings: Option<Arc<dyn Findings>>,
}

impl SourceOutput {
    /// A texture of which nothing else is known. It may not ring.
    #[must_use]
    pub fn new(texture: TextureModel) -> Self {
        Self {
            texture,
            asset: None,
            truth: None,
            ringing: Ringing::Refused,
            memory: None,
            picture: None,
            certainty: None,
            warnings: Vec::new(),
            findings: None,
        }
    }
}

/// A texture at hand is a source, too.
impl Source for SourceOutput {
    fn model(&self, _: &Request, _: &Tools<'_>, _: &mut Pipeline) -> Result<SourceOutput, Failure> {
        Ok(self.clone())
    }
}

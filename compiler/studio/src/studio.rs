//! What the server knows: networks, what it was started with, the last textures.

use crate::{
    collection::Collection, device::{Description, LiveDevice}, error::ApiError, recent::Recent, texture::Texture, turns::Turns,
};
use asperity::{
    inference::Backend,
    prompt::{PromptCompiler, suggestions},
};
use serde::Serialize;
use std::sync::{Arc, OnceLock};

/// A studio for one person.
pub struct Studio {
    collection: Option<Collection>,
    device: Option<LiveDevice>,
    prompt_compiler: OnceLock<Result<PromptCompiler, ApiError>>,
    recent: Recent,
    turns: Turns,
}

/// What the page asks first.
#[derive(Serialize)]
struct About<'a> {
    version: &'a str,
    library: Option<Library<'a>>,
    folder: Option<String>,
    words: Vec<&'static str>,
    device: Option<Description<'a>>,
}

#[derive(Serialize)]
struct Library<'a> {
    name: &'a str,
    textures: usize,
}

impl Studio {
    /// A studio, with the textures that it was started with.
    #[must_use]
    pub fn new(collection: Option<Collection>) -> Self {
        Self {
            collection,
            device: None,
            prompt_compiler: OnceLock::new(),
            recent: Recent::default(),
            turns: Turns::new(),
        }
    }

    /// The same, beside the servo loop of this device.
    #[must_use]
    pub fn with_device(self, device: LiveDevice) -> Self {
        Self {
            device: Some(device),
            ..self
        }
    }

    /// The device beside it.
    pub(crate) fn device(&self) -> Option<&LiveDevice> {
        self.device.as_ref()
    }

    /// Loads the networks, unless they are loaded; others who need them wait.
    pub(crate) fn load(&self) {
        let _ = self.prompt_compiler();
    }

    /// What the server is, JSON.
    pub(crate) fn about(&self) -> Vec<u8> {
        let collection = self.collection.as_ref();
        let about = About {
            version: env!("CARGO_PKG_VERSION"),
            library: collection.map(|collection| Library {
                name: collection.name(),
                textures: collection.textures(),
            }),
            folder: collection
                .and_then(Collection::folder)
                .map(|folder| folder.display().to_string()),
            words: suggestions(),
            device: self.device.as_ref().map(LiveDevice::description),
        };
        // Plain structures of numbers and strings always serialise.
        serde_json::to_vec(&about).unwrap_or_default()
    }

    /// Compiles a prompt, and keeps the texture.
    pub(crate) fn compile(&self, prompt: &str, seed: u64) -> Result<Arc<Texture>, ApiError> {
        let texture = self.compute(|| Texture::compiled(self.prompt_compiler()?, prompt, seed))?;
        Ok(self.keep(texture))
    }

    /// Opens the bytes of an asset, and keeps it.
    pub(crate) fn open(&self, file: &str, bytes: Vec<u8>) -> Result<Arc<Texture>, ApiError> {
        let texture = self.compute(|| Texture::opened(file, bytes))?;
        Ok(self.keep(texture))
    }

    /// A texture that was compiled or opened lately.
    pub(crate) fn texture(&self, id: &str) -> Option<Arc<Texture>> {
        self.recent.get(id)
    }

    /// Does this once few others compute.
    pub(crate) fn compute<T>(&self, work: impl FnOnce() -> T) -> T {
        self.turns.take(work)
    }

    fn keep(&self, texture: Texture) -> Arc<Texture> {
        let texture = Arc::new(texture);
        self.recent.keep(Arc::clone(&texture));
        texture
    }

    fn prompt_compiler(&self) -> Result<&PromptCompiler, ApiError> {
        let loaded = self.prompt_compiler.get_or_init(|| {
            PromptCompiler::embedded(&Backend::Portable).map_err(|error| ApiError::of(&error))
        });
        loaded.as_ref().map_err(Clone::clone)
    }
}

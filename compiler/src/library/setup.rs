//! Which networks a build runs, where they run, and what identifies them.

use super::{lock::Pinned, manifest::Manifest};
use crate::{
    learned::{
        Files, LearnedModel, embedded,
        files::wrong_file,
        inference::{Backend, BackendName, not_installed},
        text::{TextEncoder, TextEncoderChoice, clip::Clip},
    },
    sources::prompt::{PromptCompiler, reading},
};
use asperity_io::{
    diagnostic::{Failures, Fault, one},
    input::{self, InputError, InputKind},
};
use std::path::{Path, PathBuf};

/// Which networks are run, and where.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Setup {
    /// Text encoder.
    pub text_encoder: TextEncoderChoice,
    /// A model folder; the embedded model if `None`.
    pub model: Option<PathBuf>,
    /// Inference back end.
    pub backend: BackendName,
}

impl Setup {
    /// This one, and that of the manifest where this has the usual ones.
    ///
    /// # Errors
    /// For a text encoder or a back end that the manifest names and that does not exist.
    pub fn within(&self, manifest: &Manifest) -> Result<Self, Failures> {
        let wrong = |key: &str, message: String| {
            let fault = Fault::new(message, "correct the value").at(&manifest.file);
            one(fault.field(format!("defaults.{key}")))
        };
        let stated = &manifest.setup;
        let mut setup = self.clone();
        if setup.model.is_none() {
            setup.model.clone_from(&stated.model);
        }
        if let (TextEncoderChoice::MiniLm, Some(text)) = (&self.text_encoder, &stated.text_encoder)
        {
            setup.text_encoder = text.parse().map_err(|e: String| wrong("text_encoder", e))?;
        }
        if let (BackendName::Portable, Some(text)) = (self.backend, &stated.backend) {
            setup.backend = text.parse().map_err(|e: String| wrong("backend", e))?;
        }
        Ok(setup)
    }

    /// The prompt compiler of these networks.
    ///
    /// # Errors
    /// Where a file cannot be read, does not fit the others, or a library is missing.
    pub fn prompt_compiler(&self) -> Result<PromptCompiler, Failures> {
        let backend = Backend::open(self.backend).map_err(|error| one(not_installed(error)))?;
        if self.model.is_none() && self.text_encoder == TextEncoderChoice::MiniLm {
            return PromptCompiler::embedded(&backend).map_err(one);
        }
        let text = self.text_encoder(&backend)?;
        PromptCompiler::new(text, self.model(&backend)?).map_err(one)
    }

    /// The text encoder.
    ///
    /// # Errors
    /// As [`prompt_compiler`](Self::prompt_compiler).
    pub fn text_encoder(&self, backend: &Backend) -> Result<Box<dyn TextEncoder>, Failures> {
        Ok(match &self.text_encoder {
            TextEncoderChoice::MiniLm => Box::new(embedded::text_encoder(backend).map_err(one)?),
            TextEncoderChoice::Clip(folder) => Box::new(Clip::open(folder, backend).map_err(one)?),
        })
    }

    /// The learned model.
    ///
    /// # Errors
    /// As [`prompt_compiler`](Self::prompt_compiler).
    pub fn model(&self, backend: &Backend) -> Result<LearnedModel, Failures> {
        LearnedModel::load(self.folder()?, backend).map_err(one)
    }

    fn folder(&self) -> Result<Files, Failures> {
        match &self.model {
            Some(folder) => Files::read(folder).map_err(one),
            None => Ok(embedded::model()),
        }
    }

    /// Returns the versions that, with its manifest, determine the bytes of a texture.
    ///
    /// # Errors
    /// Where a file cannot be read.
    pub fn pinned(&self) -> Result<Pinned, Failures> {
        #[derive(serde::Deserialize)]
        struct Named {
            name: String,
        }
        let files = self.folder()?;
        let named: Named = serde_json::from_str(&files.description)
            .map_err(|error| one(wrong_file("model.json", error)))?;
        let (text_encoder, text_encoder_crc32) = match &self.text_encoder {
            TextEncoderChoice::MiniLm => {
                let mut crc = crc32fast::Hasher::new();
                crc.update(asperity_model::TEXT_ENCODER);
                crc.update(asperity_model::VOCABULARY.as_bytes());
                crc.update(asperity_model::WORD_ROWS.as_bytes());
                crc.update(asperity_model::WORD_VECTORS);
                ("minilm".to_owned(), crc.finalize())
            }
            TextEncoderChoice::Clip(folder) => ("clip".to_owned(), folder_crc32(folder)?),
        };
        Ok(Pinned {
            asperity: env!("CARGO_PKG_VERSION").to_owned(),
            model: named.name,
            model_crc32: files.crc32(),
            text_encoder,
            text_encoder_crc32,
            backend: self.backend.to_string(),
            reader: reading::VERSION.to_owned(),
        })
    }

    /// The files that are read, which no output may replace.
    #[must_use]
    pub fn files(&self) -> Vec<PathBuf> {
        let mut files = model_files(self.model.as_deref());
        if let TextEncoderChoice::Clip(folder) = &self.text_encoder {
            files.extend(networks(folder));
        }
        files
    }
}

/// The files of a model folder; none of the embedded model.
#[must_use]
pub fn model_files(folder: Option<&Path>) -> Vec<PathBuf> {
    folder.map_or_else(Vec::new, |folder| {
        let mut files = networks(folder);
        files.push(folder.join("model.json"));
        files
    })
}

/// The networks in a folder. One that cannot be read is refused where it is opened.
fn networks(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|e| e == "onnx"))
        .collect()
}

/// CRC-32 of the files of a text encoder, in order of name.
fn folder_crc32(folder: &Path) -> Result<u32, Failures> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut paths: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.is_file())
        .collect();
    paths.sort();
    let mut crc = crc32fast::Hasher::new();
    for path in paths {
        let bytes = input::read(&path, InputKind::TextEncoder).map_err(|problem| {
            let file = path.clone();
            one(InputError { file, problem })
        })?;
        crc.update(&bytes);
    }
    Ok(crc.finalize())
}

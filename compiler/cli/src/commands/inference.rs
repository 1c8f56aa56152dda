//! From options to encoders, models and back ends, and what identifies them.

use crate::cli::Inference;
use asperity::{
    embedded,
    inference::Backend,
    learned::{Files, LearnedModel, ModelError},
    library::Pinned,
    prompt::PromptCompiler,
    text::{TextEncoder, TextEncoderChoice, clip::Clip},
};
use asperity_io::{
    diagnostic::{Failures, one},
    input::{self, InputError, Kind},
};
use std::path::{Path, PathBuf};

/// The prompt_compiler that the options describe.
pub(crate) fn prompt_compiler(options: &Inference) -> Result<PromptCompiler, Failures> {
    let backend = Backend::open(options.backend).map_err(one)?;
    if options.model.is_none() && options.text_encoder == TextEncoderChoice::MiniLm {
        return PromptCompiler::embedded(&backend).map_err(one);
    }
    let text = text_encoder(options, &backend)?;
    PromptCompiler::new(text, model(options, &backend)?).map_err(one)
}

/// The text encoder that the options name.
pub(crate) fn text_encoder(
    options: &Inference,
    backend: &Backend,
) -> Result<Box<dyn TextEncoder>, Failures> {
    Ok(match &options.text_encoder {
        TextEncoderChoice::MiniLm => Box::new(embedded::text_encoder(backend).map_err(one)?),
        TextEncoderChoice::Clip(folder) => Box::new(Clip::open(folder, backend).map_err(one)?),
    })
}

/// The learned model that the options name.
pub(crate) fn model(options: &Inference, backend: &Backend) -> Result<LearnedModel, Failures> {
    LearnedModel::load(model_folder(options)?, backend).map_err(one)
}

fn model_folder(options: &Inference) -> Result<Files, Failures> {
    match &options.model {
        Some(folder) => Files::read(folder).map_err(one),
        None => Ok(embedded::model()),
    }
}

/// What decides the bytes of a texture besides its manifest.
pub(crate) fn pinned(options: &Inference) -> Result<Pinned, Failures> {
    #[derive(serde::Deserialize)]
    struct Named {
        name: String,
    }
    let files = model_folder(options)?;
    let named: Named = serde_json::from_str(&files.description).map_err(|error| {
        one(ModelError::Description {
            file: "model.json".into(),
            message: error.to_string(),
        })
    })?;
    let (text_encoder, text_encoder_crc32) = match &options.text_encoder {
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
        backend: options.backend.to_string(),
        reader: asperity::prompt::reading::VERSION.to_owned(),
    })
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
        let bytes = input::read(&path, Kind::TextEncoder).map_err(|problem| {
            let file = path.clone();
            one(InputError { file, problem })
        })?;
        crc.update(&bytes);
    }
    Ok(crc.finalize())
}

/// This program to the byte, because two builds of one version may give other textures. A program
/// that cannot be read counts by its version alone.
pub(crate) fn program() -> String {
    let bytes = std::env::current_exe().and_then(std::fs::read);
    let crc32 = bytes.map_or(0, |bytes| crc32fast::hash(&bytes));
    format!("{} {crc32:08x}", env!("CARGO_PKG_VERSION"))
}

/// The model that completes what an import lacks, on the portable back end.
pub(crate) fn completer(folder: Option<&Path>) -> Result<LearnedModel, Failures> {
    let files = match folder {
        Some(folder) => Files::read(folder).map_err(one)?,
        None => embedded::model(),
    };
    LearnedModel::load(files, &Backend::Portable).map_err(one)
}

/// The files that the options read, which no output may replace.
pub(crate) fn files(options: &Inference) -> Vec<PathBuf> {
    let mut files = model_files(options.model.as_deref());
    if let TextEncoderChoice::Clip(folder) = &options.text_encoder {
        files.extend(networks(folder));
    }
    files
}

/// The files of a model folder; none of the embedded model.
pub(crate) fn model_files(folder: Option<&Path>) -> Vec<PathBuf> {
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

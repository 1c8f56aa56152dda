//! From options to encoders, models and back ends.

use crate::cli::Inference;
use asperity::{
    diagnostic::{Failures, one},
    embedded,
    inference::Backend,
    learned::{Files, LearnedModel},
    prompt::Author,
    text::{TextEncoder, TextEncoderChoice, clip::Clip},
};
use std::path::{Path, PathBuf};

/// The author that the options describe.
pub(crate) fn author(options: &Inference) -> Result<Author, Failures> {
    let backend = Backend::open(options.backend).map_err(one)?;
    let text = text_encoder(options, &backend)?;
    Author::new(text, model(options, &backend)?).map_err(one)
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
    let files = match &options.model {
        Some(folder) => Files::read(folder).map_err(one)?,
        None => embedded::model(),
    };
    LearnedModel::load(files, backend).map_err(one)
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

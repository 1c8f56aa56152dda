//! From options to encoders, models and back ends.

use crate::{
    cli::Inference,
    failure::{Failures, one},
};
use asperity::{
    embedded,
    inference::Backend,
    learned::{Files, LearnedModel},
    prompt::Author,
    text::{TextEncoder, TextEncoderChoice, clip::Clip},
};
use std::path::Path;

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

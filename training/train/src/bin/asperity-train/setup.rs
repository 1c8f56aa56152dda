//! Setup common to both long commands.

use asperity::learned::{
    embedded,
    inference::Backend,
    text::{TextEncoder, TextEncoderChoice, clip::Clip},
};
use asperity_io::diagnostic::Failure;
use std::{num::NonZeroUsize, thread};

/// The chosen text encoder on a back end.
pub(crate) fn text_encoder(
    choice: &TextEncoderChoice,
    backend: &Backend,
) -> Result<Box<dyn TextEncoder>, Failure> {
    Ok(match choice {
        TextEncoderChoice::MiniLm => Box::new(embedded::text_encoder(backend)?),
        TextEncoderChoice::Clip(folder) => Box::new(Clip::open(folder, backend)?),
    })
}

/// As many threads as asked for, or as there are cores.
pub(crate) fn threads(asked: Option<NonZeroUsize>) -> usize {
    let cores = || thread::available_parallelism().map_or(1, usize::from);
    asked.map_or_else(cores, usize::from)
}

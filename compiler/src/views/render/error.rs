//! Why a trajectory could not be rendered, and what to do about it.

use asperity_io::diagnostic::{Diagnostic, Fault};
use asperity_runtime::{ConfigError, LoadError, SceneError};
use std::io;
use thiserror::Error;

/// Why a trajectory could not be rendered.
#[derive(Debug, Error)]
pub enum RenderError {
    /// The trajectory or the texture.
    #[error(transparent)]
    Fault(#[from] Fault),
    /// The result could not be written.
    #[error("cannot write the result: {0}")]
    Write(io::Error),
}

impl Diagnostic for RenderError {
    fn remedy(&self) -> String {
        match self {
            Self::Fault(fault) => fault.remedy(),
            Self::Write(error) if error.kind() == io::ErrorKind::StorageFull => {
                "free space on the disk, or give a path on another one".into()
            }
            Self::Write(_) => "check the path and the disk".into(),
        }
    }

    fn is_usage(&self) -> bool {
        matches!(self, Self::Fault(fault) if fault.usage)
    }
}

/// Remedy for a servo rate at which the texture is not rendered.
const OTHER_RATE: &str =
    "give a --rate that the runtime supports, or compile the texture for another rate";

/// Returns the fault of a texture whose rate is no servo rate.
pub(super) fn unsupported(texture: &str, cause: ConfigError) -> Fault {
    let what = format!("{texture}: the servo rate is not supported: {cause}");
    Fault::new(what, OTHER_RATE).usage()
}

/// Returns the fault of a texture that does not fit the runtime's slot.
pub(super) fn not_loaded(texture: &str, cause: LoadError) -> Fault {
    at_rate(Fault::new(format!("{texture}: {cause}"), OTHER_RATE), cause)
}

/// Returns the fault of a scene that cannot be rendered.
pub(super) fn no_scene(error: SceneError) -> Fault {
    let what = format!("the scene cannot be rendered: {error}");
    let fault = Fault::new(what, "build the scene again");
    match error {
        SceneError::Texture { cause, .. } => at_rate(fault, cause),
        _ => fault,
    }
}

/// A wrong rate of the servo loop is an option.
fn at_rate(fault: Fault, cause: LoadError) -> Fault {
    let LoadError::Rate { model_hz, .. } = cause else {
        return fault;
    };
    let remedy = format!("give --rate {model_hz} or 2, 3, … 20 times as much").into();
    Fault { remedy, ..fault }.usage()
}

//! Why a servo loop cannot run on a desk.

use crate::compensation::CompensationError;
use asperity::emit::textures::TexturesError;
use asperity_formats::FormatError;
use asperity_host::device::OpenError;
use asperity_host::profile::ProfileError;
use asperity_host::servo::SettingsError;
use asperity_io::diagnostic::Diagnostic;
use asperity_io::system;
use asperity_runtime::{LoadError, SceneError};
use asperity_sim::config::ConfigError;
use std::io;
use std::path::PathBuf;

/// Why a servo loop cannot run on a desk.
#[derive(Debug, thiserror::Error)]
pub enum ServoSessionError {
    /// The file is no texture and no scene.
    #[error(transparent)]
    Source(#[from] TexturesError),
    /// The bytes of a texture or a library are damaged.
    #[error("{origin}: {cause}")]
    Format {
        /// The file.
        origin: String,
        /// The format error.
        cause: FormatError,
    },
    /// The texture does not fit the slot or the servo rate.
    #[error("{origin}: {cause}")]
    Load {
        /// The file.
        origin: String,
        /// The load error.
        cause: LoadError,
    },
    /// The scene does not fit.
    #[error("{origin}: {cause}")]
    Scene {
        /// The file.
        origin: String,
        /// The scene error.
        cause: SceneError,
    },
    /// The texture does not take the filter of a profile.
    #[error("{origin}: {cause}")]
    Voice {
        /// The file.
        origin: String,
        /// The compensation error.
        cause: CompensationError,
    },
    /// The profile of the device is refused.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// The built-in texture cannot be made.
    #[error("{0}")]
    BuiltIn(String),
    /// A device that is only identified.
    #[error(
        "`{0}`: a Touch can only be identified over USB, not driven, because its protocol is not public"
    )]
    IdentifiedOnly(String),
    /// The device cannot be opened.
    #[error(transparent)]
    Open(#[from] OpenError),
    /// The file of a simulated device or grip was refused.
    #[error(transparent)]
    Simulated(#[from] ConfigError),
    /// No renderer can serve the device.
    #[error("the device cannot be served: {0}")]
    Config(#[from] asperity_runtime::ConfigError),
    /// The loop cannot run at this rate.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// The system has no room for a thread.
    #[error("cannot start a thread: {0}")]
    Thread(io::Error),
    /// A name that says nothing of how to record.
    #[error("{}: unknown format of a recording: the name must end in .aspr or .csv", .0.display())]
    RecordName(PathBuf),
    /// The record cannot be written.
    #[error("{}: the recording cannot be written: {cause}", path.display())]
    Record {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: io::Error,
    },
    /// A rate other than the one at which a recording was made.
    #[error("the recording was made at {recorded_hz} Hz and cannot be replayed at {asked_hz} Hz")]
    RecordedRate {
        /// Its rate.
        recorded_hz: f32,
        /// The one that was asked for.
        asked_hz: u32,
    },
    /// The servo thread panicked.
    #[error("the servo thread panicked")]
    Bug,
}

impl Diagnostic for ServoSessionError {
    fn is_usage(&self) -> bool {
        match self {
            Self::Source(error) => error.is_usage(),
            Self::Open(error) => !matches!(error, OpenError::Failed { .. }),
            Self::Settings(error) => *error != SettingsError::Rounding,
            Self::IdentifiedOnly(_) | Self::RecordName(_) | Self::RecordedRate { .. } => true,
            Self::Load { cause, .. } => matches!(cause, LoadError::Rate { .. }),
            _ => false,
        }
    }

    fn remedy(&self) -> String {
        match self {
            Self::Source(error) => error.remedy(),
            Self::Format { .. } => "build the file again from its source".into(),
            Self::Load {
                cause: LoadError::Rate { model_hz, .. },
                ..
            } => format!("give --rate {model_hz}, or 2, 3, … 20 times as much"),
            Self::Load { .. } | Self::Scene { .. } => {
                "compile the texture again with fewer vertices or a lower order".into()
            }
            Self::Voice { cause, .. } => cause.remedy(),
            Self::Profile(error) => error.remedy().into(),
            Self::BuiltIn(_) | Self::Bug => "report this as a bug".into(),
            Self::IdentifiedOnly(_) => {
                "use openhaptics: with the vendor's library, or check its state with `asperity-lab device probe touch:`".into()
            }
            Self::Open(error) => error.remedy(),
            Self::RecordName(_) => {
                "give OUT.aspr for a recording to replay, or OUT.csv for a table".into()
            }
            Self::Record { cause, .. } => system::remedy(cause)
                .unwrap_or("record fewer seconds, or onto another disk")
                .into(),
            Self::RecordedRate { .. } => "leave out --rate".into(),
            Self::Simulated(error) => error.remedy(),
            Self::Config(_) => "change the value in the device file".into(),
            Self::Settings(SettingsError::Rounding) => {
                "reset the rounding mode, which a library in this process has changed".into()
            }
            Self::Settings(_) => "give --rate 250 to 10000".into(),
            Self::Thread(_) => "close other programs, or raise `ulimit -u`".into(),
        }
    }
}

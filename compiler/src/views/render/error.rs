//! Why a trajectory could not be rendered, and what to do about it.

use super::{MAX_SCENE_TEXTURES, columns::INPUT_COLUMNS};
use asperity_io::{diagnostic::Diagnostic, input::InputError, table::TableError};
use asperity_runtime::{ConfigError, LoadError, SceneError};
use std::{io, path::PathBuf};
use thiserror::Error;

/// Why a trajectory could not be rendered.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The trajectory cannot be opened or read, or is too large.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A scene with more textures than are rendered at once.
    #[error("the scene has {found} textures, {MAX_SCENE_TEXTURES} are rendered at most")]
    Textures {
        /// Textures of the library.
        found: usize,
    },
    /// It is no table, or a damaged one.
    #[error("{file}: {error}", file = file.display())]
    Table {
        /// The file.
        file: PathBuf,
        /// The fault, with the line.
        error: TableError,
    },
    /// A column is missing.
    #[error("{file}:{line}: column {column} is missing", file = file.display())]
    MissingColumn {
        /// The file.
        file: PathBuf,
        /// Line of the header, 1-based.
        line: u64,
        /// The column.
        column: &'static str,
    },
    /// A column is there twice.
    #[error("{file}:{line}: column {column} appears twice", file = file.display())]
    RepeatedColumn {
        /// The file.
        file: PathBuf,
        /// Line of the header, 1-based.
        line: u64,
        /// The column.
        column: &'static str,
    },
    /// A field is not a finite number.
    #[error("{file}:{line}: {column} = {value:?} is not a finite number", file = file.display())]
    NotANumber {
        /// The file.
        file: PathBuf,
        /// Line, 1-based.
        line: u64,
        /// The column.
        column: &'static str,
        /// The text found.
        value: String,
    },
    /// A time that does not match the rate of the texture.
    #[error(
        "{file}:{line}: t_s = {found} s, but at {rate_hz} Hz row {row} must be at {due} s",
        file = file.display()
    )]
    Rate {
        /// The file.
        file: PathBuf,
        /// Line, 1-based.
        line: u64,
        /// Row, 0-based.
        row: u64,
        /// The time found, s.
        found: f64,
        /// The time due, s.
        due: f64,
        /// Rate of the texture, Hz.
        rate_hz: f32,
    },
    /// There is no row.
    #[error("{file}: the trajectory has no rows", file = file.display())]
    Empty {
        /// The file.
        file: PathBuf,
    },
    /// The texture does not fit the runtime's slot.
    #[error("{texture}: {cause}")]
    Load {
        /// Name of the texture.
        texture: String,
        /// Why.
        cause: LoadError,
    },
    /// The library's scene cannot be rendered.
    #[error("the scene cannot be rendered: {0}")]
    Scene(SceneError),
    /// The texture's rate is no servo rate.
    #[error("{texture}: the servo rate is not supported: {cause}")]
    Config {
        /// Name of the texture.
        texture: String,
        /// Why.
        cause: ConfigError,
    },
    /// The result could not be written.
    #[error("cannot write the result: {0}")]
    Write(io::Error),
}

impl Diagnostic for RenderError {
    fn remedy(&self) -> String {
        match self {
            Self::Input(error) => error.remedy(),
            Self::Textures { .. } => {
                "build the scene again with `asperity build`, which packs only textures in use"
                    .into()
            }
            Self::Table { .. } | Self::Empty { .. } => format!(
                "give UTF-8 text with the header {} and one row per tick",
                INPUT_COLUMNS.join(",")
            ),
            Self::MissingColumn { .. } | Self::RepeatedColumn { .. } => {
                format!("start the file with the header {}", INPUT_COLUMNS.join(","))
            }
            Self::NotANumber { .. } => "write a number, such as 12.5".into(),
            Self::Rate { rate_hz, .. } => format!(
                "resample the trajectory to {rate_hz} Hz, so that t_s increases by {} s per row",
                1.0 / rate_hz
            ),
            Self::Load {
                cause: LoadError::Rate { model_hz, .. },
                ..
            }
            | Self::Scene(SceneError::Texture {
                cause: LoadError::Rate { model_hz, .. },
                ..
            }) => format!("give --rate {model_hz} or 2, 3, … 20 times as much"),
            Self::Load { .. } | Self::Config { .. } => {
                "give a --rate that the runtime supports, or compile the texture for another rate"
                    .into()
            }
            Self::Scene(_) => "build the scene again".into(),
            Self::Write(error) if error.kind() == io::ErrorKind::StorageFull => {
                "free space on the disk, or give a path on another one".into()
            }
            Self::Write(_) => "check the path and the disk".into(),
        }
    }

    fn is_usage(&self) -> bool {
        matches!(
            self,
            Self::Config { .. }
                | Self::Load {
                    cause: LoadError::Rate { .. },
                    ..
                }
                | Self::Scene(SceneError::Texture {
                    cause: LoadError::Rate { .. },
                    ..
                })
        )
    }
}

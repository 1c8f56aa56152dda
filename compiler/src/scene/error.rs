//! Why a scene cannot be built.

use super::target::Target;
use crate::emit::pack::LibraryError;
use asperity_io::{diagnostic::Diagnostic, shown::suggestion, toml_error::TomlError};
use std::path::PathBuf;
use thiserror::Error;

/// Why a scene cannot be built: the file, the field, the reason.
#[derive(Debug, Error)]
#[error("{file}: {field}{colon}{problem}", file = file.display(), colon = if field.is_empty() { "" } else { ": " })]
pub struct SceneError {
    /// The scene's file.
    pub file: PathBuf,
    /// Path of the field, e.g. `surface[1].texture`; empty for the file itself.
    pub field: String,
    /// The fault.
    pub problem: SceneProblem,
}

/// Fault of a scene.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SceneProblem {
    /// It is not TOML, or a field is missing, unknown or of another type.
    #[error("{0}")]
    Syntax(TomlError),
    /// A table in single brackets in place of a list.
    #[error("{0}: one table in single brackets, but a list of tables is expected")]
    Single(&'static str),
    /// The scene has no surface.
    #[error("the scene has no surface")]
    NoSurface,
    /// More surfaces than a library holds.
    #[error("{0} surfaces, but a scene has at most 64")]
    TooMany(usize),
    /// A surface wears a texture that the scene does not have.
    #[error("no texture {wanted:?}; the scene has {known:?}")]
    UnknownTexture {
        /// Requested name.
        wanted: String,
        /// Known names.
        known: Vec<String>,
    },
    /// The surface has no solid, or several.
    #[error("a surface must have exactly one of `plane`, `sphere` and `box`")]
    Solid,
    /// A number out of its range.
    #[error("{value} is not from {low} to {high}")]
    Value {
        /// The number.
        value: f64,
        /// The least.
        low: f64,
        /// The most.
        high: f64,
    },
    /// A region whose corners are swapped.
    #[error("{to} m is not above {from} m of from_m")]
    Region {
        /// Coordinate of the lower corner, m.
        from: f32,
        /// Coordinate of the upper corner, m.
        to: f32,
    },
    /// A texture is asked for at a rate that does not divide that of the servo loop.
    #[error("{rate_hz} Hz does not divide the servo_rate_hz of {servo_hz}")]
    Rate {
        /// Rate of the models, Hz.
        rate_hz: f64,
        /// Rate of the servo loop, Hz.
        servo_hz: f64,
    },
    /// Too many instructions at every fidelity.
    #[error("{name:?} takes {least} instructions per tick at its lowest fidelity, {over} more than the budget of {budget} ({target})", over = least - budget)]
    Instructions {
        /// The texture.
        name: String,
        /// The fewest it takes.
        least: u64,
        /// Budget, instructions per tick.
        budget: u64,
        /// Where.
        target: Target,
    },
    /// Too many bytes at the lowest fidelities.
    #[error("the library takes {least} bytes at the lowest fidelities, {over} more than the budget of {budget} bytes", over = least - budget)]
    Bytes {
        /// The fewest bytes.
        least: u64,
        /// Budget, bytes.
        budget: u64,
        /// Textures in it.
        textures: usize,
    },
    /// The library could not be written.
    #[error(transparent)]
    Library(#[from] LibraryError),
}

impl Diagnostic for SceneError {
    fn remedy(&self) -> String {
        match &self.problem {
            SceneProblem::Single(key) => {
                format!("write [[{key}]], in double brackets, above each of them")
            }
            SceneProblem::Syntax(_) => "see the example in docs/scenes.md".into(),
            SceneProblem::NoSurface => {
                "add a [[surface]] with a texture and a plane, sphere or box".into()
            }
            SceneProblem::TooMany(_) => "split the scene".into(),
            SceneProblem::UnknownTexture { wanted, known } => {
                let add = format!("add a [[texture]] with name = {wanted:?}, or correct the name");
                match suggestion(wanted, known.iter().map(String::as_str)) {
                    Some(suggestion) => format!("{suggestion} {add}"),
                    None => add,
                }
            }
            SceneProblem::Solid => {
                "give one, such as plane = { point_m = [0, 0, 0], normal = [0, 0, 1] }".into()
            }
            SceneProblem::Value { .. } => {
                "give a number in that range; lengths are in metres".into()
            }
            SceneProblem::Region { .. } => {
                "swap the corners: from_m is the lower one on every axis".into()
            }
            SceneProblem::Rate { .. } => {
                "leave the rate out, or state one that divides servo_rate_hz".into()
            }
            SceneProblem::Instructions { .. } => {
                "give a faster clock, a larger --share or a lower servo_rate_hz, or remove surfaces"
                    .into()
            }
            SceneProblem::Bytes { textures, .. } => match textures {
                1 => "raise --budget-bytes".into(),
                _ => format!(
                    "raise --budget-bytes, or use fewer than {textures} textures: surfaces can share one"
                ),
            },
            SceneProblem::Library(error) => error.remedy(),
        }
    }
}

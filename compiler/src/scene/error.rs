//! Why a scene cannot be built.

use super::target::Target;
use crate::library::{LibraryError, manifest::CONFINED_REMEDY};
use asperity_io::{
    diagnostic::{Diagnostic, Failure},
    input::{InputProblem, Outside},
    toml_error::TomlError,
};
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
    /// What is wrong.
    pub problem: SceneProblem,
}

/// What is wrong with a scene.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SceneProblem {
    /// The file cannot be read, is too large, or is not UTF-8.
    #[error(transparent)]
    Input(#[from] InputProblem),
    /// It is not TOML, or a field is missing, unknown or of another type.
    #[error("{0}")]
    Syntax(TomlError),
    /// One table in single brackets in a list.
    #[error("one table in single brackets, where a list of tables is wanted")]
    Single(&'static str),
    /// A path that leaves the folder of a scene that may not.
    #[error("{stated:?} is {outside}, and the scene is confined to its folder")]
    Outside {
        /// The path as it is stated.
        stated: PathBuf,
        /// How it leaves.
        outside: Outside,
    },
    /// The scene has no surface.
    #[error("the scene has no surface")]
    NoSurface,
    /// More surfaces than a library holds.
    #[error("{0} surfaces, a scene holds 64")]
    TooMany(usize),
    /// More textures than a scene may list.
    #[error("{found} textures, a scene lists {limit} at most")]
    TooManyTextures {
        /// Textures of the file.
        found: usize,
        /// Textures accepted.
        limit: usize,
    },
    /// A surface wears a texture that the scene does not have.
    #[error("no texture {wanted:?}; there are {known:?}")]
    UnknownTexture {
        /// What was asked for.
        wanted: String,
        /// What there is.
        known: Vec<String>,
    },
    /// Two textures of one name.
    #[error("{0:?} is the name of two textures")]
    SameName(String),
    /// A name that an asset cannot hold.
    #[error("{0:?} is no name: 1 to 64 bytes without control characters")]
    Name(String),
    /// The texture has no source, or several.
    #[error("{0:?} needs one of `prompt`, `import` and `asset`")]
    Origin(String),
    /// A seed is given for something other than a prompt.
    #[error("only a prompt has a seed")]
    SeedWithoutPrompt,
    /// The surface has no solid, or several.
    #[error("a surface is one of `plane`, `sphere` and `box`")]
    Solid,
    /// A number out of its range.
    #[error("{value} is not in {low}..={high}")]
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
    /// A texture could not be made.
    #[error("{0}")]
    Texture(Failure),
    /// A library is given where one texture is wanted.
    #[error("{file}: a library of {count} textures, an asset of one is wanted", file = file.display())]
    ManyTextures {
        /// The library.
        file: PathBuf,
        /// Textures it holds.
        count: usize,
    },
    /// A texture cannot be converted to the rate of the servo loop.
    #[error("its models run at {from_hz} Hz and cannot be converted to {to_hz} Hz")]
    Rate {
        /// Rate of the models, Hz.
        from_hz: f64,
        /// Rate of the servo loop, Hz.
        to_hz: f64,
    },
    /// Too many instructions at every fidelity.
    #[error("{name:?} takes {least} instructions a tick at its lowest fidelity, {over} more than the budget of {budget} ({target})", over = least - budget)]
    Instructions {
        /// The texture.
        name: String,
        /// The fewest it takes.
        least: u64,
        /// What it may take.
        budget: u64,
        /// Where.
        target: Target,
    },
    /// Too many bytes at the lowest fidelities.
    #[error("the library takes {least} bytes at the lowest fidelities, {over} more than the budget of {budget}", over = least - budget)]
    Bytes {
        /// The fewest bytes.
        least: u64,
        /// What it may take.
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
            SceneProblem::Input(InputProblem::NotUtf8 { .. }) => {
                "give a scene in TOML: see the example in docs/scenes.md".into()
            }
            SceneProblem::Input(problem) => problem.remedy(),
            SceneProblem::Outside { .. } => CONFINED_REMEDY.into(),
            SceneProblem::Single(key) => format!("write [[{key}]], in two brackets, above each"),
            SceneProblem::Syntax(_) => "see the example in docs/scenes.md".into(),
            SceneProblem::NoSurface => {
                "add a [[surface]] with a texture and a plane, sphere or box".into()
            }
            SceneProblem::TooMany(_) => "split the scene".into(),
            SceneProblem::TooManyTextures { .. } => "remove textures that no surface wears".into(),
            SceneProblem::UnknownTexture { wanted, .. } => {
                format!("add a [[texture]] with name = {wanted:?}, or correct the name")
            }
            SceneProblem::SameName(_) => "rename one of them".into(),
            SceneProblem::Name(_) => "choose another name".into(),
            SceneProblem::Origin(_) => {
                "leave one of them: a prompt, a HaTT file or an asset".into()
            }
            SceneProblem::SeedWithoutPrompt => "remove the seed".into(),
            SceneProblem::Solid => {
                "leave one of them, e.g. plane = { point_m = [0, 0, 0], normal = [0, 0, 1] }".into()
            }
            SceneProblem::Value { .. } => {
                "give a number in that range; lengths are in metres".into()
            }
            SceneProblem::Region { .. } => {
                "swap the corners: from_m is the lower one on every axis".into()
            }
            SceneProblem::Texture(error) => error.remedy(),
            SceneProblem::ManyTextures { .. } => {
                "give an asset (.asp), or import its source with `import`".into()
            }
            SceneProblem::Rate { .. } => {
                "set servo_rate_hz to the rate of the texture, or 2, 3, … 20 times as much".into()
            }
            SceneProblem::Instructions { .. } => {
                "give a faster clock, a larger --share or a lower servo_rate_hz, or remove surfaces"
                    .into()
            }
            SceneProblem::Bytes { textures, .. } => {
                format!(
                    "raise --budget-bytes, or use fewer than {textures} textures: surfaces can share one"
                )
            }
            SceneProblem::Library(error) => error.remedy(),
        }
    }
}

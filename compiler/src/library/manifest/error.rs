//! Faults of a manifest, with their places.

use asperity_io::{
    diagnostic::{Diagnostic, Failure},
    input::{InputProblem, Outside},
};
use std::{fmt, path::PathBuf};
use thiserror::Error;

/// Fault of a manifest: file, line, key, reason.
#[derive(Debug, Error)]
#[error("{}{}{}{problem}", file.display(), At(*line), Key(key))]
pub struct ManifestError {
    /// The file.
    pub file: PathBuf,
    /// Line, 1-based; `None` for the file as a whole.
    pub line: Option<usize>,
    /// Path of the key, such as `blend.t`; empty for the row or the file.
    pub key: String,
    /// The fault.
    pub problem: ManifestProblem,
}

struct At(Option<usize>);

impl fmt::Display for At {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(line) => write!(f, ":{line}: "),
            None => f.write_str(": "),
        }
    }
}

struct Key<'a>(&'a str);

impl fmt::Display for Key<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            "" => Ok(()),
            key => write!(f, "{key}: "),
        }
    }
}

/// Remedy for a path that leaves the folder of its list.
pub(crate) const CONFINED_REMEDY: &str =
    "copy the file next to the manifest, or leave out --confined if you trust its author";

/// Fault of a manifest.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ManifestProblem {
    /// The file cannot be read, is too large, or is not UTF-8.
    #[error(transparent)]
    Input(#[from] InputProblem),
    /// It is not what its name says.
    #[error("{0}")]
    Syntax(String),
    /// Its name ends in nothing that is known.
    #[error("not a manifest: the name must end in .toml, .csv or .jsonl")]
    Kind,
    /// There is no texture in it.
    #[error("the manifest lists no texture")]
    Empty,
    /// More textures than a manifest may list.
    #[error("more than {0} textures")]
    TooMany(usize),
    /// A key that is not known there.
    #[error("no such key; known keys are {known}")]
    UnknownKey {
        /// Known keys.
        known: String,
        /// Suggested spelling, in words.
        suggestion: Option<String>,
    },
    /// A single table `[texture]` in place of a list of textures.
    #[error("one table in single brackets, but a list of tables is expected")]
    Single,
    /// A value of another type.
    #[error("must be {wanted}, but is {found}")]
    Type {
        /// Expected type.
        wanted: &'static str,
        /// Actual type.
        found: &'static str,
    },
    /// A value that is not accepted.
    #[error("{found:?} must be {wanted}")]
    Value {
        /// Accepted values.
        wanted: String,
        /// The value.
        found: String,
    },
    /// A name that no texture can have.
    #[error("{0:?} is not a valid name: a name has 1 to 64 bytes and no control characters")]
    Name(String),
    /// The row has no source, or several.
    #[error("{found}; a texture has one of {known}")]
    Origin {
        /// Sources found.
        found: String,
        /// Known sources.
        known: String,
    },
    /// A text that stands for none.
    #[error(
        "{text:?} is no {wanted}, but what a table has for a cell without a value, or with an error"
    )]
    Nothing {
        /// The text.
        text: String,
        /// Expected kind of text.
        wanted: &'static str,
    },
    /// A value that the source refuses.
    #[error("{0}")]
    Source(Failure),
    /// A key that does not go with the source.
    #[error("cannot be combined with {origin}")]
    Misplaced {
        /// Key of the source.
        origin: &'static str,
    },
    /// Words of an edit that ask for nothing.
    #[error(
        "{0:?} names neither a quality to change, such as rough, nor a material to be more like"
    )]
    NoChange(String),
    /// Two textures of one name.
    #[error("{name:?} is also the name of the texture at {other}")]
    SameName {
        /// The name.
        name: String,
        /// Where it stands first.
        other: String,
    },
    /// A texture that is not in the manifest.
    #[error("no texture {wanted:?} in this manifest")]
    NoSuchTexture {
        /// Its name.
        wanted: String,
        /// Suggested spelling, in words.
        suggestion: Option<String>,
    },
    /// Blends that are made of each other.
    #[error("the texture depends on itself: {0}")]
    Cycle(String),
    /// A manifest that includes itself.
    #[error("the manifest includes itself: {0}")]
    IncludeCycle(String),
    /// A manifest that is included twice.
    #[error("{0} is included twice")]
    IncludedTwice(String),
    /// More faults than are reported.
    #[error("further faults are not shown")]
    More,
    /// A path that leaves the folder of a manifest that may not.
    #[error("{stated:?} is {outside}, and the manifest is confined to its folder")]
    Outside {
        /// The path as it is stated.
        stated: String,
        /// Reason why the path is outside.
        outside: Outside,
    },
    /// A file that is not there.
    #[error("{file}: {problem}", file = file.display())]
    File {
        /// The file.
        file: PathBuf,
        /// Why.
        problem: InputProblem,
    },
}

impl Diagnostic for ManifestError {
    fn remedy(&self) -> String {
        match &self.problem {
            ManifestProblem::Input(problem) => problem.remedy(),
            ManifestProblem::Syntax(_) | ManifestProblem::Kind => {
                "see the examples in docs/libraries.md".into()
            }
            ManifestProblem::Empty => "add a [[texture]] with a name and a prompt".into(),
            ManifestProblem::TooMany(_) => {
                "split the manifest, and join the libraries with `asperity merge`".into()
            }
            ManifestProblem::More => "correct these first".into(),
            ManifestProblem::Single => {
                "write [[texture]], in two brackets, above each texture".into()
            }
            ManifestProblem::UnknownKey { suggestion, .. } => match suggestion {
                Some(suggestion) => format!("{suggestion} correct the key, or remove it"),
                None => "correct the key, or remove it".into(),
            },
            ManifestProblem::Type { .. } | ManifestProblem::Value { .. } => {
                "correct the value".into()
            }
            ManifestProblem::Name(_) => "choose another name".into(),
            ManifestProblem::Nothing { wanted, .. } => {
                format!("write a {wanted}, or remove the row")
            }
            ManifestProblem::Origin { .. } => "give every texture exactly one source".into(),
            ManifestProblem::Source(failure) => failure.remedy(),
            ManifestProblem::Misplaced { .. } => "remove the key".into(),
            ManifestProblem::NoChange(_) => {
                "describe a change, as in \"less gritty, more waxy\" or \"more like leather\""
                    .into()
            }
            ManifestProblem::SameName { .. } => "rename one of them".into(),
            ManifestProblem::NoSuchTexture { suggestion, .. } => match suggestion {
                Some(suggestion) => format!("{suggestion} add it, or correct the name"),
                None => "add it, or correct the name".into(),
            },
            ManifestProblem::Cycle(_) => "give one of them another source".into(),
            ManifestProblem::IncludeCycle(_) | ManifestProblem::IncludedTwice(_) => {
                "remove one of the includes".into()
            }
            ManifestProblem::Outside { .. } => CONFINED_REMEDY.into(),
            ManifestProblem::File { problem, .. } => problem.remedy(),
        }
    }
}

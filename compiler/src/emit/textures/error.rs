//! Why a file cannot be used as a texture.

use super::conversion::Conversion;
use asperity_formats::FormatError;
use asperity_io::{
    diagnostic::Diagnostic,
    input::{InputKind, InputProblem},
    shown::counted,
};
use std::path::PathBuf;
use thiserror::Error;

/// Why a file cannot be used as a texture.
#[derive(Debug, Error)]
#[error("{path}{texture}: {problem}", path = path.display(), texture = Named(texture.as_deref()))]
pub struct TexturesError {
    /// The file.
    pub path: PathBuf,
    /// The texture of the library at fault, where it is one.
    pub texture: Option<String>,
    /// The fault.
    pub problem: TexturesProblem,
}

struct Named<'a>(Option<&'a str>);

impl std::fmt::Display for Named<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0
            .map_or(Ok(()), |name| write!(f, ": texture {name:?}"))
    }
}

/// Fault of a file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TexturesProblem {
    /// It cannot be read, or a pipe gave too many bytes.
    #[error(transparent)]
    Input(#[from] InputProblem),
    /// Its bytes are not valid.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// It was an asset or a library before something took it for text.
    #[error("{0}")]
    Converted(Conversion),
    /// It is neither an asset nor a library.
    #[error("neither an asset (.asp) nor a library (.aspl)")]
    WrongKind,
    /// It is larger than any asset, or than a library with a scene.
    #[error("{bytes} bytes, but an asset or a library has at most {limit}", limit = InputKind::Asset.max_bytes())]
    TooLarge {
        /// Its size; of a pipe, what was read of it.
        bytes: u64,
    },
    /// The library holds several textures and none was chosen.
    #[error("the library has {count} textures, and none was chosen")]
    NoneChosen {
        /// Textures it holds.
        count: usize,
    },
    /// The library has no such texture.
    #[error("no texture {wanted:?}; the file has {}", counted(*count, "texture", "textures"))]
    NoSuchTexture {
        /// Requested name or index.
        wanted: String,
        /// Textures it holds.
        count: usize,
        /// Suggested spelling, in words.
        suggestion: Option<String>,
    },
}

impl Diagnostic for TexturesError {
    fn is_usage(&self) -> bool {
        matches!(self.problem, TexturesProblem::NoneChosen { .. })
    }

    fn remedy(&self) -> String {
        match &self.problem {
            TexturesProblem::Input(problem) => problem.remedy(),
            TexturesProblem::Format(FormatError::Version { .. }) => {
                "update asperity, or build the file again with this version".into()
            }
            TexturesProblem::Format(_) => "build the file again from its source".into(),
            TexturesProblem::Converted(Conversion::Utf16) => {
                "write it by -o FILE instead of >, or fetch it again".into()
            }
            TexturesProblem::Converted(_) => {
                "fetch it again as it was: transfer it in binary mode, and in git write `*.asp binary` and \
                 `*.aspl binary` into .gitattributes"
                    .into()
            }
            TexturesProblem::WrongKind | TexturesProblem::TooLarge { .. } => {
                "give a file that `asperity compile`, `build` or `import` wrote".into()
            }
            TexturesProblem::NoneChosen { .. } => format!(
                "choose one with --texture NAME or INDEX; `asperity list {:?}` lists them",
                self.path.display()
            ),
            TexturesProblem::NoSuchTexture { suggestion, .. } => {
                let list = format!("`asperity list {:?}`", self.path.display());
                match suggestion {
                    Some(suggestion) => format!("{suggestion} {list} lists all names"),
                    None => format!("list the names with {list}"),
                }
            }
        }
    }
}

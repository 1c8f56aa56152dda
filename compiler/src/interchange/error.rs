//! Why a texture could not be exported, or effects not be read.

use crate::views::{listen::ListenError, preview::PreviewError};
use asperity_io::{diagnostic::Diagnostic, input::InputProblem};
use std::path::PathBuf;
use thiserror::Error;

/// Why a texture could not be exported.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The strokes and taps could not be rendered.
    #[error(transparent)]
    Listen(#[from] ListenError),
    /// The clip takes longer than the format can say.
    #[error("{texture}: the clip takes {seconds:.1} s, and {format} holds {limit_s} s")]
    TooLong {
        /// Name of the texture.
        texture: String,
        /// Name of the format.
        format: &'static str,
        /// Time of the clip, s.
        seconds: f64,
        /// Maximum time of the format, s.
        limit_s: f64,
    },
    /// The pictures could not be drawn.
    #[error(transparent)]
    Preview(#[from] PreviewError),
    /// The sound could not be encoded.
    #[error("the sound cannot be encoded: {0}")]
    Wav(#[from] hound::Error),
    /// The file that was made could not be read back.
    #[error("{texture}: what was written does not read back: {problem}")]
    ReadBack {
        /// Name of the texture.
        texture: String,
        /// Description of the fault.
        problem: String,
    },
}

impl Diagnostic for ExportError {
    fn remedy(&self) -> String {
        match self {
            Self::Listen(ListenError::NoTaps { .. }) => "export strokes: leave out --taps".into(),
            Self::Listen(error) => error.remedy(),
            Self::TooLong { .. } => "give a shorter --time".into(),
            Self::Preview(error) => error.remedy(),
            Self::Wav(_) => "free memory and try again".into(),
            Self::ReadBack { .. } => "report this with the asset: it is a fault of asperity".into(),
        }
    }

    fn is_usage(&self) -> bool {
        match self {
            Self::Listen(error) => error.is_usage(),
            Self::TooLong { .. } => true,
            _ => false,
        }
    }
}

/// Why effects were refused.
#[derive(Debug, Error)]
#[error("{file}: {field}{colon}{problem}", file = file.display(), colon = if field.is_empty() { "" } else { ": " })]
pub struct EffectError {
    /// The file.
    pub file: PathBuf,
    /// JSON path of the field; empty for the file itself.
    pub field: String,
    /// The fault.
    pub problem: EffectProblem,
}

/// The JSON path of a field, and what is wrong with it.
pub(crate) type Fault = (String, EffectProblem);

/// Fault of an effect file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EffectProblem {
    /// The file cannot be read, is too large, or is not UTF-8.
    #[error(transparent)]
    Input(#[from] InputProblem),
    /// It is not JSON, or a field is missing or of another type.
    #[error("{0}")]
    Json(String),
    /// A version that is not read.
    #[error("{found}, {expected} expected")]
    Version {
        /// Version of the file.
        found: String,
        /// Supported version.
        expected: &'static str,
    },
    /// A number outside its range.
    #[error("{value}, must be {rule}")]
    Value {
        /// The number.
        value: f64,
        /// Accepted values.
        rule: String,
    },
    /// A time that lies before the one before it.
    #[error("{value} s lies before {previous} s, the time of the point before it")]
    Order {
        /// The time.
        value: f64,
        /// The one before.
        previous: f64,
    },
    /// More of something than is read.
    #[error("{found} {what}, at most {limit} are read")]
    TooMany {
        /// Name of the counted item.
        what: &'static str,
        /// Amount found.
        found: f64,
        /// Maximum amount.
        limit: f64,
    },
    /// Something that the format allows and that is not read.
    #[error("{0}")]
    Unsupported(&'static str),
    /// Neither strokes nor taps.
    #[error("it holds no effect that sounds{colon}{reasons}",
        colon = if reasons.is_empty() { "" } else { ": " }, reasons = reasons.join("; "))]
    Silent {
        /// Omissions, or reasons why the rest is silent.
        reasons: Vec<String>,
    },
    /// A name that an asset cannot hold.
    #[error("{0:?} is not a valid name: a name has 1 to 64 bytes and no control characters")]
    Name(String),
}

impl Diagnostic for EffectError {
    fn remedy(&self) -> String {
        use EffectProblem as P;
        match &self.problem {
            P::Input(problem) => problem.remedy(),
            P::Json(_) => "correct this place of the file, or export it again from its tool".into(),
            P::Version { .. } => "export it again in that version".into(),
            P::Value { .. } | P::Order { .. } => "correct the value".into(),
            P::TooMany { .. } => "cut the file into shorter effects".into(),
            P::Unsupported(_) => "export the effect again without it".into(),
            P::Silent { .. } => "give a file with a continuous effect, a transient or both".into(),
            P::Name(_) => "give another --name".into(),
        }
    }

    fn is_usage(&self) -> bool {
        matches!(self.problem, EffectProblem::Name(_))
    }
}

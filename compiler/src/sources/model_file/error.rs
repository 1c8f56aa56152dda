//! Why a model file was refused: file, field, value, remedy.

use super::schema::{FORMAT, VERSION};
use asperity_io::{diagnostic::Diagnostic, input::InputProblem};
use std::path::PathBuf;
use thiserror::Error;

/// Why a model file was refused.
#[derive(Debug, Error)]
#[error("{file}: {field}{colon}{problem}", file = file.display(), colon = if field.is_empty() { "" } else { ": " })]
pub struct ModelFileError {
    /// The file.
    pub file: PathBuf,
    /// JSON path of the field, e.g. `grid.vertices[3].lsf_rad[2]`; empty for the file itself.
    pub field: String,
    /// The fault.
    pub problem: ModelFileProblem,
}

/// The JSON path of a field, and what is wrong with it.
pub(super) type Fault = (String, ModelFileProblem);

/// Fault of a model file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ModelFileProblem {
    /// The file cannot be read, is too large, or is not UTF-8.
    #[error(transparent)]
    Input(#[from] InputProblem),
    /// It is not JSON, or a field is missing, unknown, repeated or of another type.
    #[error("{0}")]
    Json(String),
    /// It is JSON of another kind.
    #[error("{found}, but {FORMAT:?} is expected")]
    Format {
        /// Format stated by the file.
        found: String,
    },
    /// A later version, or none.
    #[error("{found}, but this program reads version {VERSION}")]
    Version {
        /// Version stated by the file.
        found: String,
    },
    /// A text that an asset cannot hold.
    #[error("{0:?} is not a valid name: a name has 1 to 64 bytes and no control characters")]
    Name(String),
    /// A text that is longer than an asset can hold.
    #[error("{bytes} bytes, but at most {limit} are accepted")]
    Text {
        /// Bytes of the text.
        bytes: usize,
        /// Bytes accepted.
        limit: usize,
    },
    /// A number outside its range.
    #[error("{value}, must be {rule}")]
    Value {
        /// The number.
        value: f64,
        /// Accepted values.
        rule: String,
    },
    /// A line spectral frequency that is no angle below π.
    #[error("{0} rad, must be above 0 and below π")]
    Frequency(f64),
    /// A line spectral frequency, or an impact speed, that is not above the one before.
    #[error("{value} is not above {previous}, the one before it")]
    Order {
        /// The number.
        value: f64,
        /// The one before.
        previous: f64,
    },
    /// A list of another length than it must have.
    #[error("{found} entries, must be {rule}")]
    Length {
        /// Entries found.
        found: usize,
        /// Required number of entries.
        rule: String,
    },
    /// A field that the numerator asks for, or has no use for.
    #[error("{0}")]
    Numerator(&'static str),
    /// All vertices lie on one line.
    #[error("all of them lie on one line, and a grid needs an area")]
    Flat,
    /// Two vertices lie at one place of the grid.
    #[error("it lies at {speed_mm_s} mm/s and {force_n} N, as grid.vertices[{first}] does")]
    SamePlace {
        /// Index of the other vertex.
        first: usize,
        /// Speed of both.
        speed_mm_s: f64,
        /// Force of both.
        force_n: f64,
    },
    /// The triangles do not tile the rectangle.
    #[error("{cause}")]
    Mesh {
        /// Fault of the triangulation.
        cause: asperity_texture::model::mesh::MeshError,
        /// True if the file states them.
        stated: bool,
    },
}

impl Diagnostic for ModelFileError {
    fn remedy(&self) -> String {
        use ModelFileProblem as P;
        match &self.problem {
            P::Input(problem) => problem.remedy(),
            P::Format { .. } => {
                "give a model file, as `--emit-model` writes it: see docs/model.md".into()
            }
            P::Json(_) => "correct this place of the file: docs/model.md lists every key".into(),
            P::Version { .. } => {
                format!("set \"version\": {VERSION}, or update asperity for a later one")
            }
            P::Name(_) => "choose another name".into(),
            P::Text { .. } => "shorten the text".into(),
            P::Value { .. } => "correct the value; its unit is in the key".into(),
            P::Frequency(_) => {
                "give frequencies in radians a sample, 2π·f / sample_rate_hz for f in Hz".into()
            }
            P::Order { .. } => "sort the list; no two entries may be equal".into(),
            P::Length { .. } => "give as many entries as that".into(),
            P::Numerator(_) => {
                "set \"numerator\" to \"none\", \"nyquist\" or \"lsf\" as the models have it".into()
            }
            P::SamePlace { .. } => "leave one of them, or move it".into(),
            P::Mesh { stated: true, .. } => {
                "triangulate the vertices so that they tile the rectangle from (0, 0), or leave \
                 triangles out"
                    .into()
            }
            P::Flat | P::Mesh { stated: false, .. } => {
                "give vertices at the four corners of the rectangle from (0, 0): edge models".into()
            }
        }
    }
}

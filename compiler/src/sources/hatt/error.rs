//! Why a HaTT file was refused: file, line, field, value, remedy.

use asperity_io::{
    diagnostic::Diagnostic,
    input::{InputProblem, NestingProblem},
};
use std::{fmt, path::PathBuf};
use thiserror::Error;

/// Why a HaTT file was refused.
#[derive(Debug, Error)]
#[error("{}: {problem}", Place { file, line: *line })]
pub struct HattError {
    /// The file.
    pub file: PathBuf,
    /// Line of the element at fault, 1-based, where there is one.
    pub line: Option<u32>,
    /// The fault.
    pub problem: Problem,
}

struct Place<'a> {
    file: &'a PathBuf,
    line: Option<u32>,
}

impl fmt::Display for Place<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        self.line.map_or(Ok(()), |line| write!(f, ":{line}"))
    }
}

/// Fault of a HaTT file. `field` is the element's name with its place, e.g. `model 3 ARlsf[7]`.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Problem {
    /// The file cannot be read, is too large, or is not UTF-8.
    #[error(transparent)]
    Input(#[from] InputProblem),
    /// More attributes, depth or namespaces than a parser takes in linear time.
    #[error(transparent)]
    Nesting(#[from] NestingProblem),
    /// A document type or entity declaration, which no material has.
    #[error("declares a document type or entities, which is refused")]
    Doctype,
    /// Not well-formed XML.
    #[error("not well-formed XML: {0}")]
    Malformed(String),
    /// Well-formed XML of another kind.
    #[error("root element is <{found}>, <modelSet> expected")]
    WrongRoot {
        /// Name of the root element.
        found: String,
    },
    /// An element is not there.
    #[error("<{field}> is missing")]
    Missing {
        /// The element.
        field: String,
    },
    /// An element that must be there once is there again.
    #[error("<{field}> appears twice")]
    Repeated {
        /// The element.
        field: String,
    },
    /// A text that is not a number.
    #[error("{field} = {value:?} is not a number")]
    NotANumber {
        /// The element.
        field: String,
        /// Its text.
        value: String,
    },
    /// A number outside its range; NaN and infinities always are.
    #[error("{field} = {value}, must be {rule}")]
    OutOfRange {
        /// The element.
        field: String,
        /// Its value.
        value: f64,
        /// The range.
        rule: String,
    },
    /// A list has another length than the file states elsewhere.
    #[error("{field}: {found} found, {expected} expected from {stated_by}")]
    Count {
        /// The list.
        field: String,
        /// Entries found.
        found: usize,
        /// Entries stated.
        expected: usize,
        /// Where it is stated.
        stated_by: &'static str,
    },
    /// There is no model.
    #[error("has no <model>")]
    NoModels,
    /// Two elements that must agree do not.
    #[error("{field} = {value}, but {other} = {other_value}")]
    Contradiction {
        /// The element.
        field: String,
        /// Its value.
        value: f64,
        /// The element it must equal.
        other: String,
        /// That element's value.
        other_value: f64,
    },
    /// A unit that the importer does not convert.
    #[error("{field} = {value:?}, {expected:?} expected")]
    Unit {
        /// The element.
        field: &'static str,
        /// Its text.
        value: String,
        /// The unit of HaTT.
        expected: &'static str,
    },
    /// A name that an asset cannot carry.
    #[error("material = {value:?}: {reason}")]
    Name {
        /// The name.
        value: String,
        /// Description of the fault.
        reason: &'static str,
    },
    /// Neither the coefficients nor the line spectral frequencies can be used.
    #[error(
        "{field}: the line spectral frequencies are {distance_db:.3} dB from the coefficients, \
         whose polynomial has roots on or outside the unit circle"
    )]
    NoUsableFilter {
        /// `model n ARcoeff` or `model n MAcoeff`.
        field: String,
        /// RMS log-spectral distance of the two, dB.
        distance_db: f64,
    },
    /// A folder without a HaTT file.
    #[error("has no .xml file")]
    EmptyFolder,
    /// Two files of a folder hold the same material.
    #[error("material {name:?} is also in {other}")]
    SameMaterial {
        /// Name of the material.
        name: String,
        /// The other file.
        other: String,
    },
}

impl Diagnostic for HattError {
    fn remedy(&self) -> String {
        match &self.problem {
            Problem::Input(problem) => problem.remedy(),
            Problem::Nesting(_) | Problem::WrongRoot { .. } => {
                "give a model file of the Penn Haptic Texture Toolkit, `Models_<name>.xml`".into()
            }
            Problem::Doctype => "remove the <!DOCTYPE …> declaration; HaTT files have none".into(),
            Problem::Malformed(_) => {
                "the file is damaged or incomplete: fetch it again from HaTT".into()
            }
            Problem::Unit { expected, .. } => format!("convert the file to {expected}"),
            Problem::Name { .. } => {
                "give <material> a name of 1 to 64 bytes without control characters".into()
            }
            Problem::EmptyFolder => {
                "give the folder that holds the `Models_<name>.xml` files".into()
            }
            Problem::SameMaterial { .. } => {
                "rename one <material>, or import the two files to different outputs".into()
            }
            Problem::NoUsableFilter { .. } => {
                "compare ARcoeff/MAcoeff and ARlsf/MAlsf of this model with the original file"
                    .into()
            }
            Problem::Missing { field } => {
                format!("add <{field}>, or fetch the file again from HaTT")
            }
            Problem::Repeated { field } => format!("keep one <{field}>"),
            Problem::NotANumber { .. } | Problem::OutOfRange { .. } | Problem::NoModels => {
                "correct the value, or fetch the file again from HaTT".into()
            }
            Problem::Count { stated_by, .. } => {
                format!("make the list and {stated_by} agree, or fetch the file again from HaTT")
            }
            Problem::Contradiction { other, .. } => {
                format!("make it agree with {other}, or fetch the file again from HaTT")
            }
        }
    }
}

//! Errors of a model folder and of the outputs of its networks.

use thiserror::Error;

/// A part of the folder that cannot be used, or that fails at work.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{part}: {problem}")]
pub struct DiffusionError {
    /// The file, relative to the folder.
    pub part: &'static str,
    /// Fault of the file.
    pub problem: Problem,
}

/// A fault of a part.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Problem {
    /// No JSON, or JSON of other types.
    #[error("{0}")]
    Json(String),
    /// A value of a configuration that is not supported.
    #[error("`{field}` is {found}, expected {expected}")]
    Field {
        /// The key.
        field: &'static str,
        /// Its value.
        found: String,
        /// Which values are supported.
        expected: String,
    },
    /// Vocabulary and merges are not those of one CLIP tokenizer.
    #[error("{0}")]
    Vocabulary(String),
    /// A network lacks an input or output.
    #[error("no {direction} `{name}`; it has {found}")]
    MissingPort {
        /// `input` or `output`.
        direction: &'static str,
        /// The name that was looked for.
        name: &'static str,
        /// Those that exist.
        found: String,
    },
    /// An input or output of another type or shape.
    #[error("{direction} `{name}` is {found}, expected {expected}")]
    Port {
        /// `input` or `output`.
        direction: &'static str,
        /// Its name.
        name: String,
        /// Type and shape that it has.
        found: String,
        /// Type and shape that it should have.
        expected: String,
    },
    /// A network that needs more than Stable Diffusion 1 and 2 give it.
    #[error("input `{name}` is none of {expected}")]
    ExtraInput {
        /// Its name.
        name: String,
        /// The inputs that are given.
        expected: &'static str,
    },
    /// Text encoder and UNet are of different models.
    #[error(
        "input `{name}` takes vectors of {expected}, and text_encoder/model.onnx gives {found}"
    )]
    Width {
        /// The UNet's input.
        name: &'static str,
        /// Width that the UNet takes.
        expected: usize,
        /// Width that the text encoder gives.
        found: usize,
    },
    /// A network fails.
    #[error("{0}")]
    Run(String),
    /// A network gives NaN or infinity.
    #[error("output `{name}` holds {value} {when}")]
    NotFinite {
        /// The output.
        name: String,
        /// `NaN` or an infinity.
        value: String,
        /// When: `at step 3 of 30`.
        when: String,
    },
    /// More steps than the schedule has.
    #[error("{steps} steps, and its schedule has room for {most}")]
    Steps {
        /// Steps asked for.
        steps: usize,
        /// The most that it takes.
        most: usize,
    },
}

impl Problem {
    /// The error of a part.
    #[must_use]
    pub fn of(self, part: &'static str) -> DiffusionError {
        DiffusionError {
            part,
            problem: self,
        }
    }
}

impl DiffusionError {
    /// Returns the remedy: a step for the user, in one sentence.
    #[must_use]
    pub fn remedy(&self) -> String {
        match &self.problem {
            Problem::Json(_) | Problem::Vocabulary(_) => {
                "copy the file of the same model again, as its exporter wrote it".into()
            }
            Problem::Field { .. } | Problem::ExtraInput { .. } => {
                "export Stable Diffusion 1 or 2, such as Stable Diffusion 2 base".into()
            }
            Problem::MissingPort { .. } | Problem::Port { .. } => {
                "export the folder with `optimum-cli export onnx`, which names the ports so".into()
            }
            Problem::Width { .. } => {
                "take text encoder and UNet from one export: they are of different models".into()
            }
            Problem::Run(_) => "export the folder again, and run it on ONNX Runtime".into(),
            Problem::NotFinite { .. } => {
                "export the folder in float32: networks in half precision can overflow".into()
            }
            Problem::Steps { most, .. } => format!("give at most {most} steps"),
        }
    }
}

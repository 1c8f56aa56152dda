//! Why a model did not become an asset.

use crate::{
    emit::{lower::LowerError, verify::VerifyError},
    passes::rerate,
};
use asperity_io::diagnostic::{Diagnostic, Fault};
use thiserror::Error;

/// The pass that failed, and why.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PipelineError {
    /// The models cannot be converted to the rate.
    #[error("--rate {0} Hz: must be {min} to {max} Hz", min = rerate::RATE_RANGE_HZ.0, max = rerate::RATE_RANGE_HZ.1)]
    Rate(f64),
    /// The models cannot be converted to the rate of the servo loop.
    #[error("the AR models run at {from_hz} Hz and cannot be converted to {to_hz} Hz")]
    ServoRate {
        /// Rate of the models, Hz.
        from_hz: f64,
        /// Rate of the servo loop, Hz.
        to_hz: f64,
    },
    /// A vertex of the asset is too far from the model that it came from.
    #[error(
        "model {model} is {distance_db:.3} dB from its source, and at most {budget_db} dB is accepted"
    )]
    Budget {
        /// Number of the model in its file, from 1.
        model: usize,
        /// RMS log-spectral distance, dB.
        distance_db: f64,
        /// The largest that is accepted, dB.
        budget_db: f64,
    },
    /// The preview cannot be drawn.
    #[error(transparent)]
    Preview(#[from] Fault),
    /// The texture does not fit an asset.
    #[error(transparent)]
    Lower(#[from] LowerError),
    /// The runtime would not render the asset faithfully.
    #[error(transparent)]
    Verify(#[from] VerifyError),
}

impl PipelineError {
    /// Returns true if the texture rings without bound in motion, which stabilising mends.
    #[must_use]
    pub fn rings(&self) -> bool {
        use VerifyError::{Tick, Unstable};
        matches!(self, Self::Verify(Tick { .. } | Unstable { .. }))
    }
}

impl Diagnostic for PipelineError {
    fn remedy(&self) -> String {
        match self {
            Self::Rate(_) => "give the rate of the servo loop, e.g. --rate 1000".into(),
            Self::ServoRate { .. } => {
                "set servo_rate_hz to the rate of the texture, or 2, 3, … 20 times as much".into()
            }
            Self::Budget { .. } => {
                "compare coefficients, variance and gain of this model with the original file"
                    .into()
            }
            Self::Preview(error) => error.remedy(),
            Self::Lower(error) => error.remedy(),
            Self::Verify(error) => error.remedy(),
        }
    }

    fn is_usage(&self) -> bool {
        matches!(self, Self::Rate(_))
    }
}

impl From<PipelineError> for Fault {
    fn from(error: PipelineError) -> Self {
        Self::of(&error)
    }
}

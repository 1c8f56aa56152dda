//! Why an asset is not fit to be written.

use asperity_formats::FormatError;
use asperity_io::diagnostic::Diagnostic;
use asperity_runtime::{ConfigError, LoadError};
use thiserror::Error;

/// Why an asset is not fit to be written.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// A reader rejects the bytes.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The runtime's slot refuses the texture.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// The servo rate is none the runtime can have.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// Weights that are not convex, or a vertex that is not there.
    #[error(
        "at {speed_mm_s} mm/s and {force_n} N the weights are {weights:?} of vertices {vertices:?}"
    )]
    Weights {
        /// Speed of the query.
        speed_mm_s: f32,
        /// Force of the query.
        force_n: f32,
        /// Vertices found.
        vertices: [u8; 3],
        /// Weights found.
        weights: [f32; 3],
    },
    /// A filter that is not finite or has a pole on or outside the unit circle.
    #[error("at {speed_mm_s} mm/s and {force_n} N the filter is not stable")]
    Unstable {
        /// Speed of the query.
        speed_mm_s: f32,
        /// Force of the query.
        force_n: f32,
    },
    /// A vertex whose rendered spectrum is too far from its model's.
    #[error("vertex {vertex} is rendered {distance_db:.3} dB from its model, {budget_db} at most")]
    Spectrum {
        /// Index of the vertex.
        vertex: usize,
        /// RMS log-spectral distance, dB.
        distance_db: f64,
        /// Maximum distance, dB.
        budget_db: f64,
    },
    /// A tick that left the limits, or clamped the vibration.
    #[error("tick {tick} of the scripted run: {what}")]
    Tick {
        /// Index of the tick.
        tick: usize,
        /// Description of the fault.
        what: &'static str,
    },
}

impl Diagnostic for VerifyError {
    fn remedy(&self) -> String {
        match self {
            Self::Format(_) | Self::Load(_) | Self::Config(_) => {
                "bring the source within the limits of a texture".into()
            }
            Self::Weights { .. } => "triangulate the source anew around this point".into(),
            Self::Unstable { .. } => "widen the resonances of the models around this point".into(),
            Self::Spectrum { .. } => {
                "keep vertices apart and resonances wide enough for single precision".into()
            }
            Self::Tick { .. } => "lower the gains or the level of the source".into(),
        }
    }
}

//! Errors of running and reporting a session.

use asperity_io::diagnostic::Diagnostic;
use asperity_runtime::LoadError;

/// Why a session could not be run or reported.
#[derive(Debug, thiserror::Error)]
pub enum FeelError {
    /// The texture does not fit the slot or the servo rate.
    #[error("the texture cannot be loaded: {0}")]
    Load(#[from] LoadError),
    /// No renderer can serve the device.
    #[error("the device cannot be served: {0}")]
    Config(#[from] asperity_runtime::ConfigError),
    /// The sheet could not be drawn.
    #[error(transparent)]
    Plot(#[from] asperity_plot::PlotError),
    /// The sound could not be encoded.
    #[error("cannot encode the sound as WAV: {0}")]
    Wav(#[from] hound::Error),
    /// The table could not be encoded.
    #[error("cannot encode the table as CSV: {0}")]
    Csv(#[from] ::csv::Error),
    /// The Fourier transform failed.
    #[error("cannot transform the vibration: {0}")]
    Transform(#[from] realfft::FftError),
}

impl Diagnostic for FeelError {
    fn remedy(&self) -> String {
        match self {
            Self::Load(LoadError::Rate { model_hz, .. }) => format!(
                "set `timing.servo_rate_hz = {model_hz}`, or 2, 3, … 20 times as much, in the device file, or compile the texture for the rate of the device"
            ),
            Self::Load(_) => {
                "compile the texture again with fewer vertices or a lower order".into()
            }
            Self::Config(_) => "change the value in the device file".into(),
            Self::Plot(_) | Self::Wav(_) | Self::Csv(_) | Self::Transform(_) => {
                "run again with fewer --seconds".into()
            }
        }
    }
}

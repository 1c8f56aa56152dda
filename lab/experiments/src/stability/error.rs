//! Errors of the table and its pictures.

use asperity_io::diagnostic::Diagnostic;
use asperity_plot::PlotError;

/// Why the table or a picture could not be made.
#[derive(Debug, thiserror::Error)]
pub enum StabilityError {
    /// A HaTT folder was refused.
    #[error(transparent)]
    Hatt(#[from] asperity_io::diagnostic::Fault),
    /// A HaTT material could not be imported.
    #[error("{0}")]
    Import(asperity::driver::Failure),
    /// A built-in file was refused.
    #[error(transparent)]
    Config(#[from] asperity_sim::config::ConfigError),
    /// A texture could not be lowered.
    #[error(transparent)]
    Lower(#[from] asperity::emit::lower::LowerError),
    /// A picture could not be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
}

impl Diagnostic for StabilityError {
    fn remedy(&self) -> String {
        match self {
            Self::Hatt(error) => error.remedy(),
            Self::Import(error) => error.remedy(),
            Self::Config(error) => error.remedy(),
            Self::Lower(error) => error.remedy(),
            Self::Plot(_) => "report this as a bug".into(),
        }
    }
}

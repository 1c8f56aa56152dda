//! Largest, mean and RMS of a list of errors.

use serde::Serialize;

/// An error over the vertices, dB.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct ErrorSummary {
    /// Largest.
    pub max_db: f64,
    /// Mean.
    pub mean_db: f64,
    /// Root of the mean square.
    pub rms_db: f64,
}

impl ErrorSummary {
    /// The summary of a list of errors; zero for an empty list.
    #[must_use]
    pub fn of(errors_db: &[f64]) -> Self {
        let count = errors_db.len().max(1) as f64;
        Self {
            max_db: errors_db.iter().copied().fold(0.0, f64::max),
            mean_db: errors_db.iter().sum::<f64>() / count,
            rms_db: (errors_db.iter().map(|e| e * e).sum::<f64>() / count).sqrt(),
        }
    }
}

//! The level of a sampled signal.

/// Root mean square; 0 for an empty signal.
pub(crate) fn rms(signal: &[f64]) -> f64 {
    let squares: f64 = signal.iter().map(|x| x * x).sum();
    (squares / signal.len().max(1) as f64).sqrt()
}

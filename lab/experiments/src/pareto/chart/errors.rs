//! The axis of errors, and the budget on it.

use crate::pareto::statistics::Spread;
use crate::pareto::summary::VariantSummary;
use asperity_plot::{Axis, Stroke, ink};

/// The range in which errors are drawn, dB. Errors outside it are drawn on its edge.
const ERROR_RANGE_DB: (f64, f64) = (0.002, 20.0);
/// The line of the perceptual budget.
pub(super) const BUDGET: Stroke = Stroke::new(ink::VERMILION, 2.5).dashed();

/// The larger of two 95th percentiles: the error at rest and the error in motion, dB.
pub(super) fn larger_error(summary: &VariantSummary) -> f64 {
    let p95 = |spread: Option<Spread>| spread.map_or(f64::INFINITY, |s| s.p95);
    within(p95(summary.distortion_db).max(p95(summary.moving_level_db)))
}

/// An error, moved into the range that is drawn.
pub(super) fn within(error_db: f64) -> f64 {
    error_db.clamp(ERROR_RANGE_DB.0, ERROR_RANGE_DB.1)
}

/// The axis of errors.
pub(super) fn error_axis(label: &str) -> Axis {
    Axis::log(label, ERROR_RANGE_DB.0, 1.3 * ERROR_RANGE_DB.1)
}

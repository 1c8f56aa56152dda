//! The point of a design.

use crate::pareto::summary::VariantSummary;
use asperity_kernels::design::Factor;
use asperity_plot::{Canvas, Color, Marker, Panel, Stroke, ink};

/// Colour of a factor's points.
pub(super) fn color(index: usize) -> Color {
    pub(super) const MORE: [Color; 2] = [Color::rgb(120, 94, 40), Color::rgb(60, 60, 150)];
    match index {
        0..6 => ink::category(index),
        _ => MORE[index % 2],
    }
}

/// Draws a design's point at a cost and an error.
pub(super) fn mark(canvas: &mut Canvas, panel: &Panel, at: (f64, f64), summary: &VariantSummary) {
    let index = Factor::VARIED
        .iter()
        .position(|f| *f == summary.variant.factor);
    let (marker, radius, fill, outline) = match index {
        None => (Marker::Diamond, 12.0, Some(ink::BLACK), None),
        Some(_) if summary.unstable > 0.0 => (
            Marker::Cross,
            10.0,
            None,
            Some(Stroke::new(ink::VERMILION, 3.0)),
        ),
        Some(index) => (Marker::Circle, 8.0, Some(color(index)), None),
    };
    panel.points(canvas, [at], marker, radius, fill, outline);
}

//! The point of a design, and its key in a legend.

use crate::pareto::summary::VariantSummary;
use asperity_kernels::design::Factor;
use asperity_plot::{Canvas, Color, Key, Marker, Panel, Stroke, ink};

/// The default among all other designs.
pub(super) const DEFAULT: Key = Key::Point(Marker::Diamond, 12.0, Some(ink::BLACK), None);
/// A design that is not stable everywhere.
pub(super) const UNSTABLE: Key = Key::Point(
    Marker::Cross,
    10.0,
    None,
    Some(Stroke::new(ink::VERMILION, 3.0)),
);

/// The point of a factor's designs: a colour and, in grey, a shape of its own.
pub(super) fn of_factor(index: usize) -> Key {
    const MORE: [Color; 2] = [Color::rgb(120, 94, 40), Color::rgb(60, 60, 150)];
    const SHAPES: [Marker; 3] = [Marker::Circle, Marker::Square, Marker::Triangle];
    let color = match index {
        0..6 => ink::category(index),
        _ => MORE[index % 2],
    };
    let shape = SHAPES[index % 3];
    match index / 3 {
        0 => Key::Point(shape, 8.0, Some(color), None),
        1 => Key::Point(shape, 7.0, Some(ink::PAPER), Some(Stroke::new(color, 3.5))),
        _ => Key::Point(
            Marker::Diamond,
            7.0,
            [Some(color), Some(ink::PAPER)][index % 2],
            Some(Stroke::new(color, 3.0)),
        ),
    }
}

/// Draws a design's point at a cost and an error.
pub(super) fn mark(canvas: &mut Canvas, panel: &Panel, at: (f64, f64), summary: &VariantSummary) {
    let index = Factor::VARIED
        .iter()
        .position(|f| *f == summary.variant.factor);
    let key = match index {
        None => DEFAULT,
        Some(_) if summary.unstable > 0.0 => UNSTABLE,
        Some(index) => of_factor(index),
    };
    panel.keyed(canvas, [at], key);
}

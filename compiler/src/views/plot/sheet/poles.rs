//! Poles and zeros on the upper half of the z plane.

use std::f64::consts::PI;

use super::distinct::distinct_models;
use super::layout::margins;
use super::level::{level, level_scale};
use crate::views::plot::roots::roots_of;
use asperity_plot::{
    Align, Axis, Canvas, Color, Key, Marker, Panel, Rect, Stroke, TextStyle, VAlign, ink, legend,
    size,
};
use asperity_texture::model::{ModelGrid, Numerator};
use asperity_texture::signal::spectrum::ArmaModel;

/// Half the width of the picture, in radii of the unit circle. It leaves room for frequencies.
const REACH: f64 = 1.13;
const POLE_RADIUS: f32 = 7.5;
const ZERO_RADIUS: f32 = 7.0;

pub(super) fn draw(canvas: &mut Canvas, rect: Rect, grid: &ModelGrid) {
    let panel = frame(rect);
    panel.draw_frame(canvas);
    draw_circle(canvas, &panel, grid.sample_rate_hz);

    let scale = level_scale(&grid.vertices);
    let mut models = distinct_models(grid);
    models.sort_by(|a, b| level(a).total_cmp(&level(b)));

    // Rounding may put a real root slightly below the axis.
    let upper = |coefficients: &[f64]| -> Vec<(f64, f64)> {
        roots_of(coefficients)
            .into_iter()
            .filter(|root| root.im > -1e-6)
            .map(|root| (root.re, root.im))
            .collect()
    };
    let mut largest_radius = 0.0_f64;
    for vertex in &models {
        let model = ArmaModel::at_vertex(grid, vertex);
        let color = scale.color(level(vertex));
        let outline = Some(zero_stroke(color));
        panel.points(
            canvas,
            upper(&model.b),
            Marker::Circle,
            ZERO_RADIUS,
            None,
            outline,
        );
    }
    for vertex in &models {
        let poles = upper(&ArmaModel::at_vertex(grid, vertex).a);
        largest_radius = poles
            .iter()
            .map(|(re, im)| re.hypot(*im))
            .fold(largest_radius, f64::max);
        let color = scale.color(level(vertex));
        panel.points(
            canvas,
            poles,
            Marker::Circle,
            POLE_RADIUS,
            Some(color),
            Some(pole_rim()),
        );
    }

    let dark = scale.map.at(0.3);
    let pole = Key::Point(Marker::Circle, POLE_RADIUS, Some(dark), None);
    let zero = Key::Point(Marker::Circle, ZERO_RADIUS, None, Some(zero_stroke(dark)));
    let radius = format!("largest pole radius {largest_radius:.3}");
    let mut entries = vec![(pole, "poles")];
    if grid.numerator != Numerator::None {
        entries.push((zero, "zeros"));
    }
    entries.extend([
        (Key::Text, radius.as_str()),
        (Key::Text, "conjugates omitted"),
    ]);
    let area = panel.area();
    legend(
        canvas,
        (area.x, area.y - 26.0),
        panel.outer.right(),
        &entries,
    );
    panel.colorbar(canvas, &scale, "Level, gain·σ (m/s²)");
}

fn pole_rim() -> Stroke {
    Stroke::new(ink::PAPER, 1.2)
}

fn zero_stroke(color: Color) -> Stroke {
    Stroke::new(color, 2.2)
}

/// A frame with the same scale on both axes.
fn frame(rect: Rect) -> Panel {
    let x = Axis::new("Re z", -REACH, REACH);
    let mut panel = Panel::new(rect, x, Axis::new("Im z", 0.0, 1.0))
        .letter('a')
        .title("Poles and zeros of the distinct models")
        .margins(margins(160.0))
        .without_grid();
    let area = panel.area();
    let height = 2.0 * REACH * f64::from(area.height / area.width);
    let foot = -(height - 1.13).max(0.12);
    panel.y = Axis::new("Im z", foot, foot + height);
    panel
}

/// The unit circle with frequencies, and circles of smaller radius.
fn draw_circle(canvas: &mut Canvas, panel: &Panel, sample_rate_hz: f64) {
    let arc = |radius: f64| {
        (0..=360).map(move |step| {
            let angle = PI * f64::from(step) / 360.0;
            (radius * angle.cos(), radius * angle.sin())
        })
    };
    let faint = Stroke::new(ink::GRID, 1.5);
    for tenth in [2, 4, 6, 8] {
        panel.line(canvas, arc(f64::from(tenth) / 10.0), faint);
    }
    let text = TextStyle::new(size::TICK).color(ink::GREY);
    let frequencies = Axis::new("", 0.0, 0.5 * sample_rate_hz).ticks_about(10);
    for (freq_hz, label) in frequencies.ticks() {
        let angle = PI * frequencies.fraction(freq_hz);
        let (x, y) = (angle.cos(), angle.sin());
        panel.line(canvas, [(0.2 * x, 0.2 * y), (x, y)], faint);
        let tick = Stroke::new(ink::BLACK, size::FRAME);
        panel.line(canvas, [(x, y), (1.015 * x, 1.015 * y)], tick);
        // Both ends of the half circle lie on the real axis; their labels stand below it.
        let (px, py) = if y < 0.02 {
            panel.position(x, -0.06)
        } else {
            panel.position(1.07 * x, 1.055 * y)
        };
        let label = if freq_hz == 0.0 {
            "0 Hz".to_owned()
        } else {
            label
        };
        canvas.text(&label, (px, py), &text.align(Align::Center, VAlign::Middle));
    }
    panel.horizontal_line(canvas, 0.0, Stroke::new(ink::LIGHT, 1.5));
    panel.line(canvas, arc(1.0), Stroke::new(ink::BLACK, 2.0));
}

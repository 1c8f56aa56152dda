//! What became of it: spectra, how the grid was chosen, how sure it is.

use crate::sources::recording::{grid::Tried, sheet::Shown};
use asperity_plot::{Axis, Canvas, Key, Marker, Panel, Rect, Stroke, ink, legend};
use asperity_recording::steady::frequencies_hz;
use asperity_texture::model::mixture::Field;

/// The mean spectrum of slow or fast segments, and what the grid renders there.
pub(super) fn spectra(canvas: &mut Canvas, rect: Rect, import: &Shown<'_>, part: usize) {
    let mut segments: Vec<_> = import.analysis.steady.segments.iter().collect();
    segments.sort_by(|a, b| a.speed_mm_s.total_cmp(&b.speed_mm_s));
    let third = segments.len().div_ceil(3);
    let chosen = if part == 0 {
        &segments[..third]
    } else {
        &segments[segments.len() - third..]
    };
    let count = chosen.len().max(1) as f64;
    let freqs = frequencies_hz();
    let db = |power: f64| 10.0 * libm::log10(power.max(1e-12));
    // Neighbouring frequencies are averaged: a picture, not a measure.
    let smooth = |values: Vec<f64>| -> Vec<f64> {
        values
            .chunks(4)
            .map(|c| c.iter().sum::<f64>() / c.len() as f64)
            .collect()
    };
    let mean = |pick: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
        let values = smooth((0..freqs.len()).map(pick).collect());
        values
            .into_iter()
            .enumerate()
            .map(|(n, p)| (freqs[(4 * n + 2).min(freqs.len() - 1)], db(p)))
            .collect()
    };
    let measured = mean(&|n| chosen.iter().map(|s| s.power[n]).sum::<f64>() / count);
    let field = Field::new(&import.whole.grid);
    let models: Vec<_> = chosen
        .iter()
        .filter_map(|s| Some(field.model(&field.locate(s.speed_mm_s, s.force_n)?)))
        .collect();
    let model = mean(&|n| {
        models.iter().map(|m| m.power(freqs[n])).sum::<f64>() / models.len().max(1) as f64
    });
    let noise = import
        .analysis
        .steady
        .noise_power
        .as_ref()
        .map(|noise| mean(&|n| noise[n]));
    let values = measured.iter().chain(&model).map(|p| p.1);
    let title = if part == 0 {
        "Spectrum of the slowest third"
    } else {
        "Spectrum of the fastest third"
    };
    let panel = Panel::new(
        rect,
        Axis::new("Frequency (Hz)", 0.0, 500.0),
        Axis::covering("Power (dB re 1 (m/s²)²)", values),
    )
    .letter(if part == 0 { 'd' } else { 'e' })
    .title(title);
    panel.draw_frame(canvas);
    panel.line(
        canvas,
        measured.iter().copied(),
        Stroke::new(ink::GREY, 2.0),
    );
    if let Some(noise) = noise {
        panel.line(canvas, noise.iter().copied(), Stroke::new(ink::LIGHT, 2.0));
    }
    panel.line(
        canvas,
        model.iter().copied(),
        Stroke::new(ink::VERMILION, 3.0),
    );
    let area = panel.area();
    let keys = [
        (Key::Line(Stroke::new(ink::GREY, 2.0)), "recorded"),
        (Key::Line(Stroke::new(ink::VERMILION, 3.0)), "texture"),
        (Key::Line(Stroke::new(ink::LIGHT, 2.0)), "sensor in the air"),
    ];
    legend(
        canvas,
        (area.x + area.width - 260.0, area.y + 24.0),
        area.x + area.width,
        &keys,
    );
}

/// Held-out error over the number of vertices, and over the AR order.
pub(super) fn held_out(canvas: &mut Canvas, rect: Rect, import: &Shown<'_>) {
    let fit = &import.analysis.fit;
    let chosen = fit.chosen;
    let least = fit
        .tried
        .iter()
        .map(|t| t.held_out)
        .fold(f64::INFINITY, f64::min);
    let finite = |t: &&Tried| t.held_out.is_finite();
    let mut by_count: Vec<(f64, f64)> = fit
        .tried
        .iter()
        .filter(finite)
        .filter(|t| {
            t.order == chosen.order
                && t.width == chosen.width
                && t.nyquist_zero == chosen.nyquist_zero
        })
        .map(|t| (t.vertices as f64, t.held_out - least))
        .collect();
    by_count.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut by_order: Vec<(f64, f64)> = fit
        .tried
        .iter()
        .filter(finite)
        .filter(|t| t.nyquist_zero == chosen.nyquist_zero)
        .map(|t| (t.order as f64, t.held_out - least))
        .collect();
    by_order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    by_order.dedup_by_key(|p| p.0 as usize);
    let values = by_count.iter().chain(&by_order).map(|p| p.1).chain([0.0]);
    let panel = Panel::new(
        rect,
        Axis::new("Vertices, or AR order", 0.0, 26.0),
        Axis::covering("Held-out excess (nats)", values),
    )
    .letter('f')
    .title("How vertices and order were chosen");
    panel.draw_frame(canvas);
    for (points, color, marker) in [
        (&by_count, ink::BLUE, Marker::Circle),
        (&by_order, ink::VERMILION, Marker::Diamond),
    ] {
        panel.line(canvas, points.iter().copied(), Stroke::new(color, 2.0));
        panel.points(
            canvas,
            points.iter().copied(),
            marker,
            7.0,
            Some(color),
            None,
        );
    }
    let area = panel.area();
    let keys = [
        (Key::Line(Stroke::new(ink::BLUE, 2.0)), "vertices"),
        (Key::Line(Stroke::new(ink::VERMILION, 2.0)), "AR order"),
    ];
    legend(
        canvas,
        (area.x + area.width - 180.0, area.y + 24.0),
        area.x + area.width,
        &keys,
    );
}

/// Seconds behind each vertex, and how far its residual is from white.
pub(super) fn uncertainty(canvas: &mut Canvas, rect: Rect, import: &Shown<'_>) {
    let facts = &import.analysis.fit.facts;
    let panel = Panel::new(
        rect,
        Axis::covering(
            "Seconds behind a vertex",
            facts.iter().map(|v| v.seconds).chain([0.0]),
        ),
        Axis::covering(
            "Residual over eight bands (dB RMS)",
            facts.iter().map(|v| v.residual_db).chain([0.0]),
        ),
    )
    .letter('i')
    .title("How sure each vertex is");
    panel.draw_frame(canvas);
    let points: Vec<(f64, f64)> = facts.iter().map(|v| (v.seconds, v.residual_db)).collect();
    panel.points(
        canvas,
        points,
        Marker::Circle,
        9.0,
        None,
        Some(Stroke::new(ink::VERMILION, 3.0)),
    );
}

//! Model panels: spectra, choice of the grid, uncertainty.

use crate::sources::recording::sheet::Shown;
use asperity_plot::{Axis, Canvas, Key, Marker, Panel, Rect, Stroke, ink};
use asperity_recording::segments::frequencies_hz;
use asperity_texture::model::mixture::Field;

/// The mean spectrum of slow or fast segments, and what the grid renders there.
pub(super) fn spectra(canvas: &mut Canvas, rect: Rect, import: &Shown<'_>, part: usize) {
    let mut segments: Vec<_> = import.analysis.strokes.segments.iter().collect();
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
        .strokes
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
    .title(title)
    .with_legend(1);
    panel.draw_frame(canvas);
    let recorded = Stroke::new(ink::GREY, 2.0);
    let rendered = Stroke::new(ink::VERMILION, 3.0);
    let sensor = Stroke::new(ink::GREY, 2.0).dotted();
    let mut keys = vec![
        (Key::Line(recorded), "recorded"),
        (Key::Line(rendered), "texture"),
    ];
    panel.line(canvas, measured, recorded);
    if let Some(noise) = noise {
        panel.line(canvas, noise, sensor);
        keys.push((Key::Line(sensor), "sensor in the air"));
    }
    panel.line(canvas, model, rendered);
    panel.legend(canvas, &keys);
}

/// Held-out error over the AR order.
pub(super) fn held_out(canvas: &mut Canvas, rect: Rect, import: &Shown<'_>) {
    let fit = &import.analysis.fit;
    let tried = fit.tried.iter().filter(|t| t.held_out.is_finite());
    let least = tried
        .clone()
        .map(|t| t.held_out)
        .fold(f64::INFINITY, f64::min);
    let mut by_order: Vec<(f64, f64)> = tried
        .filter(|t| t.nyquist_zero == fit.chosen.nyquist_zero)
        .map(|t| (t.order as f64, t.held_out - least))
        .collect();
    by_order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    by_order.dedup_by_key(|p| p.0 as usize);
    let panel = Panel::new(
        rect,
        Axis::new("AR order", 0.0, 26.0),
        Axis::covering(
            "Held-out excess (nats)",
            by_order.iter().map(|p| p.1).chain([0.0]),
        ),
    )
    .letter('f')
    .title("How the AR order was chosen");
    panel.draw_frame(canvas);
    let stroke = Stroke::category(0, 2.0);
    let (marker, fill) = (Marker::category(0), Some(stroke.color));
    panel.line(canvas, by_order.iter().copied(), stroke);
    panel.points(canvas, by_order, marker, 7.0, fill, None);
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

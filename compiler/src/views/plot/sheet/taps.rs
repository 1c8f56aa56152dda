//! The tap bank: traces in time, and their peaks against impact speed.

use super::layout::margins;
use asperity_plot::{
    Align, Axis, Canvas, ColorMap, ColorScale, Key, Marker, Panel, Rect, Stroke, TextStyle, VAlign,
    ink, legend, size,
};
use asperity_texture::model::{TapBank, TapTrace};

const PEAKS_WIDTH: f32 = 228.0;
const GAP: f32 = 40.0;

pub(super) fn draw(canvas: &mut Canvas, rect: Rect, taps: &TapBank, synthetic: bool) {
    if taps.traces.is_empty() {
        draw_absence(canvas, rect);
        return;
    }
    let sample_ms = 1000.0 / taps.sample_rate_hz;
    let samples = taps
        .traces
        .iter()
        .map(|trace| trace.accel_m_s2.len())
        .max()
        .unwrap_or(0);
    let fastest = taps
        .traces
        .iter()
        .map(|trace| trace.speed_m_s)
        .fold(0.0, f64::max);
    let scale = ColorScale::new(ColorMap::Plasma, 0.0, fastest);
    let accels = taps.traces.iter().flat_map(|trace| &trace.accel_m_s2);
    let y = Axis::covering("Acceleration (m/s²)", accels.copied().chain([0.0])).ticks_about(8);

    let mut room = margins(24.0);
    let duration_ms = sample_ms * samples.saturating_sub(1) as f64;
    room.right = 24.0 + PEAKS_WIDTH + GAP;
    let mut traces = traces_frame(rect, duration_ms, y.clone()).margins(room);
    traces.x.tick_count = 5;
    traces.draw_frame(canvas);
    let area = traces.area();
    traces.horizontal_line(canvas, 0.0, Stroke::new(ink::LIGHT, 1.5));
    // Slow taps are drawn over fast ones, so that the smaller ones stay visible.
    for trace in taps.traces.iter().rev() {
        let stroke = Stroke::new(scale.color(trace.speed_m_s), size::LINE);
        traces.series(canvas, 0.0, sample_ms, &trace.accel_m_s2, stroke);
    }
    if synthetic {
        let note = [(Key::Text, "synthesised, not recorded")];
        legend(canvas, (area.x, area.y - 26.0), area.right(), &note);
    }

    let mut beside = room;
    beside.left = 0.0;
    beside.right = 0.0;
    let outer = Rect::new(area.right() + GAP, rect.y, PEAKS_WIDTH, rect.height);
    let speeds = Axis::new("Impact speed (m/s)", 0.0, 1.08 * fastest).ticks_about(4);
    let mut peaks = Panel::new(outer, speeds, y.unnumbered()).margins(beside);
    peaks.y.label.clear();
    peaks.draw_frame(canvas);
    peaks.horizontal_line(canvas, 0.0, Stroke::new(ink::LIGHT, 1.5));
    let points = || {
        taps.traces
            .iter()
            .map(|trace| (trace.speed_m_s, peak(trace)))
    };
    peaks.line(canvas, points(), Stroke::new(ink::LIGHT, 2.0));
    for (speed_m_s, peak) in points() {
        let fill = Some(scale.color(speed_m_s));
        peaks.points(canvas, [(speed_m_s, peak)], Marker::Circle, 8.0, fill, None);
    }
    let area = peaks.area();
    let key = [(Key::Text, "peaks, colour key")];
    legend(canvas, (area.x, area.y - 26.0), rect.right(), &key);
}

/// The frame of the traces.
fn traces_frame(rect: Rect, duration_ms: f64, y: Axis) -> Panel {
    Panel::new(rect, Axis::new("Time (ms)", 0.0, duration_ms), y)
        .letter('c')
        .title("Tap bank")
}

/// An empty frame with the reason.
fn draw_absence(canvas: &mut Canvas, rect: Rect) {
    let y = Axis::new("Acceleration (m/s²)", -1.0, 1.0);
    let panel = traces_frame(rect, 10.0, y).margins(margins(24.0));
    panel.draw_frame(canvas);
    let style = TextStyle::new(size::LABEL)
        .color(ink::GREY)
        .align(Align::Center, VAlign::Middle);
    canvas.text("no taps", panel.area().center(), &style);
}

/// The sample of largest magnitude, with its sign.
fn peak(trace: &TapTrace) -> f64 {
    trace.accel_m_s2.iter().copied().fold(
        0.0,
        |peak: f64, a| if a.abs() > peak.abs() { a } else { peak },
    )
}

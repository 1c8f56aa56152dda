//! Hand panels: motion, coverage, friction, taps.

use super::Shown;
use asperity_plot::{
    Axis, Canvas, ColorMap, ColorScale, Key, Marker, Panel, Rect, Stroke, ink, size,
};
use asperity_recording::{impact::TAP_RATE_HZ, timeline::RATE_HZ};

/// Points of a drawn time series.
const DRAWN: usize = 2400;

/// Speed and load over time, with the segments that were used.
pub(super) fn motion(canvas: &mut Canvas, rect: Rect, import: &Shown<'_>) {
    let timeline = &import.analysis.timeline;
    let seconds = timeline.len() as f64 / RATE_HZ;
    let step = timeline.len().div_ceil(DRAWN).max(1);
    let thin = |signal: &[f64]| -> Vec<f64> { signal.iter().step_by(step).copied().collect() };
    let half = rect.height / 2.0;
    let rows = [
        (
            "Speed (mm/s)",
            &timeline.speed_mm_s,
            ink::BLUE,
            "Speed, with the segments that were used",
        ),
        (
            "Load (N)",
            &timeline.load_n,
            ink::VERMILION,
            "Load, with impacts",
        ),
    ];
    for (row, (label, signal, color, title)) in rows.into_iter().enumerate() {
        let signal = thin(signal);
        let panel = Panel::new(
            Rect::new(rect.x, rect.y + row as f32 * half, rect.width, half),
            Axis::new("Time (s)", 0.0, seconds),
            Axis::covering(label, signal.iter().copied().chain([0.0])).ticks_about(4),
        )
        .letter(if row == 0 { 'a' } else { 'b' })
        .title(title);
        if row == 0 {
            for segment in &import.analysis.strokes.segments {
                let from = segment.start as f64 / RATE_HZ;
                panel.band(
                    canvas,
                    from,
                    from + segment.length as f64 / RATE_HZ,
                    ink::GRID,
                );
            }
        } else {
            for impact in &import.analysis.impacts {
                panel.vertical_line(
                    canvas,
                    impact.at_s - timeline.clock.start_s,
                    Stroke::new(ink::GREY, 1.0),
                );
            }
        }
        panel.draw_frame(canvas);
        panel.series(
            canvas,
            0.0,
            step as f64 / RATE_HZ,
            &signal,
            Stroke::new(color, 1.5),
        );
    }
}

/// Where the strokes were, and where the vertices stand.
pub(super) fn coverage(canvas: &mut Canvas, rect: Rect, import: &Shown<'_>) {
    let grid = &import.whole.grid;
    let largest = |pick: fn(&asperity_texture::model::GridVertex) -> f64| {
        grid.vertices.iter().map(pick).fold(0.0, f64::max)
    };
    let panel = Panel::new(
        rect,
        Axis::new("Speed (mm/s)", 0.0, largest(|v| v.speed_mm_s)),
        Axis::new("Load (N)", 0.0, largest(|v| v.force_n)),
    )
    .letter('c')
    .title("Where it was stroked")
    .with_legend(1);
    panel.draw_frame(canvas);
    let edges = Stroke::new(ink::LIGHT, 1.0);
    let ring = Some(Stroke::new(ink::VERMILION, 3.0));
    panel.legend(
        canvas,
        &[
            (
                Key::Point(Marker::Circle, 4.0, Some(ink::BLUE), None),
                "segments used",
            ),
            (Key::Point(Marker::Circle, 9.0, None, ring), "vertices"),
            (Key::Line(edges), "grid"),
        ],
    );
    for triangle in &grid.triangles {
        let corner = |n: usize| {
            let v = &grid.vertices[triangle[n % 3]];
            (v.speed_mm_s, v.force_n)
        };
        let outline: Vec<(f64, f64)> = (0..4).map(corner).collect();
        panel.line(canvas, outline, edges);
    }
    let dots: Vec<(f64, f64)> = import
        .analysis
        .strokes
        .segments
        .iter()
        .map(|s| (s.speed_mm_s, s.force_n))
        .collect();
    panel.points(canvas, dots, Marker::Circle, 4.0, Some(ink::BLUE), None);
    let vertices: Vec<(f64, f64)> = import
        .analysis
        .fit
        .facts
        .iter()
        .map(|v| (v.speed_mm_s, v.force_n))
        .collect();
    panel.points(canvas, vertices, Marker::Circle, 11.0, None, ring);
}

/// Drag over load, with μ.
pub(super) fn friction(canvas: &mut Canvas, rect: Rect, import: &Shown<'_>) {
    let analysis = &import.analysis;
    let timeline = &analysis.timeline;
    let points: Vec<(f64, f64)> = timeline.drag_n.as_ref().map_or_else(Vec::new, |drag| {
        (0..timeline.len())
            .step_by(40)
            .filter(|&n| timeline.contact[n] && timeline.speed_mm_s[n] > 20.0)
            .map(|n| (timeline.load_n[n], drag[n]))
            .collect()
    });
    let recorded = !points.is_empty();
    let most = points.iter().map(|p| p.0).fold(0.1, f64::max);
    let title = match &analysis.friction {
        Some(friction) => format!(
            "Friction: μ = {:.3} ± {:.3}{}",
            friction.mu,
            friction.spread,
            if import.whole.friction.law.is_some() {
                ", by speed"
            } else {
                ""
            }
        ),
        None => format!(
            "Friction: not recorded, μ = {:.3} completed",
            import.whole.friction.mu
        ),
    };
    let panel = Panel::new(
        rect,
        Axis::new("Load (N)", 0.0, most),
        Axis::covering("Drag (N)", points.iter().map(|p| p.1).chain([0.0])),
    )
    .letter('g')
    .title(title)
    .with_legend(1);
    panel.draw_frame(canvas);
    panel.points(
        canvas,
        points,
        Marker::Circle,
        2.0,
        Some(ink::BLUE.alpha(120)),
        None,
    );
    let friction = &import.whole.friction;
    let ray = |mu: f64| [(0.0, 0.0), (most, mu * most)];
    let rendered = Stroke::new(ink::VERMILION, 3.0);
    let at_ends = Stroke::new(ink::VERMILION, 2.0).dashed();
    panel.line(canvas, ray(friction.mu), rendered);
    let mut keys = vec![(Key::Line(rendered), "texture")];
    if recorded {
        let dot = Key::Point(Marker::Circle, 4.0, Some(ink::BLUE.alpha(120)), None);
        keys.insert(0, (dot, "recorded"));
    }
    // What is rendered at the slowest and at the fastest recorded speed.
    let points = friction.law.as_ref().map(|law| &law.points);
    let ends = points.into_iter().flat_map(|p| [p.first(), p.last()]);
    for point in ends.flatten() {
        panel.line(canvas, ray(friction.mu * point.factor), at_ends);
    }
    if friction.law.is_some() {
        keys.push((Key::Line(at_ends), "texture, slowest and fastest"));
    }
    panel.legend(canvas, &keys);
}

/// The transients of the texture.
pub(super) fn taps(canvas: &mut Canvas, rect: Rect, import: &Shown<'_>) {
    let bank = &import.whole.taps;
    let values = || {
        bank.traces
            .iter()
            .flat_map(|t| t.accel_m_s2.iter().copied())
    };
    let length = bank
        .traces
        .iter()
        .map(|t| t.accel_m_s2.len())
        .max()
        .unwrap_or(1);
    let rate = if bank.sample_rate_hz > 0.0 {
        bank.sample_rate_hz
    } else {
        TAP_RATE_HZ
    };
    let mut panel = Panel::new(
        rect,
        Axis::new("Time (ms)", 0.0, 1e3 * length as f64 / rate),
        Axis::covering("Acceleration (m/s²)", values().chain([0.0])),
    )
    .letter('h')
    .title(format!("Taps, {}", import.parts.taps));
    panel.margins.right = 150.0;
    panel.draw_frame(canvas);
    let fastest = bank.traces.last().map_or(1.0, |t| t.speed_m_s);
    let scale = ColorScale::new(ColorMap::Plasma, 0.0, fastest);
    for trace in &bank.traces {
        let stroke = Stroke::new(scale.color(trace.speed_m_s), size::LINE);
        panel.series(canvas, 0.0, 1e3 / rate, &trace.accel_m_s2, stroke);
    }
    panel.colorbar(canvas, &scale, "Impact speed (m/s)");
}

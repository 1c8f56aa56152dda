//! The sheet of a recording: what was done, what was heard, what became of it.

use super::import::RecordingImport;
use crate::model::mixture::Field;
use asperity_plot::{
    Axis, Canvas, Color, ColorMap, ColorScale, Key, Marker, Panel, PlotError, Rect, Stroke,
    TextStyle, ink, legend,
};
use asperity_recording::{impact::TAP_RATE_HZ, steady::frequencies_hz, timeline::RATE_HZ};

/// Width of the sheet, pixels.
pub const WIDTH_PX: u32 = 2400;
/// Height of the sheet, pixels.
pub const HEIGHT_PX: u32 = 1700;

const HEADER: f32 = 110.0;
const ROW: f32 = 530.0;
/// Points of a drawn time series.
const DRAWN: usize = 2400;

/// Draws an import and returns the bytes of a PNG.
///
/// # Errors
/// [`PlotError`] if the embedded font or the PNG encoder fails.
pub fn sheet(import: &RecordingImport) -> Result<Vec<u8>, PlotError> {
    let mut canvas = Canvas::new(WIDTH_PX, HEIGHT_PX)?;
    let width = WIDTH_PX as f32;
    header(&mut canvas, import);
    let third = width / 3.0;
    motion(
        &mut canvas,
        Rect::new(0.0, HEADER, 2.0 * third, ROW),
        import,
    );
    coverage(
        &mut canvas,
        Rect::new(2.0 * third, HEADER, third, ROW),
        import,
    );
    for part in 0..2 {
        spectra(
            &mut canvas,
            Rect::new(part as f32 * third, HEADER + ROW, third, ROW),
            import,
            part,
        );
    }
    held_out(
        &mut canvas,
        Rect::new(2.0 * third, HEADER + ROW, third, ROW),
        import,
    );
    friction(
        &mut canvas,
        Rect::new(0.0, HEADER + 2.0 * ROW, third, ROW),
        import,
    );
    taps(
        &mut canvas,
        Rect::new(third, HEADER + 2.0 * ROW, third, ROW),
        import,
    );
    uncertainty(
        &mut canvas,
        Rect::new(2.0 * third, HEADER + 2.0 * ROW, third, ROW),
        import,
    );
    canvas.png()
}

fn header(canvas: &mut Canvas, import: &RecordingImport) {
    let analysis = &import.analysis;
    let title = TextStyle::new(40.0).bold();
    let small = TextStyle::new(24.0).color(ink::GREY);
    canvas.text(&import.report.name, (40.0, 50.0), &title);
    let faults = analysis
        .checked
        .at_least(asperity_recording::check::Severity::Warning)
        .count();
    let line = format!(
        "{:.0} s recorded, {:.0} s in contact, {:.0} s steady; {faults} warnings and faults; taps {}, friction {}; nearest {}",
        analysis.checked.duration_s,
        analysis.checked.contact_s,
        analysis.steady.covered_s(),
        import.sources.taps,
        import.sources.friction,
        import
            .completed
            .nearest
            .first()
            .map_or("unknown", |n| &n.name)
    );
    let line = canvas.fitted(&line, &small, WIDTH_PX as f32 - 80.0);
    canvas.text(&line, (40.0, 90.0), &small);
}

/// Speed and load over time, with the segments that were used.
fn motion(canvas: &mut Canvas, rect: Rect, import: &RecordingImport) {
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
            for segment in &import.analysis.steady.segments {
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

fn plane(rect: Rect, import: &RecordingImport, letter: char, title: &str) -> Panel {
    let grid = &import.whole.grid;
    let largest = |pick: fn(&crate::model::GridVertex) -> f64| {
        grid.vertices.iter().map(pick).fold(0.0, f64::max)
    };
    Panel::new(
        rect,
        Axis::new("Speed (mm/s)", 0.0, largest(|v| v.speed_mm_s)),
        Axis::new("Load (N)", 0.0, largest(|v| v.force_n)),
    )
    .letter(letter)
    .title(title)
}

/// Where the strokes were, and where the vertices stand.
fn coverage(canvas: &mut Canvas, rect: Rect, import: &RecordingImport) {
    let panel = plane(rect, import, 'c', "Segments and vertices");
    panel.draw_frame(canvas);
    let grid = &import.whole.grid;
    for triangle in &grid.triangles {
        let corner = |n: usize| {
            let v = &grid.vertices[triangle[n % 3]];
            (v.speed_mm_s, v.force_n)
        };
        let outline: Vec<(f64, f64)> = (0..4).map(corner).collect();
        panel.line(
            canvas,
            outline.iter().copied(),
            Stroke::new(ink::LIGHT, 1.0),
        );
    }
    let dots: Vec<(f64, f64)> = import
        .analysis
        .steady
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
    panel.points(
        canvas,
        vertices,
        Marker::Circle,
        11.0,
        None,
        Some(Stroke::new(ink::VERMILION, 3.0)),
    );
}

/// The mean spectrum of slow or fast segments, and what the grid renders there.
fn spectra(canvas: &mut Canvas, rect: Rect, import: &RecordingImport, part: usize) {
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
fn held_out(canvas: &mut Canvas, rect: Rect, import: &RecordingImport) {
    let fit = &import.analysis.fit;
    let chosen = fit.chosen;
    let least = fit
        .tried
        .iter()
        .map(|t| t.held_out)
        .fold(f64::INFINITY, f64::min);
    let finite = |t: &&super::grid::Tried| t.held_out.is_finite();
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

/// Drag over load, with μ.
fn friction(canvas: &mut Canvas, rect: Rect, import: &RecordingImport) {
    let analysis = &import.analysis;
    let timeline = &analysis.timeline;
    let points: Vec<(f64, f64)> = timeline.drag_n.as_ref().map_or_else(Vec::new, |drag| {
        (0..timeline.len())
            .step_by(40)
            .filter(|&n| timeline.contact[n] && timeline.speed_mm_s[n] > 20.0)
            .map(|n| (timeline.load_n[n], drag[n]))
            .collect()
    });
    let most = points.iter().map(|p| p.0).fold(0.1, f64::max);
    let title = match &analysis.friction {
        Some(friction) => format!("Friction: μ = {:.3} ± {:.3}", friction.mu, friction.spread),
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
    .title(title);
    panel.draw_frame(canvas);
    panel.points(
        canvas,
        points,
        Marker::Circle,
        2.0,
        Some(ink::BLUE.alpha(120)),
        None,
    );
    panel.line(
        canvas,
        [(0.0, 0.0), (most, import.whole.friction.mu * most)],
        Stroke::new(ink::VERMILION, 3.0),
    );
}

/// The transients of the texture.
fn taps(canvas: &mut Canvas, rect: Rect, import: &RecordingImport) {
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
    let title = format!(
        "Taps, {}: a trace for each impact speed",
        import.sources.taps
    );
    let panel = Panel::new(
        rect,
        Axis::new("Time (ms)", 0.0, 1e3 * length as f64 / rate),
        Axis::covering("Acceleration (m/s²)", values().chain([0.0])),
    )
    .letter('h')
    .title(title);
    panel.draw_frame(canvas);
    let fastest = bank.traces.last().map_or(1.0, |t| t.speed_m_s);
    let scale = ColorScale::new(ColorMap::Viridis, 0.0, fastest);
    for trace in &bank.traces {
        let color: Color = scale.color(trace.speed_m_s);
        panel.series(
            canvas,
            0.0,
            1e3 / rate,
            &trace.accel_m_s2,
            Stroke::new(color, 2.0),
        );
    }
}

/// Seconds behind each vertex, and how far its residual is from white.
fn uncertainty(canvas: &mut Canvas, rect: Rect, import: &RecordingImport) {
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

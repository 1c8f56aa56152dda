//! The sheet of a calibration: the response without and with the filter, and the coherence.

use asperity_host::profile::compensation::{Design, levels_db};
use asperity_host::profile::response::{BAND_HZ, Response};
use asperity_plot::{
    Axis, Canvas, Key, Margins, Panel, PlotError, Rect, Stroke, TextStyle, ink, size,
};

use super::LEAST_COHERENCE;

const SIZE: (f32, f32) = (2000.0, 900.0);
const HEADING_PX: f32 = 120.0;
/// Deviation that a device may have, dB.
const ALLOWED_DB: f64 = 3.0;

/// Draws a calibration as PNG; `origin` names what was measured.
///
/// # Errors
/// [`PlotError`].
pub fn draw(origin: &str, response: &Response, design: &Design) -> Result<Vec<u8>, PlotError> {
    let mut canvas = Canvas::new(SIZE.0 as u32, SIZE.1 as u32)?;
    let title = TextStyle::new(size::HEADING).bold();
    canvas.text("Response of a device", (30.0, 58.0), &title);
    let style = TextStyle::new(size::LABEL).color(ink::GREY);
    let below = format!(
        "{origin}; {:.1} dB from the reference at most without the filter, {:.1} dB with it, 40 to 400 Hz",
        design.before_db, design.after_db
    );
    let below = canvas.fitted(&below, &style, SIZE.0 - 60.0);
    canvas.text(&below, (30.0, 100.0), &style);
    let half = 0.5 * SIZE.0;
    let place = |column: f32| Rect::new(column * half, HEADING_PX, half, SIZE.1 - HEADING_PX);
    levels(&mut canvas, place(0.0), response, design);
    coherence(&mut canvas, place(1.0), response);
    canvas.png()
}

fn frequencies(response: &Response) -> Axis {
    Axis::log("Frequency (Hz)", 20.0, 0.5 * response.rate_hz)
}

fn panel(outer: Rect, x: Axis, y: Axis, letter: char, title: &str) -> Panel {
    let mut panel = Panel::new(outer, x, y).letter(letter).title(title);
    panel.margins = Margins {
        top: 110.0,
        right: 48.0,
        ..panel.margins
    };
    panel
}

fn levels(canvas: &mut Canvas, outer: Rect, response: &Response, design: &Design) {
    let before = levels_db(response, &[1.0]);
    let after = levels_db(response, &design.filter.taps);
    // What lies outside of the band is shown as far as it fits.
    let within = |(freq_hz, _): &&(f64, f64)| (30.0..=BAND_HZ.1).contains(freq_hz);
    let shown = before
        .iter()
        .chain(&after)
        .filter(within)
        .map(|(_, level)| *level);
    let largest = shown.fold(6.0_f64, |largest, level| largest.max(level.abs()));
    let panel = panel(
        outer,
        frequencies(response),
        Axis::new(
            "Level (dB re 22.2 m/s² a newton)",
            -1.15 * largest,
            1.15 * largest,
        ),
        'a',
        "Acceleration of the same force",
    );
    panel.draw_frame(canvas);
    for level in [-ALLOWED_DB, ALLOWED_DB] {
        panel.horizontal_line(canvas, level, Stroke::new(ink::GREY, size::FRAME).dotted());
    }
    for freq_hz in [BAND_HZ.0, BAND_HZ.1] {
        panel.vertical_line(
            canvas,
            freq_hz,
            Stroke::new(ink::GREY, size::FRAME).dotted(),
        );
    }
    let without = Stroke::new(ink::BLUE, size::LINE);
    let with = Stroke::new(ink::VERMILION, size::LINE).dashed();
    panel.line(canvas, before, without);
    panel.line(canvas, after, with);
    let keys = [
        (Key::Line(without), "without the filter"),
        (Key::Line(with), "with it"),
        (
            Key::Line(Stroke::new(ink::GREY, size::FRAME).dotted()),
            "±3 dB, 40 to 400 Hz",
        ),
    ];
    panel.legend(canvas, &keys);
}

fn coherence(canvas: &mut Canvas, outer: Rect, response: &Response) {
    let panel = panel(
        outer,
        frequencies(response),
        Axis::new("Coherence", 0.0, 1.05),
        'b',
        "How far the acceleration follows from the force",
    );
    panel.draw_frame(canvas);
    let least = Stroke::new(ink::GREY, size::FRAME).dotted();
    panel.horizontal_line(canvas, LEAST_COHERENCE, least);
    let stroke = Stroke::new(ink::GREEN, size::LINE);
    let points = response
        .points
        .iter()
        .map(|point| (point.freq_hz, point.coherence));
    panel.line(canvas, points, stroke);
    let keys = [
        (Key::Line(stroke), "coherence"),
        (Key::Line(least), "least that makes a filter"),
    ];
    panel.legend(canvas, &keys);
}

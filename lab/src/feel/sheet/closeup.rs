//! The lower row: one tap close up, and the spectra of the strokes.

use asperity_plot::{Axis, Canvas, Panel, Rect, Stroke, TextStyle, ink, size};

use super::legend::{Entry, legend};
use crate::feel::error::FeelError;
use crate::feel::recording::Recording;
use crate::feel::spectrogram::spectrogram;
use crate::feel::stroke::steady_part;
use crate::feel::tap::taps;

/// Time shown before and after an impact, ms.
const BEFORE_MS: f64 = 10.0;
const AFTER_MS: f64 = 60.0;
/// Levels shown below the loudest, dB.
const RANGE_DB: f64 = 35.0;
/// Space above the loudest for the legend, dB.
const HEADROOM_DB: f64 = 15.0;

/// The fastest tap: the normal force, and the part of it that is the transient.
pub(super) fn tap(canvas: &mut Canvas, recording: &Recording, outer: Rect) {
    let taps = taps(recording);
    let fastest = taps
        .scripted
        .iter()
        .filter_map(|tap| Some((tap.impact_s?, tap)))
        .max_by(|a, b| a.1.true_m_s.total_cmp(&b.1.true_m_s));
    let impact_s = fastest.map_or(0.0, |(impact_s, _)| impact_s);
    let part: Vec<(f64, f64, f64)> = recording
        .records
        .iter()
        .map(|r| {
            let since_ms = 1e3 * (r.t_s - impact_s);
            (
                since_ms,
                f64::from(r.output.force_n[2]),
                f64::from(r.output.tap_n),
            )
        })
        .filter(|(since_ms, ..)| (-BEFORE_MS..=AFTER_MS).contains(since_ms))
        .collect();
    let title = fastest.map_or_else(
        || "No tap".to_owned(),
        |(_, tap)| format!("Tap at {:.0} mm/s", 1e3 * tap.true_m_s),
    );
    let panel = Panel::new(
        outer,
        Axis::new("Time since the surface was met (ms)", -BEFORE_MS, AFTER_MS).ticks_about(8),
        Axis::covering("Force (N)", part.iter().flat_map(|&(_, z, tap)| [z, tap])),
    )
    .letter('f')
    .title(title);
    panel.draw_frame(canvas);
    let total = Stroke::new(ink::VERMILION, 1.6 * size::LINE);
    let transient = Stroke::new(ink::BLUE, size::LINE);
    panel.vertical_line(canvas, 0.0, Stroke::new(ink::BLACK, size::FRAME).dashed());
    panel.line(canvas, part.iter().map(|&(t, z, _)| (t, z)), total);
    panel.line(canvas, part.iter().map(|&(t, _, tap)| (t, tap)), transient);
    legend(
        canvas,
        &panel,
        &[
            Entry {
                name: "normal force",
                stroke: total,
            },
            Entry {
                name: "of it the transient",
                stroke: transient,
            },
        ],
    );
}

/// Power spectra of the strokes over their steady parts.
pub(super) fn spectra(
    canvas: &mut Canvas,
    recording: &Recording,
    outer: Rect,
) -> Result<(), FeelError> {
    let rate_hz = recording.device.timing.servo_rate_hz;
    let length = ((0.128 * rate_hz).round() as usize).max(2);
    let mut curves = Vec::new();
    for span in recording.spans() {
        let part: Vec<f64> = steady_part(&span)
            .iter()
            .map(|r| f64::from(r.output.vib_m_s2))
            .collect();
        let power = spectrogram(&part, rate_hz, length, (length / 8).max(1))?;
        let curve: Vec<(f64, f64)> = power
            .mean()
            .into_iter()
            .enumerate()
            .map(|(bin, psd)| (bin as f64 * power.bin_hz, 10.0 * psd.max(1e-30).log10()))
            .collect();
        if !curve.is_empty() {
            curves.push((span.motion.to_string(), curve));
        }
    }
    // The strokes of one cycle of the script; more curves could not be told apart.
    curves.truncate(4);
    let loudest = curves
        .iter()
        .flat_map(|(_, curve)| curve)
        .map(|point| point.1)
        .fold(-60.0, f64::max);
    let loudest_db = (loudest / 5.0).ceil() * 5.0;
    let panel = Panel::new(
        outer,
        Axis::new("Frequency (Hz)", 0.0, 0.5 * rate_hz),
        Axis::new(
            "PSD (dB re 1 (m/s²)²/Hz)",
            loudest_db - RANGE_DB,
            loudest_db + HEADROOM_DB,
        ),
    )
    .letter('g')
    .title("Spectra of the strokes");
    panel.draw_frame(canvas);
    let key = TextStyle::new(size::TICK);
    let area = panel.area();
    for (index, (name, curve)) in curves.into_iter().enumerate() {
        let stroke = Stroke::category(index, size::LINE);
        panel.line(canvas, curve, stroke);
        let text = name.trim_start_matches("stroke ").to_owned();
        let y = area.y + 30.0 + 32.0 * index as f32;
        let x = area.right() - 20.0 - canvas.text_width(&text, &key);
        canvas.line(&[(x - 48.0, y - 8.0), (x - 12.0, y - 8.0)], stroke, None);
        canvas.text(&text, (x, y), &key);
    }
    Ok(())
}

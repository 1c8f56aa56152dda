//! Mean spectra, as a picture.

use super::trend::Trends;
use asperity_plot::{Axis, Canvas, Key, Panel, PlotError, Rect, Stroke, ink};

const SIZE: (u32, u32) = (1100, 720);

/// Draws the mean spectrum of measured materials and of the textures of their names, PNG.
///
/// # Errors
/// [`PlotError`] of the encoder.
pub fn spectra(trends: &Trends) -> Result<Vec<u8>, PlotError> {
    let mut canvas = Canvas::new(SIZE.0, SIZE.1)?;
    let mut lines = vec![
        ("measured", ink::BLACK, trends.spectrum_db.measured),
        ("compiled by name", ink::BLUE, trends.spectrum_db.compiled),
    ];
    if let Some(generated) = trends.spectrum_db.generated {
        lines.push(("generator, names left out", ink::ORANGE, generated));
    }
    let [first, .., last] = trends.bands_hz;
    let panel = Panel::new(
        Rect::new(0.0, 0.0, SIZE.0 as f32, SIZE.1 as f32),
        Axis::log("Third octave (Hz)", first, last),
        Axis::covering(
            "Mean level (dB re 1 (m/s²)²)",
            lines.iter().flat_map(|line| line.2),
        ),
    )
    .with_legend(1)
    .title("100 mm/s, 1 N");
    panel.draw_frame(&mut canvas);
    let mut keys = Vec::new();
    for (name, colour, levels) in lines {
        let stroke = Stroke::new(colour, 3.0);
        panel.line(&mut canvas, trends.bands_hz.into_iter().zip(levels), stroke);
        keys.push((Key::Line(stroke), name));
    }
    panel.legend(&mut canvas, &keys);
    canvas.png()
}

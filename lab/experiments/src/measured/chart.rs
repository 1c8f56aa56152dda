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
    let both = [trends.spectrum_db.measured, trends.spectrum_db.compiled];
    let [first, .., last] = trends.bands_hz;
    let panel = Panel::new(
        Rect::new(0.0, 0.0, SIZE.0 as f32, SIZE.1 as f32),
        Axis::log("Third octave (Hz)", first, last),
        Axis::covering(
            "Mean level (dB re 1 (m/s²)²)",
            both.iter().flatten().copied(),
        ),
    )
    .with_legend(1)
    .title("100 mm/s, 1 N");
    panel.draw_frame(&mut canvas);
    let strokes = [Stroke::new(ink::BLACK, 3.0), Stroke::new(ink::BLUE, 3.0)];
    for (levels, stroke) in both.iter().zip(strokes) {
        panel.line(
            &mut canvas,
            trends.bands_hz.into_iter().zip(*levels),
            stroke,
        );
    }
    let keys = [
        (Key::Line(strokes[0]), "measured"),
        (Key::Line(strokes[1]), "compiled by name"),
    ];
    panel.legend(&mut canvas, &keys);
    canvas.png()
}

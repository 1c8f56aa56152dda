//! The sheet of a recording: what was done, what was heard, what became of it.

mod hand;
mod models;

use super::{Analysis, Completed, Parts, Recorded};
use asperity_plot::{Canvas, PlotError, Rect, TextStyle, ink};
use asperity_texture::model::TextureModel;

/// Width of the sheet, pixels.
pub const WIDTH_PX: u32 = 2400;
/// Height of the sheet, pixels.
pub const HEIGHT_PX: u32 = 1700;

const HEADER: f32 = 110.0;
const ROW: f32 = 530.0;

/// Data of the panels.
struct Shown<'a> {
    analysis: &'a Analysis,
    completed: &'a Completed,
    parts: &'a Parts,
    whole: &'a TextureModel,
}

/// Draws what was found and the texture before its reduction, and returns the bytes of a PNG.
///
/// # Errors
/// [`PlotError`] if the embedded font or the PNG encoder fails.
pub(super) fn sheet(recorded: &Recorded, whole: &TextureModel) -> Result<Vec<u8>, PlotError> {
    let import = &Shown {
        analysis: &recorded.analysis,
        completed: &recorded.completed,
        parts: &recorded.parts,
        whole,
    };
    let mut canvas = Canvas::new(WIDTH_PX, HEIGHT_PX)?;
    let width = WIDTH_PX as f32;
    header(&mut canvas, import);
    let third = width / 3.0;
    hand::motion(
        &mut canvas,
        Rect::new(0.0, HEADER, 2.0 * third, ROW),
        import,
    );
    hand::coverage(
        &mut canvas,
        Rect::new(2.0 * third, HEADER, third, ROW),
        import,
    );
    for part in 0..2 {
        models::spectra(
            &mut canvas,
            Rect::new(part as f32 * third, HEADER + ROW, third, ROW),
            import,
            part,
        );
    }
    models::held_out(
        &mut canvas,
        Rect::new(2.0 * third, HEADER + ROW, third, ROW),
        import,
    );
    hand::friction(
        &mut canvas,
        Rect::new(0.0, HEADER + 2.0 * ROW, third, ROW),
        import,
    );
    hand::taps(
        &mut canvas,
        Rect::new(third, HEADER + 2.0 * ROW, third, ROW),
        import,
    );
    models::uncertainty(
        &mut canvas,
        Rect::new(2.0 * third, HEADER + 2.0 * ROW, third, ROW),
        import,
    );
    canvas.png()
}

fn header(canvas: &mut Canvas, import: &Shown<'_>) {
    let analysis = &import.analysis;
    let title = TextStyle::new(40.0).bold();
    let small = TextStyle::new(24.0).color(ink::GREY);
    canvas.text(&import.whole.name, (40.0, 50.0), &title);
    let faults = analysis
        .checked
        .at_least(asperity_recording::check::Severity::Warning)
        .count();
    let line = format!(
        "{:.0} s recorded, {:.0} s in contact, {:.0} s of strokes used; {faults} warnings and faults; taps {}, friction {}; nearest {}",
        analysis.checked.duration_s,
        analysis.checked.contact_s,
        analysis.strokes.covered_s(),
        import.parts.taps,
        import.parts.friction,
        import
            .completed
            .nearest
            .first()
            .map_or("unknown", |n| &n.name)
    );
    let line = canvas.fitted(&line, &small, WIDTH_PX as f32 - 80.0);
    canvas.text(&line, (40.0, 90.0), &small);
}

//! A sheet that shows a recording: position, force, vibration, spectra and taps.

mod closeup;
mod legend;
mod phases;
mod time;
mod timeline;

use asperity_plot::{Canvas, Rect, TextStyle, ink, size};

use crate::feel::error::FeelError;
use crate::feel::recording::Recording;

const WIDTH_PX: f32 = 2400.0;
const HEIGHT_PX: f32 = 2690.0;
const HEADING_PX: f32 = 130.0;

/// Draws the sheet.
///
/// # Errors
/// [`FeelError`] if the picture cannot be encoded.
pub fn draw(recording: &Recording) -> Result<Vec<u8>, FeelError> {
    let mut canvas = Canvas::new(WIDTH_PX as u32, HEIGHT_PX as u32)?;
    heading(&mut canvas, recording);
    let mut top = HEADING_PX;
    let mut place = |height: f32| {
        let rect = Rect::new(0.0, top, WIDTH_PX, height);
        top += height;
        rect
    };
    phases::draw(&mut canvas, recording, place(phases::HEIGHT_PX));
    timeline::plane(&mut canvas, recording, place(320.0));
    timeline::height(&mut canvas, recording, place(340.0));
    timeline::force(&mut canvas, recording, place(420.0));
    timeline::vibration(&mut canvas, recording, place(340.0));
    timeline::spectrogram(&mut canvas, recording, place(460.0))?;
    let below = place(570.0);
    let half = 0.5 * below.width;
    closeup::tap(
        &mut canvas,
        recording,
        Rect {
            width: half,
            ..below
        },
    );
    closeup::spectra(
        &mut canvas,
        recording,
        Rect {
            x: half,
            width: half,
            ..below
        },
    )?;
    Ok(canvas.png()?)
}

fn heading(canvas: &mut Canvas, recording: &Recording) {
    let Recording {
        texture,
        device,
        grip,
        seed,
        ..
    } = recording;
    let title = TextStyle::new(size::HEADING).bold();
    let name = canvas.fitted(&texture.name, &title, WIDTH_PX - 60.0);
    canvas.text(&name, (30.0, 62.0), &title);
    let synthetic = if texture.caveats.is_empty() {
        ""
    } else {
        "; parts are synthetic or unconfirmed"
    };
    let line = format!(
        "felt on a simulated {} at {:.0} Hz, {} grip, seed {seed}; μ {:.2}, wall {:.0} N/m{synthetic}",
        device.name, device.timing.servo_rate_hz, grip.name, texture.mu, texture.stiffness_n_m
    );
    let style = TextStyle::new(size::LABEL).color(ink::GREY);
    let line = canvas.fitted(&line, &style, WIDTH_PX - 60.0);
    canvas.text(&line, (30.0, 106.0), &style);
}

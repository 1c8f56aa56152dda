//! One sheet that shows a recording: where the stylus was, what it was pushed
//! with, what the texture sounded like, when it was tapped.

mod closeup;
mod phases;
mod timeline;

use asperity_plot::{Axis, Canvas, Margins, Panel, Rect, Stroke, TextStyle, ink, size};

use super::{FeelError, Recording};

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

/// Margins that every panel over time shares, so that times stand in line.
const TIME_MARGINS: Margins = Margins {
    left: 120.0,
    right: 170.0,
    top: 50.0,
    bottom: 14.0,
};

/// The shared time axis.
fn time_axis(recording: &Recording, numbered: bool) -> Axis {
    let axis = Axis::new("", 0.0, recording.duration_s()).ticks_about(12);
    if numbered {
        Axis {
            label: "Time (s)".into(),
            ..axis
        }
    } else {
        axis.unnumbered()
    }
}

/// A line of a legend.
struct Entry {
    name: &'static str,
    stroke: Stroke,
}

/// Names the lines of a panel, right of its title.
fn legend(canvas: &mut Canvas, panel: &Panel, entries: &[Entry]) {
    let style = TextStyle::new(size::TICK);
    let area = panel.area();
    let y = area.y - 26.0;
    let mut x = area.right();
    for entry in entries.iter().rev() {
        x -= canvas.text_width(entry.name, &style);
        canvas.text(entry.name, (x, y + 6.0), &style);
        canvas.line(&[(x - 46.0, y), (x - 10.0, y)], entry.stroke, None);
        x -= 72.0;
    }
}

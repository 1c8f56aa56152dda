//! The panels whose horizontal axis is time.

use asperity_plot::{
    Axis, Canvas, ColorMap, ColorScale, Margins, Marker, Panel, Rect, Stroke, TextStyle, ink, size,
};

use super::legend::{Entry, legend};
use super::phases;
use super::time::{TIME_MARGINS, time_axis};
use crate::feel::error::FeelError;
use crate::feel::recording::Recording;
use crate::feel::spectrogram::spectrogram as transform;
use crate::feel::statistics::peak;
use crate::feel::tap::taps;
use asperity_sim::session::Record;

/// Range of levels that the spectrogram shows, below the loudest, dB.
const RANGE_DB: f64 = 50.0;
/// Length of a window, s; it gives bins of about 8 Hz.
const WINDOW_S: f64 = 0.128;

fn values(recording: &Recording, value: impl Fn(&Record) -> f64) -> Vec<f64> {
    recording.records.iter().map(value).collect()
}

fn line(canvas: &mut Canvas, panel: &Panel, recording: &Recording, data: &[f64], stroke: Stroke) {
    panel.series(canvas, 0.0, recording.tick_s(), data, stroke);
}

/// A panel with frame and shaded motions, ready for data.
fn framed(
    canvas: &mut Canvas,
    recording: &Recording,
    outer: Rect,
    y: Axis,
    letter: char,
    title: &str,
) -> Panel {
    let panel = Panel::new(outer, time_axis(recording, false), y)
        .letter(letter)
        .title(title)
        .margins(TIME_MARGINS);
    phases::shade(canvas, recording, &panel);
    panel.draw_frame(canvas);
    panel
}

/// Position in the plane of the surface.
pub(super) fn plane(canvas: &mut Canvas, recording: &Recording, outer: Rect) {
    let x = values(recording, |r| 1e3 * r.true_m[0]);
    let y = values(recording, |r| 1e3 * r.true_m[1]);
    let axis = Axis::covering("Position (mm)", x.iter().chain(&y).copied()).ticks_about(5);
    let panel = framed(canvas, recording, outer, axis, 'a', "Position in the plane");
    let (blue, green) = (
        Stroke::new(ink::BLUE, size::LINE),
        Stroke::new(ink::GREEN, size::LINE).dashed(),
    );
    line(canvas, &panel, recording, &x, blue);
    line(canvas, &panel, recording, &y, green);
    legend(
        canvas,
        &panel,
        &[
            Entry {
                name: "x",
                stroke: blue,
            },
            Entry {
                name: "y",
                stroke: green,
            },
        ],
    );
}

/// Height over the surface, with the taps.
pub(super) fn height(canvas: &mut Canvas, recording: &Recording, outer: Rect) {
    let z = values(recording, |r| 1e3 * r.true_m[2]);
    let axis = Axis::covering("Height (mm)", z.iter().copied()).ticks_about(5);
    let panel = framed(
        canvas,
        recording,
        outer,
        axis,
        'b',
        "Height over the surface",
    );
    let surface = Stroke::new(ink::BLACK, size::FRAME).dashed();
    let stylus = Stroke::new(ink::BLUE, size::LINE);
    panel.horizontal_line(canvas, 0.0, surface);
    line(canvas, &panel, recording, &z, stylus);
    let marks = taps(recording);
    let at = |times: Vec<f64>| times.into_iter().map(|t_s| (t_s, 0.0)).collect::<Vec<_>>();
    let scripted = marks
        .scripted
        .iter()
        .filter_map(|tap| Some(tap.impact_s? + tap.delay_s?));
    let edge = Some(Stroke::new(ink::BLACK, 1.5));
    panel.points(
        canvas,
        at(scripted.collect()),
        Marker::Triangle,
        11.0,
        Some(ink::VERMILION),
        edge,
    );
    panel.points(
        canvas,
        at(marks.others_s),
        Marker::Circle,
        7.0,
        Some(ink::PAPER),
        edge,
    );
    legend(
        canvas,
        &panel,
        &[
            Entry {
                name: "stylus",
                stroke: stylus,
            },
            Entry {
                name: "surface",
                stroke: surface,
            },
        ],
    );
    let key = panel.area();
    let style = TextStyle::new(size::TICK);
    let (x, y) = (key.right() + 24.0, key.y + 24.0);
    canvas.marker((x, y), Marker::Triangle, 11.0, Some(ink::VERMILION), edge);
    canvas.text("tap", (x + 20.0, y + 8.0), &style);
    canvas.marker((x, y + 34.0), Marker::Circle, 7.0, Some(ink::PAPER), edge);
    canvas.text("landing", (x + 20.0, y + 42.0), &style);
}

/// The force as commanded, axis by axis, and what the hand means to hold.
pub(super) fn force(canvas: &mut Canvas, recording: &Recording, outer: Rect) {
    let component = |i: usize| values(recording, move |r| f64::from(r.output.force_n[i]));
    let [x, y, z] = [component(0), component(1), component(2)];
    let wanted = values(recording, |r| r.intent.wanted_n.unwrap_or(f64::NAN));
    let all = x.iter().chain(&y).chain(&z).copied();
    let axis = Axis::covering("Force (N)", all).ticks_about(6);
    let panel = framed(canvas, recording, outer, axis, 'c', "Force on the hand");
    let [blue, green] = [ink::BLUE, ink::GREEN].map(|c| Stroke::new(c, 2.0));
    let green = green.dashed();
    let red = Stroke::new(ink::VERMILION, 3.5);
    let meant = Stroke::new(ink::BLACK, 2.0).dotted();
    line(canvas, &panel, recording, &x, blue);
    line(canvas, &panel, recording, &y, green);
    line(canvas, &panel, recording, &z, red);
    line(canvas, &panel, recording, &wanted, meant);
    let continuous_n = recording.device.actuator.continuous_force_n;
    let continuous = Stroke::new(ink::GREY, size::FRAME).dotted();
    panel.horizontal_line(canvas, continuous_n, continuous);
    legend(
        canvas,
        &panel,
        &[
            Entry {
                name: "x",
                stroke: blue,
            },
            Entry {
                name: "y",
                stroke: green,
            },
            Entry {
                name: "z (normal)",
                stroke: red,
            },
            Entry {
                name: "meant by the hand",
                stroke: meant,
            },
            Entry {
                name: "continuous limit",
                stroke: continuous,
            },
        ],
    );
}

/// The vibration's waveform.
pub(super) fn vibration(canvas: &mut Canvas, recording: &Recording, outer: Rect) {
    let data = recording.vibration_m_s2();
    let peak = peak(data.iter().copied());
    let axis = Axis::covering("Vibration (m/s²)", [-peak, peak]).ticks_about(5);
    let title = "Vibration before device gain";
    let panel = framed(canvas, recording, outer, axis, 'd', title);
    line(
        canvas,
        &panel,
        recording,
        &data,
        Stroke::new(ink::BLUE, 1.5),
    );
}

/// The vibration's spectrogram.
pub(super) fn spectrogram(
    canvas: &mut Canvas,
    recording: &Recording,
    outer: Rect,
) -> Result<(), FeelError> {
    let rate_hz = recording.device.timing.servo_rate_hz;
    let length = ((WINDOW_S * rate_hz).round() as usize).max(2);
    // No more windows than the widest panel has pixels.
    let hop = (length / 8).max(recording.records.len() / 2000).max(1);
    let power = transform(&recording.vibration_m_s2(), rate_hz, length, hop)?;
    let level_db = |psd: f64| 10.0 * psd.max(1e-30).log10();
    let loudest = power.psd.iter().flatten().copied().fold(0.0, f64::max);
    let top_db = if loudest > 0.0 {
        (level_db(loudest) / 5.0).ceil() * 5.0
    } else {
        0.0
    };
    let scale = ColorScale::new(ColorMap::Inferno, top_db - RANGE_DB, top_db);
    let panel = Panel::new(
        outer,
        time_axis(recording, true),
        Axis::new("Frequency (Hz)", 0.0, 0.5 * rate_hz).ticks_about(5),
    )
    .letter('e')
    .title("Spectrogram of the vibration")
    .without_grid()
    .margins(Margins {
        bottom: 88.0,
        ..TIME_MARGINS
    });
    let columns = power.psd.len();
    if let Some(bins) = power.psd.first().map(Vec::len) {
        let start_s = power.first_s - 0.5 * power.step_s;
        let times = (start_s, start_s + columns as f64 * power.step_s);
        let frequencies = (-0.5 * power.bin_hz, (bins as f64 - 0.5) * power.bin_hz);
        panel.heatmap(canvas, times, frequencies, columns, bins, |column, bin| {
            scale.color(level_db(power.psd[column][bin]))
        });
    }
    panel.draw_frame(canvas);
    panel.colorbar(canvas, &scale, "dB re 1 (m/s²)²/Hz");
    Ok(())
}

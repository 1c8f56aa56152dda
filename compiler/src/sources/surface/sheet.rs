//! The sheet of a surface: its map, the heights that strokes meet, and what a stylus makes of them.

use super::Surveyed;
use asperity_plot::{
    Axis, Canvas, ColorMap, ColorScale, Key, Panel, PlotError, Rect, Stroke, TextStyle, ink,
};
use asperity_surface::{stroke::Strokes, vibration, wave_spectrum::LineSpectrum};
use asperity_texture::model::{TextureModel, mixture::Field};

const WIDTH: f32 = 2400.0;
const HEADER: f32 = 110.0;
const ROW: f32 = 760.0;
/// Levels so far below the highest are drawn, dB.
const RANGE_DB: f64 = 70.0;
/// Points of a spectrum that are drawn, an octave.
const PER_OCTAVE: f64 = 12.0;

/// Draws what was found and the texture before its reduction, and returns the bytes of a PNG.
pub(super) fn sheet(found: &Surveyed, whole: &TextureModel) -> Result<Vec<u8>, PlotError> {
    let mut canvas = Canvas::new(WIDTH as u32, (HEADER + ROW) as u32)?;
    let small = TextStyle::new(24.0).color(ink::GREY);
    canvas.text(&whole.name, (40.0, 50.0), &TextStyle::new(40.0).bold());
    let line = format!(
        "{} × {} points, {:.3} mm apart; heights {:.2} µm RMS; {:.3} MPa; {:.1} dB re 1 m/s² at 100 mm/s and 1 N, {:+.1} dB along the axis; grey: continued",
        found.points[0],
        found.points[1],
        found.pitch_mm[0],
        found.rms_um,
        found.survey.modulus_mpa,
        found.survey.level_db,
        -found.survey.anisotropy_db,
    );
    canvas.text(
        &canvas.fitted(&line, &small, WIDTH - 80.0),
        (40.0, 90.0),
        &small,
    );
    let third = WIDTH / 3.0;
    let part = |n: u8| Rect::new(f32::from(n) * third, HEADER, third, ROW);
    map(&mut canvas, part(0), found);
    heights(&mut canvas, part(1), found);
    vibration_of(&mut canvas, part(2), found, whole);
    canvas.png()
}

/// The map in colours, with its axis.
fn map(canvas: &mut Canvas, rect: Rect, found: &Surveyed) {
    let [width_mm, height_mm] = [0, 1].map(|axis| found.points[axis] as f64 * found.pitch_mm[axis]);
    let thumbnail = &found.thumbnail;
    let (low, high) = thumbnail.ends_um();
    let scale = ColorScale::new(ColorMap::Viridis, low.into(), high.into());
    let mut panel = Panel::new(
        rect,
        Axis::new("x (mm)", 0.0, width_mm),
        Axis::new("y (mm)", 0.0, height_mm),
    )
    .letter('a')
    .title("Heights, and the axis")
    .without_grid();
    panel.margins.right = 150.0;
    let (columns, rows) = (thumbnail.width(), thumbnail.height());
    panel.heatmap(
        canvas,
        (0.0, width_mm),
        (0.0, height_mm),
        columns,
        rows,
        |x, y| {
            // Row 0 is the lowest here and the highest there.
            scale.color(thumbnail.heights_um()[(rows - 1 - y) * columns + x].into())
        },
    );
    panel.draw_frame(canvas);
    panel.colorbar(canvas, &scale, "Height (µm)");
    if let Some(direction) = &found.survey.direction {
        let [x, y, _] = direction.axis;
        let (middle, reach) = (
            [0.5 * width_mm, 0.5 * height_mm],
            0.4 * width_mm.min(height_mm),
        );
        let ends = [-reach, reach].map(|by| (middle[0] + by * x, middle[1] + by * y));
        panel.line(canvas, ends, Stroke::new(ink::VERMILION, 5.0));
    }
}

/// Densities of the heights, dB re 1 µm²·mm, by spatial frequency, smoothed.
fn density_db(line: &LineSpectrum) -> Vec<(f64, f64)> {
    let end = line.power_um2.len() as f64;
    let points = (libm::log2(end) * PER_OCTAVE) as i32;
    let edge = |point: i32| libm::exp2(f64::from(point) / PER_OCTAVE);
    let mean = |point: i32| {
        let bins = edge(point) as usize..(edge(point + 1) as usize + 1).min(line.power_um2.len());
        let powers = line.power_um2.get(bins)?;
        let density = powers.iter().sum::<f64>() / powers.len().max(1) as f64 / line.step_per_mm;
        let k_per_mm = edge(point) * libm::exp2(0.5 / PER_OCTAVE) * line.step_per_mm;
        Some((k_per_mm, 10.0 * libm::log10(density.max(1e-30))))
    };
    // The first bins hold the window.
    (2 * PER_OCTAVE as i32..points).filter_map(mean).collect()
}

fn heights(canvas: &mut Canvas, rect: Rect, found: &Surveyed) {
    let [bare, followed] = [&found.survey.bare, &found.survey.followed];
    let lines = [&bare[0], &bare[1], &followed[0], &followed[1]].map(density_db);
    let most = lines
        .iter()
        .flatten()
        .map(|(_, db)| *db)
        .fold(f64::MIN, f64::max);
    let measured_to = found.survey.measured_to_per_mm;
    let ends = lines[0].first().zip(lines[0].last());
    let (from, to) = ends.map_or((0.01, 10.0), |(first, last)| (first.0, last.0));
    let panel = Panel::new(
        rect,
        Axis::log("Spatial frequency (1/mm)", from, to),
        Axis::new("Heights (dB re 1 µm²·mm)", most - RANGE_DB, most + 5.0),
    )
    .letter('b')
    .title("Heights on the map and under the tip")
    .with_legend(2);
    panel.band(canvas, measured_to, to, ink::LIGHT);
    panel.draw_frame(canvas);
    let strokes = [
        Stroke::new(ink::BLUE, 2.0).dotted(),
        Stroke::new(ink::VERMILION, 2.0).dotted(),
        Stroke::new(ink::BLUE, 3.0),
        Stroke::new(ink::VERMILION, 3.0),
    ];
    for (line, stroke) in lines.into_iter().zip(strokes) {
        panel.line(canvas, line, stroke);
    }
    panel.legend(
        canvas,
        &[
            (Key::Line(strokes[0]), "map, across"),
            (Key::Line(strokes[1]), "along"),
            (Key::Line(strokes[2]), "tip, across"),
            (Key::Line(strokes[3]), "along"),
        ],
    );
}

/// Acceleration of the stylus at 100 mm/s under 1 N, and that of the texture.
fn vibration_of(canvas: &mut Canvas, rect: Rect, found: &Surveyed, whole: &TextureModel) {
    let support = found.survey.support();
    let speed_mm_s = super::grid::STROKE.0;
    let db = |power: f64| 10.0 * libm::log10(power.max(1e-30));
    let lines = found.survey.followed.each_ref().map(|line| {
        let power = Strokes::over(line).power(speed_mm_s, &support);
        let points = power.iter().enumerate();
        points
            .map(|(n, p)| (vibration::freq_hz(n), db(*p)))
            .collect::<Vec<_>>()
    });
    let field = Field::new(&whole.grid);
    let rendered = field.locate(speed_mm_s, support.force_n).map(|place| {
        let model = field.model(&place);
        let points = (1..500).map(f64::from);
        // Power a sample, as a density over half the rate.
        points
            .map(|hz| (hz, db(model.power(hz) / 500.0)))
            .collect::<Vec<_>>()
    });
    let most = lines[0].iter().map(|(_, db)| *db).fold(f64::MIN, f64::max);
    let end_hz = speed_mm_s * found.survey.measured_to_per_mm;
    let panel = Panel::new(
        rect,
        Axis::new("Frequency (Hz)", 0.0, 500.0),
        Axis::new("Acceleration (dB re 1 (m/s²)²/Hz)", most - 50.0, most + 5.0),
    )
    .letter('c')
    .title("In the hand at 100 mm/s and 1 N")
    .with_legend(2);
    panel.band(canvas, end_hz.min(500.0), 500.0, ink::LIGHT);
    panel.draw_frame(canvas);
    let strokes = [
        Stroke::new(ink::BLUE, 3.0),
        Stroke::new(ink::VERMILION, 3.0),
    ];
    for (line, stroke) in lines.into_iter().zip(strokes) {
        panel.line(canvas, line, stroke);
    }
    let texture = Stroke::new(ink::GREY, 3.0).dashed();
    panel.line(canvas, rendered.into_iter().flatten(), texture);
    panel.legend(
        canvas,
        &[
            (Key::Line(strokes[0]), "across"),
            (Key::Line(strokes[1]), "along"),
            (Key::Line(texture), "texture, across"),
        ],
    );
}

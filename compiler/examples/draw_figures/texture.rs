//! An introductory figure of a single texture: its look, its vibration level, its tap response.

use crate::sheet::{halved, picture};
use asperity::{emit::lower, model::TextureModel, signal::spectrum::ArmaModel};
use asperity_formats::Asset;
use asperity_plot::{
    Axis, Canvas, ColorMap, ColorScale, Key, Margins, Panel, Rect, Stroke, TextStyle, ink, legend,
    size,
};
use asperity_runtime::HostTexture;
use std::error::Error;

/// Width of a column and height of the picture, pixels.
const COLUMN: f32 = 600.0;
const HEIGHT: f32 = 520.0;
/// The preview, and what stands above it.
const PREVIEW: f32 = 384.0;
const HEAD: f32 = 56.0;
/// Cells of the map a side, and frequencies over which power is summed.
const CELLS: usize = 60;
const FREQUENCIES: usize = 250;
/// Which of the thirteen taps are drawn.
const TAPS: [(usize, &str); 3] = [(2, "gentle"), (6, "firm"), (12, "hard")];

/// The picture as PNG.
pub(crate) fn png(texture: &TextureModel) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut canvas = Canvas::new((3.0 * COLUMN) as u32, HEIGHT as u32)?;
    let title = TextStyle::new(size::TITLE);
    canvas.text("How it looks", (0.5 * (COLUMN - PREVIEW), 40.0), &title);
    picture(
        &mut canvas,
        (0.5 * (COLUMN - PREVIEW), HEAD),
        PREVIEW,
        texture,
    )?;
    vibration(
        &mut canvas,
        Rect::new(COLUMN - 60.0, 0.0, COLUMN + 90.0, HEIGHT),
        texture,
    )?;
    taps(
        &mut canvas,
        Rect::new(2.0 * COLUMN + 30.0, 0.0, COLUMN - 30.0, HEIGHT),
        texture,
    );
    halved(&canvas.png()?)
}

/// The RMS acceleration over speed and force, as the runtime renders it.
fn vibration(
    canvas: &mut Canvas,
    rect: Rect,
    texture: &TextureModel,
) -> Result<(), Box<dyn Error>> {
    let lowered = lower::lower(texture, None)?;
    let asset = Asset::parse(&lowered.bytes)?;
    let grid = asset.grid();
    let rate_hz = grid.sample_rate_hz();
    let mut slot = Box::new(HostTexture::new());
    slot.load(&asset, rate_hz)?;
    let reach = [grid.max_speed_mm_s(), grid.max_force_n()];
    let rms = |cell: [usize; 2]| {
        let [speed, force] = [0, 1].map(|k| reach[k] * (cell[k] as f32 + 0.5) / CELLS as f32);
        let filter = slot.filter_at(speed, force);
        let monic = |c: &[f32]| {
            [1.0]
                .into_iter()
                .chain(c.iter().copied())
                .map(f64::from)
                .collect()
        };
        let model = ArmaModel {
            a: monic(&filter.a),
            b: monic(&filter.b),
            level_m_s2: filter.level_m_s2.into(),
            sample_rate_hz: rate_hz.into(),
        };
        let hz = |n: usize| (n as f64 + 0.5) / FREQUENCIES as f64 * 0.5 * f64::from(rate_hz);
        let sum: f64 = (0..FREQUENCIES).map(|n| model.power(hz(n))).sum();
        (sum / FREQUENCIES as f64).sqrt()
    };
    let table: Vec<f64> = (0..CELLS * CELLS)
        .map(|n| rms([n % CELLS, n / CELLS]))
        .collect();
    let scale = ColorScale::new(
        ColorMap::Viridis,
        0.0,
        table.iter().copied().fold(0.0, f64::max),
    );
    let reach = reach.map(f64::from);
    let panel = Panel::new(
        rect,
        Axis::new("Speed (mm/s)", 0.0, reach[0]).ticks_about(5),
        Axis::new("Force (N)", 0.0, reach[1]).ticks_about(4),
    )
    .title("How strongly it vibrates")
    .margins(margins(180.0))
    .without_grid();
    panel.heatmap(
        canvas,
        (0.0, reach[0]),
        (0.0, reach[1]),
        CELLS,
        CELLS,
        |column, row| scale.color(table[row * CELLS + column]),
    );
    panel.draw_frame(canvas);
    panel.colorbar(canvas, &scale, "RMS (m/s²)");
    Ok(())
}

fn taps(canvas: &mut Canvas, rect: Rect, texture: &TextureModel) {
    let bank = &texture.taps;
    let sample_ms = 1000.0 / bank.sample_rate_hz;
    let chosen = TAPS.map(|(index, name)| (&bank.traces[index], name));
    let values = chosen
        .iter()
        .flat_map(|(trace, _)| trace.accel_m_s2.iter().copied());
    let panel = Panel::new(
        rect,
        Axis::new("Time (ms)", 0.0, 10.0).ticks_about(5),
        Axis::covering("Acceleration (m/s²)", values),
    )
    .title("How a tap feels")
    .margins(margins(20.0));
    panel.draw_frame(canvas);
    // Dashes and widths tell the lines apart in grey.
    let strokes = [
        Stroke::new(ink::BLUE, 2.0),
        Stroke::new(ink::VERMILION, 3.0).dashed(),
        Stroke::new(ink::BLACK, 4.0),
    ];
    for ((trace, _), stroke) in chosen.iter().zip(strokes) {
        panel.series(canvas, 0.0, sample_ms, &trace.accel_m_s2, stroke);
    }
    let area = panel.area();
    let names = chosen.map(|(trace, name)| format!("{name}, {:.2} m/s", trace.speed_m_s));
    for (line, (name, stroke)) in names.iter().zip(strokes).rev().enumerate() {
        let y = area.y + 34.0 + 34.0 * line as f32;
        legend(
            canvas,
            (area.right() - 260.0, y),
            rect.right(),
            &[(Key::Line(stroke), name)],
        );
    }
}

fn margins(right: f32) -> Margins {
    Margins {
        left: 110.0,
        right,
        top: HEAD,
        bottom: HEIGHT - HEAD - PREVIEW,
    }
}

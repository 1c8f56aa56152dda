//! Figures of the documents: what prompts decode to, and what lies between two of them.
//!
//! `cargo run --release -p asperity --example figures -- docs/images` writes `three-prompts.png` and
//! `midpoint.png`: a column a texture, with its picture, the spectra of its models and its taps.

use asperity::{
    attributes,
    edit::{Latents, Studio},
    inference::Backend,
    model::{Provenance, TextureModel, VertexKind},
    output::write_atomic,
    preview,
    prompt::Author,
    spectrum::ArmaModel,
};
use asperity_plot::{
    Align, Axis, Canvas, Color, ColorMap, ColorScale, Panel, Rect, Stroke, TextStyle, VAlign, ink,
    size,
};
use std::{error::Error, path::Path};

/// Prompts whose order of sharpness and level the paper reports: abrasive, cork, foam.
const THREE: [&str; 3] = [
    "rough abrasive sheet with gritty particles",
    "a cork board for notes",
    "packing foam from a box",
];
/// The ends of a blend.
const ENDS: [&str; 2] = ["towel", "whiteboard"];

/// Width of a column, and heights of what it shows, pixels.
const COLUMN: f32 = 560.0;
const PICTURE: f32 = 256.0;
const HEAD: f32 = 150.0;
const ROW: f32 = 460.0;
/// Frequencies of a spectrum.
const POINTS: usize = 300;
/// Vertical axes, the same for all textures.
const DENSITY_DB: (f64, f64) = (-70.0, 0.0);
const TAP_M_S2: (f64, f64) = (-40.0, 80.0);

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args()
        .nth(1)
        .ok_or("name a folder for the pictures")?;
    let author = Author::embedded(&Backend::Portable)?;
    let studio = Studio::new(&author, author.model().crc32());
    let latents = |prompt: &str| -> Result<Latents, Box<dyn Error>> {
        let meaning = author.meaning(prompt, author.project(prompt)?.z)?;
        Ok(Latents::whole(meaning.z).shifted(meaning.shift))
    };
    let texture = |name: &str, latents: &Latents| -> Result<TextureModel, Box<dyn Error>> {
        let provenance = Provenance {
            prompt: Some(name.to_owned()),
            ..Provenance::default()
        };
        Ok(studio.texture(latents, name, provenance)?)
    };
    let mut three = Vec::new();
    for prompt in THREE {
        three.push(texture(prompt, &latents(prompt)?)?);
    }
    let ends = [latents(ENDS[0])?, latents(ENDS[1])?];
    let middle = Latents::between(&ends[0], &ends[1], 0.5);
    let mut between = texture("halfway between them", &middle)?;
    // The picture of a mixture follows its neighbours, as no word names it.
    between.provenance.prompt = None;
    let blend = [
        texture(ENDS[0], &ends[0])?,
        between,
        texture(ENDS[1], &ends[1])?,
    ];
    for (textures, file) in [
        (&three[..], "three-prompts.png"),
        (&blend[..], "midpoint.png"),
    ] {
        write_atomic(&Path::new(&folder).join(file), &figure(textures)?)
            .map_err(|error| error.to_string())?;
    }
    Ok(())
}

fn figure(textures: &[TextureModel]) -> Result<Vec<u8>, Box<dyn Error>> {
    let width = COLUMN * textures.len() as f32;
    let mut canvas = Canvas::new(width as u32, (HEAD + PICTURE + 2.0 * ROW) as u32)?;
    for (column, texture) in textures.iter().enumerate() {
        let x = COLUMN * column as f32;
        head(&mut canvas, x, texture);
        picture(&mut canvas, x, texture)?;
        let top = HEAD + PICTURE;
        spectra(&mut canvas, Rect::new(x, top, COLUMN, ROW), texture);
        taps(&mut canvas, Rect::new(x, top + ROW, COLUMN, ROW), texture);
    }
    Ok(canvas.png()?)
}

fn head(canvas: &mut Canvas, x: f32, texture: &TextureModel) {
    let middle = |y: f32| (x + 0.5 * COLUMN, y);
    let centred = |style: TextStyle| style.align(Align::Center, VAlign::Middle);
    let title = centred(TextStyle::new(size::LABEL).bold());
    canvas.text(&texture.name, middle(40.0), &title);
    let a = attributes::of(texture);
    let number = |value: Option<f64>, digits: usize| {
        value.map_or("none".to_owned(), |value| format!("{value:.digits$}"))
    };
    let lines = [
        format!(
            "level {} dB, centroid {} Hz",
            number(a.rough_db, 1),
            number(a.sharp_hz, 0)
        ),
        format!("tap {} Hz, μ {:.2}", number(a.hard_hz, 0), a.mu),
    ];
    let small = centred(TextStyle::new(size::TICK).color(ink::GREY));
    for (n, line) in lines.iter().enumerate() {
        canvas.text(line, middle(80.0 + 32.0 * n as f32), &small);
    }
}

fn picture(canvas: &mut Canvas, x: f32, texture: &TextureModel) -> Result<(), Box<dyn Error>> {
    let drawn = preview::draw(texture, PICTURE as u32)?;
    let side = drawn.size() as usize;
    let left = x + 0.5 * (COLUMN - PICTURE);
    for (k, [r, g, b]) in drawn.pixels().iter().copied().enumerate() {
        let (column, row) = ((k % side) as f32, (k / side) as f32);
        let dot = Rect::new(left + column, HEAD + row, 1.0, 1.0);
        canvas.fill_rect(dot, Color { r, g, b, a: 255 });
    }
    Ok(())
}

/// A line for each interior vertex, in the colour of its speed.
fn spectra(canvas: &mut Canvas, rect: Rect, texture: &TextureModel) {
    let grid = &texture.grid;
    let nyquist_hz = 0.5 * grid.sample_rate_hz;
    let fastest = grid
        .vertices
        .iter()
        .map(|v| v.speed_mm_s)
        .fold(0.0, f64::max);
    let scale = ColorScale::new(ColorMap::Plasma, 0.0, fastest);
    let panel = Panel::new(
        rect,
        Axis::new("Frequency (Hz)", 0.0, nyquist_hz).ticks_about(5),
        Axis::new("Density (dB re 1 (m/s²)²/Hz)", DENSITY_DB.0, DENSITY_DB.1),
    )
    .title("AR spectra");
    panel.draw_frame(canvas);
    let interior = grid
        .vertices
        .iter()
        .filter(|v| v.kind == VertexKind::Interior);
    for vertex in interior {
        let model = ArmaModel::at_vertex(grid, vertex);
        let line = (0..POINTS).map(|n| {
            let hz = n as f64 / (POINTS - 1) as f64 * nyquist_hz;
            let density = 2.0 * model.power(hz) / grid.sample_rate_hz;
            (hz, 10.0 * libm::log10(density))
        });
        let stroke = Stroke::new(scale.color(vertex.speed_mm_s), size::LINE);
        panel.line(canvas, line, stroke);
    }
}

/// A line for each impact speed, in its colour.
fn taps(canvas: &mut Canvas, rect: Rect, texture: &TextureModel) {
    let taps = &texture.taps;
    let sample_ms = 1000.0 / taps.sample_rate_hz;
    let longest = taps
        .traces
        .iter()
        .map(|t| t.accel_m_s2.len())
        .max()
        .unwrap_or(1);
    let fastest = taps.traces.iter().map(|t| t.speed_m_s).fold(0.0, f64::max);
    let scale = ColorScale::new(ColorMap::Plasma, 0.0, fastest);
    let panel = Panel::new(
        rect,
        Axis::new("Time (ms)", 0.0, sample_ms * longest as f64).ticks_about(5),
        Axis::new("Acceleration (m/s²)", TAP_M_S2.0, TAP_M_S2.1),
    )
    .title("Taps");
    panel.draw_frame(canvas);
    for trace in taps.traces.iter().rev() {
        let stroke = Stroke::new(scale.color(trace.speed_m_s), size::LINE);
        panel.series(canvas, 0.0, sample_ms, &trace.accel_m_s2, stroke);
    }
}

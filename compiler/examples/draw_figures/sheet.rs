//! A picture with a column a texture: its preview, the spectra of its models, its taps.

use asperity::{
    model::{TextureModel, VertexKind, attributes},
    signal::spectrum::ArmaModel,
    views::preview,
};
use asperity_plot::{
    Align, Axis, Canvas, Color, ColorMap, ColorScale, Margins, Panel, Rect, Stroke, TextStyle,
    VAlign, ink, size,
};
use std::{error::Error, io::Cursor};

/// Width of a column, and heights of what it shows, pixels.
const COLUMN: f32 = 560.0;
const HEAD: f32 = 170.0;
const PICTURE: f32 = 256.0;
const ROW: f32 = 400.0;
/// Width that a line of a title may take.
const TITLE: f32 = COLUMN - 40.0;
/// Width of the colour bar beside the last column, pixels.
const BAR: f32 = 140.0;
/// Frequencies of a spectrum.
const POINTS: usize = 300;
/// Range of a spectrum below the highest of all, dB.
const RANGE_DB: f64 = 70.0;

/// The picture as PNG.
pub(crate) fn png(textures: &[TextureModel]) -> Result<Vec<u8>, Box<dyn Error>> {
    let width = COLUMN * textures.len() as f32 + BAR;
    let height = HEAD + PICTURE + 2.0 * ROW;
    let mut canvas = Canvas::new(width as u32, height as u32)?;
    let shared = Shared::of(textures);
    for (column, texture) in textures.iter().enumerate() {
        let x = COLUMN * column as f32;
        let last = column + 1 == textures.len();
        head(&mut canvas, x, texture);
        let left = x + 0.5 * (COLUMN - PICTURE);
        picture(&mut canvas, (left, HEAD), PICTURE, texture)?;
        let rect = |row: f32| {
            let bar = if last { BAR } else { 0.0 };
            Rect::new(x, HEAD + PICTURE + row * ROW, COLUMN + bar, ROW)
        };
        shared.spectra(&mut canvas, rect(0.0), texture, last);
        shared.taps(&mut canvas, rect(1.0), texture, last);
    }
    halved(&canvas.png()?)
}

/// The same picture in half the size, each pixel the mean of four: as wide as a page shows it.
pub(crate) fn halved(drawn: &[u8]) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut reader = png::Decoder::new(Cursor::new(drawn)).read_info()?;
    let width = reader.info().width;
    let row = 3 * width as usize;
    let mut rgb = vec![0; row * reader.info().height as usize];
    reader.next_frame(&mut rgb)?;
    let rows: Vec<&[u8]> = rgb.chunks_exact(row).collect();
    let mut half = Vec::with_capacity(rgb.len() / 4);
    for pair in rows.chunks_exact(2) {
        for (above, below) in pair[0].chunks_exact(6).zip(pair[1].chunks_exact(6)) {
            for channel in 0..3 {
                let of = |row: &[u8]| u16::from(row[channel]) + u16::from(row[channel + 3]);
                half.push(((of(above) + of(below) + 2) / 4) as u8);
            }
        }
    }
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width / 2, (rows.len() / 2) as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::High);
    encoder.write_header()?.write_image_data(&half)?;
    Ok(bytes)
}

fn head(canvas: &mut Canvas, x: f32, texture: &TextureModel) {
    let middle = |y: f32| (x + 0.5 * COLUMN, y);
    let centred = |style: TextStyle| style.align(Align::Center, VAlign::Middle);
    let title = centred(TextStyle::new(size::LABEL).bold());
    let lines = broken(canvas, &texture.name, &title);
    let first = 44.0 - 16.0 * (lines.len() as f32 - 1.0);
    for (n, line) in lines.iter().enumerate() {
        canvas.text(line, middle(first + 32.0 * n as f32), &title);
    }
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
        canvas.text(line, middle(100.0 + 32.0 * n as f32), &small);
    }
}

/// A title in lines that fit its column.
fn broken(canvas: &Canvas, title: &str, style: &TextStyle) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in title.split_whitespace() {
        let line = lines.last().map_or("", String::as_str);
        let longer = format!("{line} {word}").trim().to_owned();
        if line.is_empty() || canvas.text_width(&longer, style) <= TITLE {
            lines.pop();
            lines.push(longer);
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

/// A texture's preview of a side in pixels.
pub(crate) fn picture(
    canvas: &mut Canvas,
    (left, top): (f32, f32),
    side: f32,
    texture: &TextureModel,
) -> Result<(), Box<dyn Error>> {
    let drawn = preview::draw(texture, side as u32)?;
    let side = drawn.size() as usize;
    for (k, [r, g, b]) in drawn.pixels().iter().copied().enumerate() {
        let (column, row) = ((k % side) as f32, (k / side) as f32);
        let dot = Rect::new(left + column, top + row, 1.0, 1.0);
        canvas.fill_rect(dot, Color { r, g, b, a: 255 });
    }
    Ok(())
}

/// Axes and colours that all columns have.
struct Shared {
    /// Highest density, dB, rounded up.
    top_db: f64,
    /// Range of the taps, m/s², rounded outwards.
    taps_m_s2: (f64, f64),
    speed_mm_s: ColorScale,
    impact_m_s: ColorScale,
}

impl Shared {
    fn of(textures: &[TextureModel]) -> Self {
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let densities = textures
            .iter()
            .flat_map(spectra_db)
            .flat_map(|(_, line)| line);
        let top_db = densities
            .map(|(_, db)| db)
            .fold(f64::NEG_INFINITY, f64::max);
        let traces = || textures.iter().flat_map(|texture| &texture.taps.traces);
        let accelerations = || traces().flat_map(|trace| trace.accel_m_s2.iter().copied());
        let vertices = textures.iter().flat_map(|texture| &texture.grid.vertices);
        let fastest = largest(&mut vertices.map(|vertex| vertex.speed_mm_s));
        let hardest = largest(&mut traces().map(|trace| trace.speed_m_s));
        let ten = |x: f64| 10.0 * (x / 10.0).ceil();
        Self {
            top_db: ten(top_db),
            taps_m_s2: (
                -ten(largest(&mut accelerations().map(|a| -a))),
                ten(largest(&mut accelerations())),
            ),
            speed_mm_s: ColorScale::new(ColorMap::Plasma, 0.0, fastest),
            impact_m_s: ColorScale::new(ColorMap::Plasma, 0.0, hardest),
        }
    }

    fn spectra(&self, canvas: &mut Canvas, rect: Rect, texture: &TextureModel, bar: bool) {
        let hz = Axis::new("Frequency (Hz)", 0.0, 0.5 * texture.grid.sample_rate_hz);
        let low_db = self.top_db - RANGE_DB;
        let db = Axis::new("Density (dB re 1 (m/s²)²/Hz)", low_db, self.top_db);
        let panel = panel(rect, hz.ticks_about(5), db, bar).title("AR spectra");
        panel.draw_frame(canvas);
        for (speed_mm_s, line) in spectra_db(texture) {
            let stroke = Stroke::new(self.speed_mm_s.color(speed_mm_s), size::LINE);
            panel.line(canvas, line, stroke);
        }
        if bar {
            panel.colorbar(canvas, &self.speed_mm_s, "Speed (mm/s)");
        }
    }

    fn taps(&self, canvas: &mut Canvas, rect: Rect, texture: &TextureModel, bar: bool) {
        let taps = &texture.taps;
        let sample_ms = 1000.0 / taps.sample_rate_hz;
        let lengths = taps.traces.iter().map(|trace| trace.accel_m_s2.len());
        let longest = lengths.max().unwrap_or(1);
        let ms = Axis::new("Time (ms)", 0.0, sample_ms * longest as f64).ticks_about(5);
        let (low, high) = self.taps_m_s2;
        let panel = panel(rect, ms, Axis::new("Acceleration (m/s²)", low, high), bar).title("Taps");
        panel.draw_frame(canvas);
        for trace in taps.traces.iter().rev() {
            let stroke = Stroke::new(self.impact_m_s.color(trace.speed_m_s), size::LINE);
            panel.series(canvas, 0.0, sample_ms, &trace.accel_m_s2, stroke);
        }
        if bar {
            panel.colorbar(canvas, &self.impact_m_s, "Impact (m/s)");
        }
    }
}

/// A panel whose area is as wide with a colour bar as without.
fn panel(rect: Rect, x: Axis, y: Axis, bar: bool) -> Panel {
    let margins = Margins {
        left: 110.0,
        right: if bar { 30.0 + BAR } else { 30.0 },
        top: 50.0,
        bottom: 84.0,
    };
    Panel::new(rect, x, y).margins(margins)
}

/// A line for each interior vertex, in dB over Hz, with its speed in mm/s.
fn spectra_db(texture: &TextureModel) -> Vec<(f64, Vec<(f64, f64)>)> {
    let grid = &texture.grid;
    let nyquist_hz = 0.5 * grid.sample_rate_hz;
    let interior = grid
        .vertices
        .iter()
        .filter(|v| v.kind == VertexKind::Interior);
    interior
        .map(|vertex| {
            let model = ArmaModel::at_vertex(grid, vertex);
            let line = (0..POINTS).map(|n| {
                let hz = n as f64 / (POINTS - 1) as f64 * nyquist_hz;
                let density = 2.0 * model.power(hz) / grid.sample_rate_hz;
                (hz, 10.0 * libm::log10(density))
            });
            (vertex.speed_mm_s, line.collect())
        })
        .collect()
}

//! The header: name, structure, sizes and provenance.

use asperity_io::shown::counted;
use asperity_plot::{Align, Canvas, Rect, Stroke, TextStyle, VAlign, ink, size};
use asperity_texture::model::{Direction, Numerator, TextureModel, VertexKind};

/// Sizes of the asset that a sheet is drawn from, bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AssetBytes {
    /// The part that a tick needs.
    pub haptic: usize,
    /// The whole file.
    pub total: usize,
}

const LEFT: f32 = 40.0;

pub(super) fn draw(
    canvas: &mut Canvas,
    rect: Rect,
    model: &TextureModel,
    bytes: Option<AssetBytes>,
) {
    let right = if model.provenance.taps_synthetic && !model.taps.traces.is_empty() {
        badge(canvas, rect, "SYNTHETIC TAPS") - 30.0
    } else {
        rect.right() - LEFT
    };
    let heading = TextStyle::new(size::HEADING).bold();
    let name = canvas.fitted(&model.name, &heading, right - LEFT);
    canvas.text(&name, (LEFT, rect.y + 68.0), &heading);

    let width = rect.width - 2.0 * LEFT;
    let plain = TextStyle::new(size::LABEL);
    let quiet = TextStyle::new(size::TICK).color(ink::GREY);
    let structure = canvas.fitted(&structure(model, bytes), &plain, width);
    canvas.text(&structure, (LEFT, rect.y + 112.0), &plain);
    for (line, text) in [origin(model), remarks(model)].iter().enumerate() {
        let text = canvas.fitted(text, &quiet, width);
        canvas.text(&text, (LEFT, rect.y + 147.0 + 31.0 * line as f32), &quiet);
    }
}

/// Draws a framed word in the upper right corner and returns its left edge.
fn badge(canvas: &mut Canvas, rect: Rect, text: &str) -> f32 {
    let style = TextStyle::new(size::TICK)
        .bold()
        .color(ink::VERMILION)
        .align(Align::Center, VAlign::Middle);
    let width = canvas.text_width(text, &style) + 32.0;
    let frame = Rect::new(rect.right() - LEFT - width, rect.y + 30.0, width, 42.0);
    canvas.stroke_rect(frame, Stroke::new(ink::VERMILION, 2.0));
    canvas.text(text, frame.center(), &style);
    frame.x
}

/// The parts of the texture and their sizes.
fn structure(model: &TextureModel, bytes: Option<AssetBytes>) -> String {
    let grid = &model.grid;
    let zeros = grid
        .vertices
        .iter()
        .find_map(|vertex| vertex.ma_lsf_rad.as_ref())
        .map_or(0, Vec::len);
    let filter = match grid.numerator {
        Numerator::None => format!("AR({})", grid.order),
        Numerator::Nyquist => format!("AR({}) with a fixed zero at Nyquist", grid.order),
        Numerator::Lsf => format!("ARMA({}, {zeros})", grid.order),
    };
    let interior = grid
        .vertices
        .iter()
        .filter(|vertex| vertex.kind == VertexKind::Interior)
        .count();
    let mut parts = vec![
        format!("{filter}, {}", rate(grid.sample_rate_hz)),
        format!(
            "{interior} interior + {} edge vertices, {}",
            grid.vertices.len() - interior,
            counted(grid.triangles.len(), "triangle", "triangles")
        ),
    ];
    parts.push(match model.taps.traces.first() {
        Some(trace) => format!(
            "{} of {} at {}",
            counted(model.taps.traces.len(), "tap", "taps"),
            counted(trace.accel_m_s2.len(), "sample", "samples"),
            rate(model.taps.sample_rate_hz)
        ),
        None => "no taps".to_owned(),
    });
    if let Some(bytes) = bytes {
        parts.push(format!(
            "{} bytes haptic, {} in all",
            bytes.haptic, bytes.total
        ));
    }
    parts.join("   ·   ")
}

/// Which generator made the texture, and from what.
fn origin(model: &TextureModel) -> String {
    let provenance = &model.provenance;
    let mut parts = Vec::new();
    if let Some(prompt) = &provenance.prompt {
        parts.push(format!("“{prompt}”"));
    }
    if !provenance.generator.is_empty() {
        parts.push(provenance.generator.clone());
    }
    if !provenance.source.is_empty() {
        parts.push(match provenance.source_crc32 {
            0 => format!("from {}", provenance.source),
            crc32 => format!("from {} (CRC-32 {crc32:08x})", provenance.source),
        });
    }
    if !provenance.fidelity.is_empty() {
        parts.push(format!("fidelity {}", provenance.fidelity));
    }
    parts.push(format!("seed {}", provenance.seed));
    if provenance.lsf_error_db > 0.0 {
        parts.push(format!(
            "quantised to {:.4} dB RMS",
            provenance.lsf_error_db
        ));
    }
    parts.join("   ·   ")
}

/// The direction, and remarks that a reader should know.
fn remarks(model: &TextureModel) -> String {
    let notes: Vec<&str> = model.provenance.notes.split_whitespace().collect();
    let direction = model.direction.as_ref().map(Direction::to_string);
    let parts = direction.into_iter().chain([notes.join(" ")]);
    let parts: Vec<String> = parts.filter(|part| !part.is_empty()).collect();
    parts.join("   ·   ")
}

fn rate(sample_rate_hz: f64) -> String {
    if sample_rate_hz >= 1000.0 {
        format!("{} kHz", sample_rate_hz / 1000.0)
    } else {
        format!("{sample_rate_hz} Hz")
    }
}

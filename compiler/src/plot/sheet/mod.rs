//! One texture on one sheet: poles, spectra, taps, grid, friction and wall.

mod contact;
mod distinct;
mod grid;
mod header;
mod poles;
mod spectra;
mod taps;

use super::theme::{Canvas, ColorMap, ColorScale, Margins, PlotError, Rect};
use crate::model::{GridVertex, TextureModel};

/// Width of the sheet, pixels.
pub const WIDTH_PX: u32 = 2400;
/// Height of the sheet, pixels.
pub const HEIGHT_PX: u32 = 1600;

const HEADER_HEIGHT: f32 = 186.0;
const UPPER_HEIGHT: f32 = 670.0;
const LOWER_HEIGHT: f32 = 736.0;

/// Sizes of the asset that a sheet is drawn from, bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AssetBytes {
    /// Everything that a tick needs.
    pub haptic: usize,
    /// The whole file.
    pub total: usize,
}

/// Draws a texture; the PNG's bytes.
///
/// `bytes` are the sizes of its asset, if there is one. Every model draws, also one
/// without taps, anchors or any sound. The same model gives the same bytes.
///
/// # Errors
/// [`PlotError`] if the embedded font or the PNG encoder fails.
pub fn sheet(model: &TextureModel, bytes: Option<AssetBytes>) -> Result<Vec<u8>, PlotError> {
    compose(model, bytes)?.png()
}

fn compose(model: &TextureModel, bytes: Option<AssetBytes>) -> Result<Canvas, PlotError> {
    let mut canvas = Canvas::new(WIDTH_PX, HEIGHT_PX)?;
    let width = WIDTH_PX as f32;
    header::draw(
        &mut canvas,
        Rect::new(0.0, 0.0, width, HEADER_HEIGHT),
        model,
        bytes,
    );

    let top = HEADER_HEIGHT;
    poles::draw(
        &mut canvas,
        Rect::new(0.0, top, 1150.0, UPPER_HEIGHT),
        &model.grid,
    );
    spectra::draw(
        &mut canvas,
        Rect::new(1150.0, top, width - 1150.0, UPPER_HEIGHT),
        &model.grid,
    );

    let top = top + UPPER_HEIGHT;
    taps::draw(
        &mut canvas,
        Rect::new(0.0, top, 830.0, LOWER_HEIGHT),
        &model.taps,
        model.provenance.taps_synthetic,
    );
    grid::draw(
        &mut canvas,
        Rect::new(830.0, top, 760.0, LOWER_HEIGHT),
        &model.grid,
    );
    contact::draw(
        &mut canvas,
        Rect::new(1590.0, top, width - 1590.0, LOWER_HEIGHT),
        model,
    );
    Ok(canvas)
}

/// Margins with room for a line of legend between title and frame.
fn margins(right: f32) -> Margins {
    Margins {
        top: 96.0,
        right,
        ..Margins::default()
    }
}

/// Standard deviation of the excitation with its gain, m/s².
fn level(vertex: &GridVertex) -> f64 {
    vertex.gain * vertex.sigma_m_s2
}

/// Colours of levels, from silence to the loudest vertex.
fn level_scale(vertices: &[GridVertex]) -> ColorScale {
    let loudest = vertices
        .iter()
        .map(level)
        .filter(|level| level.is_finite())
        .fold(0.0, f64::max);
    ColorScale::new(ColorMap::Viridis, 0.0, loudest)
}

/// Highest speed (mm/s) and force (N) of the grid.
fn reach(vertices: &[GridVertex]) -> (f64, f64) {
    let highest = |value: fn(&GridVertex) -> f64| vertices.iter().map(value).fold(0.0, f64::max);
    (
        highest(|vertex| vertex.speed_mm_s),
        highest(|vertex| vertex.force_n),
    )
}

#[cfg(test)]
mod tests;

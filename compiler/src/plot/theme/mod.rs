//! The look of every Asperity picture: white ground, one type face, perceptually
//! uniform colour maps, axes with units.
//!
//! Three layers, each usable alone. A [`Canvas`] takes pixels, lines, markers and
//! text and gives PNG bytes, and SVG where it records. An [`Axis`] turns values into positions and picks
//! round ticks. A [`Panel`] joins two axes to a rectangle, draws the frame, and
//! takes data in data coordinates: lines, sampled series, points, heat maps.
//!
//! The same calls give the same bytes: the fonts are embedded, nothing depends
//! on time or locale, and coordinates are rounded to 1/64 px before rasterising,
//! so that a last-bit difference between maths libraries stays invisible.
//!
//! ```
//! use asperity::plot::theme::{Axis, Canvas, ColorMap, ColorScale, Panel, Rect, Stroke, ink};
//!
//! # fn main() -> Result<(), asperity::plot::theme::PlotError> {
//! let mut canvas = Canvas::new(1200, 800)?;
//!
//! // A time series: x is implied by the sample period.
//! let vibration: Vec<f64> = (0..2000).map(|i| (i as f64 * 0.3).sin()).collect();
//! let panel = Panel::new(
//!     Rect::new(0.0, 0.0, 1200.0, 400.0),
//!     Axis::new("Time (s)", 0.0, 2.0),
//!     Axis::covering("Vibration (m/s²)", vibration.iter().copied()),
//! )
//! .letter('a')
//! .title("Vibration");
//! panel.draw_frame(&mut canvas);
//! panel.series(&mut canvas, 0.0, 1e-3, &vibration, Stroke::new(ink::BLUE, 2.0));
//! panel.vertical_line(&mut canvas, 0.5, Stroke::new(ink::VERMILION, 2.0).dashed());
//!
//! // A heat map below it with its colour bar in the right margin.
//! let levels_db = ColorScale::new(ColorMap::Inferno, -60.0, 0.0);
//! let mut below = Panel::new(
//!     Rect::new(0.0, 400.0, 1200.0, 400.0),
//!     Axis::new("Time (s)", 0.0, 2.0),
//!     Axis::new("Frequency (Hz)", 0.0, 500.0),
//! )
//! .letter('b')
//! .title("Spectrogram")
//! .without_grid();
//! below.margins.right = 150.0;
//! below.heatmap(&mut canvas, (0.0, 2.0), (0.0, 500.0), 40, 64, |column, row| {
//!     levels_db.color(-((column + row) as f64))
//! });
//! below.draw_frame(&mut canvas);
//! below.colorbar(&mut canvas, &levels_db, "dB re 1 (m/s²)²/Hz");
//!
//! let png: Vec<u8> = canvas.png()?;
//! # assert_eq!(&png[1..4], b"PNG");
//! # Ok(())
//! # }
//! ```

mod axis;
mod canvas;
mod color;
mod font;
mod geometry;
mod legend;
mod panel;
mod svg;

pub use axis::{Axis, Scale};
pub use canvas::{Align, Canvas, Marker, Stroke, TextStyle, VAlign};
pub use color::{Color, ColorMap, ColorScale, ink};
pub use geometry::Rect;
pub use legend::{Key, legend};
pub use panel::{Margins, Panel};

/// Sizes of type and lines in pixels, for a sheet of about 2400 px width.
pub mod size {
    /// Names of pictures.
    pub const HEADING: f32 = 48.0;
    /// Titles of panels.
    pub const TITLE: f32 = 29.0;
    /// Axis labels.
    pub const LABEL: f32 = 25.0;
    /// Tick labels and annotations.
    pub const TICK: f32 = 22.0;
    /// Data lines.
    pub const LINE: f32 = 2.5;
    /// Frames and tick marks.
    pub const FRAME: f32 = 1.5;
}

/// Why a picture could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    /// The canvas has no area, or its pixels do not fit into memory.
    #[error("cannot draw on a canvas of {width_px} × {height_px} pixels: choose 1..=16384 each")]
    CanvasSize {
        /// Requested width, pixels.
        width_px: u32,
        /// Requested height, pixels.
        height_px: u32,
    },
    /// The embedded type face was refused by the font parser.
    #[error("the embedded font cannot be read: {0}; rebuild with the locked dependencies")]
    Font(ttf_parser::FaceParsingError),
    /// The PNG encoder failed.
    #[error("cannot encode the picture as PNG: {0}")]
    Png(#[from] png::EncodingError),
}

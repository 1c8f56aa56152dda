//! The look of every Asperity picture: a white ground, one type face, perceptually uniform
//! colour maps, axes with units.
//!
//! There are three layers, and each can be used alone.
//!
//! * A [`Canvas`] takes lines, areas, markers and text at pixel positions. It gives the bytes
//!   of a PNG.
//! * An [`Axis`] turns values into positions and picks round ticks.
//! * A [`Panel`] spans a rectangle with two axes, draws the frame, and takes data in the
//!   units of its axes: lines, sampled series, points, heat maps.
//!
//! The same calls give the same bytes on every machine. The fonts are embedded, nothing
//! depends on time or locale, and positions are rounded to 1/64 px before rasterising, which
//! hides differences in the last bits of the platform's maths.
//!
//! ```
//! use asperity_plot::{Axis, Canvas, ColorMap, ColorScale, Panel, Rect, Stroke, ink};
//!
//! # fn main() -> Result<(), asperity_plot::PlotError> {
//! let mut canvas = Canvas::new(1200, 800)?;
//!
//! // A time series: x follows from the sample period.
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
//!
//! What must stay absent: textures and their models, the renderer, files, system fonts.

mod axis;
mod canvas;
mod color;
mod color_map;
mod colorbar;
mod data;
mod error;
mod font;
mod frame;
mod legend;
mod marker;
mod panel;
mod pixel;
mod range;
mod readable;
mod rect;
mod series;
mod shapes;
pub mod size;
mod stroke;
mod text;
mod text_style;

pub use axis::{Axis, Scale};
pub use canvas::Canvas;
pub use color::{Color, ink};
pub use color_map::{ColorMap, ColorScale};
pub use error::PlotError;
pub use legend::{Key, legend};
pub use marker::Marker;
pub use panel::{Margins, Panel};
pub use rect::Rect;
pub use stroke::Stroke;
pub use text_style::{Align, TextStyle, VAlign};

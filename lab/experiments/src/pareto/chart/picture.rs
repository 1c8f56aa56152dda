//! A finished picture.

use asperity_plot::{Canvas, PlotError};

/// A picture in two formats.
pub struct Picture {
    /// The picture as SVG.
    pub svg: String,
    /// The bytes of a PNG.
    pub png: Vec<u8>,
}

/// The picture on a canvas that records.
pub(super) fn finished(canvas: &Canvas) -> Result<Picture, PlotError> {
    Ok(Picture {
        svg: canvas.svg().unwrap_or_default(),
        png: canvas.png()?,
    })
}

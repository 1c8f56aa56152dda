//! A finished picture.

use asperity_plot::{Canvas, PlotError};

/// One picture.
pub struct Picture {
    /// Scalable.
    pub svg: String,
    /// Pixels.
    pub png: Vec<u8>,
}

pub(super) fn finished(canvas: &Canvas) -> Result<Picture, PlotError> {
    Ok(Picture {
        svg: canvas.svg().unwrap_or_default(),
        png: canvas.png()?,
    })
}

//! Errors of drawing a picture.

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
    /// The font parser refused the embedded type face.
    #[error("the embedded font cannot be read: {0}; rebuild with the locked dependencies")]
    Font(ttf_parser::FaceParsingError),
    /// The PNG encoder failed.
    #[error("cannot encode the picture as PNG: {0}")]
    Png(#[from] png::EncodingError),
}

//! Options that several commands share.

use super::pixels;
use clap::Args;

/// Preview options: no preview, or its size.
#[derive(Debug, Args)]
pub(crate) struct PreviewOptions {
    /// Leave out the preview picture
    #[arg(long)]
    pub(crate) no_preview: bool,
    /// Width and height of the preview in pixels, 64 to 1024 [default: that of the source, or 256]
    #[arg(long, value_name = "PX", value_parser = pixels, conflicts_with = "no_preview")]
    pub(crate) preview_size: Option<u32>,
}

impl PreviewOptions {
    /// The size, where without an option it is `otherwise`; `None` for no preview.
    pub(crate) fn px(&self, otherwise: Option<u32>) -> Option<u32> {
        self.preview_size.or(otherwise).filter(|_| !self.no_preview)
    }
}

/// Report options.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct ReportOptions {
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Print how long each pass took, on standard error
    #[arg(long)]
    pub(crate) timings: bool,
}

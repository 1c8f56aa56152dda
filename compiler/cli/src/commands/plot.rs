//! `asperity plot`.

use crate::cli::Plot;
use asperity::{
    plot::{self, AssetBytes},
    preview,
    raise::raise,
    textures::Textures,
};
use asperity_console::Console;
use asperity_formats::Asset;
use asperity_io::{
    diagnostic::{Diagnostic, Failures, one},
    output::{Outputs, display},
    shown::size,
};
use asperity_plot::PlotError;
use serde_json::json;
use thiserror::Error;

/// The sheet could not be drawn.
#[derive(Debug, Error)]
#[error("the sheet cannot be drawn: {0}")]
struct DrawError(#[from] PlotError);

impl Diagnostic for DrawError {
    fn remedy(&self) -> String {
        "free memory and try again".into()
    }
}

pub(crate) fn run(args: &Plot, console: Console) -> Result<(), Failures> {
    let mut outputs = Outputs::beside([&args.file]);
    let picture = outputs.open(&args.output).map_err(one)?;
    let console = console.beside(&outputs);
    let mut textures = Textures::open(&args.file).map_err(one)?;
    let bytes = textures.choose(args.texture.as_deref()).map_err(one)?;
    let asset =
        Asset::parse(&bytes).map_err(|e| one(textures.error(args.texture.as_deref(), e.into())))?;
    let png = drawn(&asset)?;
    outputs.fill(picture, &png).map_err(one)?;
    outputs.commit().map_err(one)?;
    let path = display(&args.output);
    if args.json {
        let report = json!({
            "output": path.to_string(),
            "name": asset.name(),
            "bytes": png.len(),
        });
        console.json(&report).map_err(one)
    } else {
        let report = format!("{path}: {}\n", size(png.len() as u64));
        console.report(&report).map_err(one)
    }
}

/// The sheet of an asset as PNG.
pub(super) fn drawn(asset: &Asset<'_>) -> Result<Vec<u8>, Failures> {
    let sizes = AssetBytes {
        haptic: asset.haptic_len(),
        total: asset.total_len(),
    };
    // A picture that cannot be read leaves its place empty; `asperity preview` says why.
    let picture = asset
        .preview_png()
        .and_then(|png| preview::stored(png).ok());
    plot::sheet_with_picture(&raise(asset), Some(sizes), picture.as_ref())
        .map_err(|e| one(DrawError(e)))
}

//! The sheet of an asset, with its sizes and its picture.

use super::{AssetBytes, sheet_with_picture};
use crate::{emit::raise::raise, views::preview};
use asperity_formats::Asset;
use asperity_io::diagnostic::Fault;

/// The sheet of an asset as PNG.
///
/// # Errors
/// [`Fault`] if the embedded font or the encoder of PNG fails.
pub fn of_asset(asset: &Asset<'_>) -> Result<Vec<u8>, Fault> {
    let sizes = AssetBytes {
        haptic: asset.haptic_len(),
        total: asset.total_len(),
    };
    // A picture that cannot be read leaves its place empty; `asperity preview` says why.
    let picture = asset
        .preview_png()
        .and_then(|png| preview::stored(png).ok());
    sheet_with_picture(&raise(asset), Some(sizes), picture.as_ref()).map_err(|error| {
        let what = format!("the sheet cannot be drawn: {error}");
        Fault::new(what, "free memory and try again")
    })
}

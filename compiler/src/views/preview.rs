//! Preview of a texture: drawn by `asperity-preview` from the contents of an asset.
//!
//! The prompt, or else the name, and the nearest materials, which are the anchors of its friction,
//! decide what is drawn. The level, the spectrum, the friction and the taps change its grain, depth
//! and gloss.
//!
//! ```
//! use asperity::{sources::builtin, views::preview};
//!
//! let png = preview::png(&builtin::texture(), 64)?;
//! assert_eq!(preview::width(&png), Some(64));
//! # Ok::<(), asperity_io::diagnostic::Fault>(())
//! ```

use asperity_io::diagnostic::Fault;
use asperity_language::words::grade;
use asperity_preview::{Description, EncodeError, Feel};
use asperity_texture::model::{TextureModel, VertexKind, attributes};

pub use asperity_preview::{Picture, SIZE, SIZES, WIDTH_MM};

/// Centroid of a tap where a texture has none, Hz.
const NO_TAP_HZ: f64 = 800.0;

/// Returns the fault of a picture that the encoder does not take.
pub fn not_encoded(error: EncodeError) -> Fault {
    Fault::new(format!("the preview: {error}"), "compile with --no-preview")
}

fn unreadable(error: png::DecodingError) -> Fault {
    let what = format!("the preview in the asset cannot be read: {error}");
    Fault::new(what, "draw it anew with --redraw")
}

/// Draws a texture as an asset holds it, `size_px` pixels wide and high.
///
/// # Errors
/// A usage error for a size out of [`SIZES`].
pub fn draw(texture: &TextureModel, size_px: u32) -> Result<Picture, Fault> {
    let anchors = texture.friction.anchors.iter();
    let nearest: Vec<(&str, f64)> = anchors.map(|a| (a.name.as_str(), a.weight)).collect();
    let prompt = texture.provenance.prompt.as_deref();
    let words = prompt.unwrap_or(&texture.name);
    let description = Description {
        words,
        coarser: grade::coarser(words),
        nearest: &nearest,
        feel: feel(texture),
        seed: texture.provenance.seed,
    };
    Picture::draw(&description, size_px).map_err(|error| {
        let remedy = format!("give {} to {} pixels", SIZES.start(), SIZES.end());
        Fault::new(format!("the preview: {error}"), remedy).usage()
    })
}

/// The picture as an asset keeps it: PNG with a palette.
///
/// # Errors
/// As [`draw`], and when the encoder fails.
pub fn png(texture: &TextureModel, size_px: u32) -> Result<Vec<u8>, Fault> {
    draw(texture, size_px)?.compact_png().map_err(not_encoded)
}

/// Width of a picture that an asset holds, pixels; `None` for what is no PNG, or of a size that no
/// picture is drawn at.
#[must_use]
pub fn width(bytes: &[u8]) -> Option<u32> {
    let reader = png::Decoder::new(std::io::Cursor::new(bytes))
        .read_info()
        .ok()?;
    let (width, _) = reader.info().size();
    SIZES.contains(&width).then_some(width)
}

/// A picture that an asset holds, as RGB bytes with its width and height.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stored {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Three bytes a pixel, row by row.
    pub rgb: Vec<u8>,
}

/// Most pixels of a picture that is read back: those of the largest one that is drawn.
const MOST_PIXELS: usize = (*SIZES.end() as usize) * (*SIZES.end() as usize);

/// Reads the picture of an asset.
///
/// # Errors
/// [`Fault`] for what is no PNG, or larger than any picture that is drawn.
pub fn stored(bytes: &[u8]) -> Result<Stored, Fault> {
    let limits = png::Limits {
        bytes: 16 * MOST_PIXELS,
    };
    let mut decoder = png::Decoder::new_with_limits(std::io::Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::STRIP_16);
    let mut reader = decoder.read_info().map_err(unreadable)?;
    let (width, height) = reader.info().size();
    let length = reader.output_buffer_size();
    let fits = width as usize * height as usize <= MOST_PIXELS;
    let Some(length) = length.filter(|_| fits) else {
        return Err(unreadable(png::DecodingError::LimitsExceeded));
    };
    let mut pixels = vec![0; length];
    let frame = reader.next_frame(&mut pixels).map_err(unreadable)?;
    let samples = frame.color_type.samples();
    let rgb = pixels[..frame.buffer_size()]
        .chunks(samples)
        .flat_map(|pixel| match *pixel {
            [r, g, b, ..] => [r, g, b],
            [grey, ..] => [grey; 3],
            [] => [0; 3],
        })
        .collect();
    Ok(Stored { width, height, rgb })
}

/// Returns the visible part of the feel; `None` for a texture without vibration.
fn feel(texture: &TextureModel) -> Option<Feel> {
    let attributes = attributes::of(texture);
    let interior = texture.grid.vertices.iter();
    let speeds: Vec<f64> = interior
        .filter(|vertex| vertex.kind == VertexKind::Interior)
        .map(|vertex| vertex.speed_mm_s)
        .collect();
    let speed = speeds.iter().sum::<f64>() / speeds.len().max(1) as f64;
    Some(Feel {
        wavelength_mm: speed / attributes.sharp_hz.filter(|hz| *hz > 0.0)?,
        level_db: attributes.rough_db?,
        mu: attributes.mu,
        hard_hz: attributes.hard_hz.unwrap_or(NO_TAP_HZ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        driver,
        emit::{lower::lower, raise::raise},
        pipeline::Request,
        sources::{SourceOutput, Tools, builtin},
    };
    use asperity_formats::Asset;

    fn named(name: &str) -> TextureModel {
        let mut texture = builtin::texture();
        texture.name = name.to_owned();
        texture
    }

    #[test]
    fn a_picture_is_drawn_again_from_the_asset_that_holds_it() {
        let request = Request {
            preview_px: Some(SIZE),
            ..Request::default()
        };
        let source = SourceOutput::new(named("cork"));
        let compiled = driver::compile(&source, &request, &Tools::default()).unwrap();
        let asset = Asset::parse(&compiled.lowered.bytes).unwrap();
        let kept = asset.preview_png().unwrap();
        assert_eq!(kept, png(&raise(&asset), SIZE).unwrap());
        assert!(kept.len() <= 25_000, "{} bytes", kept.len());
        let read = stored(kept).unwrap();
        assert_eq!((read.width, read.height), (SIZE, SIZE));
        assert_eq!(read.rgb.len(), 3 * (SIZE * SIZE) as usize);
    }

    #[test]
    fn a_louder_texture_has_deeper_relief() {
        let quiet = named("saddle hide");
        let mut loud = quiet.clone();
        for vertex in &mut loud.grid.vertices {
            vertex.sigma_m_s2 *= 4.0;
        }
        // Normals of steeper relief are further from the one that faces the eye.
        let steepness = |texture: &TextureModel| -> u64 {
            let normals = draw(texture, 128).unwrap().normal_png().unwrap();
            let normals = stored(&normals).unwrap().rgb;
            normals
                .chunks(3)
                .map(|n| u64::from(n[0].abs_diff(128)))
                .sum()
        };
        assert!(steepness(&loud) > steepness(&quiet) * 11 / 10);
    }

    #[test]
    fn a_texture_without_vibration_has_a_picture() {
        let mut silent = named("window glass");
        for vertex in &mut silent.grid.vertices {
            vertex.sigma_m_s2 = 0.0;
        }
        assert!(draw(&silent, 64).is_ok());
        assert!(draw(&silent, 63).unwrap_err().usage);
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        let bytes = lower(&named("cork"), None).unwrap().bytes;
        let fault = stored(&bytes).unwrap_err();
        assert!(fault.what.contains("cannot be read"), "{fault}");
    }
}

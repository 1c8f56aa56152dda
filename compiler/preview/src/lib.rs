//! Pictures of textures: what a material looks like, from its words, its neighbours and its feel.
//!
//! | file | says |
//! |---|---|
//! | [`description`](Description) | what a picture is made of |
//! | `stems`, `table`, `words`, `choose` | which pattern, in which colours: `data/materials.toml` |
//! | `pattern/` | a synthesis for each pattern class |
//! | `noise`, `surface` | what they draw with; all repeats after one patch |
//! | `light`, `palette`, `encode` | one light, few colours, PNG |
//!
//! The same description gives the same bytes on every machine: + − × ÷ √ in 32 bits, and `libm`. Every
//! pixel is drawn by itself, on any number of threads.
//!
//! ```
//! use asperity_preview::{Description, Picture, SIZE};
//!
//! let cork = Description { words: "cork", nearest: &[], coarser: 1.0, feel: None, seed: 0 };
//! let png = Picture::draw(&cork, SIZE)?.compact_png()?;
//! assert!(png.len() <= asperity_preview::COMPACT_BYTES);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

mod appearance;
mod choose;
mod color;
mod description;
mod encode;
mod light;
mod noise;
mod palette;
mod pattern;
mod stems;
mod surface;
mod table;
mod words;

pub use description::{Description, Feel};
pub use encode::EncodeError;

use rayon::prelude::*;
use std::ops::RangeInclusive;
use surface::Surface;
use thiserror::Error;

/// Width and height of a preview in an asset, pixels.
pub const SIZE: u32 = 256;
/// Sizes that a picture can have, pixels.
pub const SIZES: RangeInclusive<u32> = 64..=1024;
/// Width of the piece of surface that a picture shows, mm, whatever its pixels: what fine grain is drawn for.
/// Coarser patterns are drawn to be recognised, not to scale.
pub const WIDTH_MM: f64 = 60.0;
/// Bytes that a preview of the usual size takes at most.
pub const COMPACT_BYTES: usize = 24_000;

/// A size that a picture cannot have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("{0} pixels: a picture has {first} to {last}", first = SIZES.start(), last = SIZES.end())]
pub struct SizeError(pub u32);

/// A square picture that repeats in both directions.
#[derive(Debug, Clone)]
pub struct Picture {
    surface: Surface,
    pixels: Vec<[u8; 3]>,
}

impl Picture {
    /// Draws a description, `size` pixels wide and high.
    ///
    /// # Errors
    /// [`SizeError`] for a size out of [`SIZES`].
    pub fn draw(description: &Description<'_>, size: u32) -> Result<Self, SizeError> {
        if !SIZES.contains(&size) {
            return Err(SizeError(size));
        }
        let (pattern, appearance) = choose::choose(description);
        let mut surface = pattern::draw(pattern, &appearance, size as usize);
        let texels = surface.texels.par_iter_mut().with_min_len(surface::RUN);
        texels.enumerate().for_each(|(k, texel)| {
            texel.height *= appearance.relief;
            if appearance.grain.1 > 0.0 {
                let place = |pixel: usize| (pixel as f32 + 0.5) / size as f32;
                let (u, v) = (place(k % size as usize), place(k / size as usize));
                let (cells, strength) = appearance.grain;
                texel.height += strength * noise::gradient(u, v, cells, cells, appearance.seed ^ 5);
            }
        });
        let pixels = light::shade(&surface);
        Ok(Self { surface, pixels })
    }

    /// Width and height, pixels.
    #[must_use]
    pub fn size(&self) -> u32 {
        self.surface.size as u32
    }

    /// sRGB pixels, row by row.
    #[must_use]
    pub fn pixels(&self) -> &[[u8; 3]] {
        &self.pixels
    }

    /// The picture as PNG with every colour.
    ///
    /// # Errors
    /// [`EncodeError`] when the encoder fails.
    pub fn png(&self) -> Result<Vec<u8>, EncodeError> {
        encode::color(&self.pixels, self.surface.size, &[])
    }

    /// The picture as PNG with a palette: at most [`COMPACT_BYTES`] at [`SIZE`] pixels, and as
    /// many bytes a pixel at other sizes.
    ///
    /// # Errors
    /// [`EncodeError`] when the encoder fails.
    pub fn compact_png(&self) -> Result<Vec<u8>, EncodeError> {
        compact_png(&self.pixels, self.size(), &[])
    }

    /// The colours without the light, as PNG with a palette: what [`Self::normal_png`] is for.
    ///
    /// # Errors
    /// [`EncodeError`] when the encoder fails.
    pub fn unlit_png(&self) -> Result<Vec<u8>, EncodeError> {
        compact_png(&light::unlit(&self.surface), self.size(), &[])
    }

    /// Heights as PNG: 16 bits, linear, from the lowest to the highest.
    ///
    /// # Errors
    /// [`EncodeError`] when the encoder fails.
    pub fn height_png(&self) -> Result<Vec<u8>, EncodeError> {
        encode::height(&self.surface)
    }

    /// Normals in tangent space as PNG: linear, green up, as glTF wants them.
    ///
    /// # Errors
    /// [`EncodeError`] when the encoder fails.
    pub fn normal_png(&self) -> Result<Vec<u8>, EncodeError> {
        encode::normals(&light::slopes(&self.surface), self.surface.size)
    }
}

/// A picture that was made elsewhere as PNG with every colour: `size`² sRGB pixels, row by row.
/// `texts` are kept in it: a key of PNG's specification, such as `Comment`, and UTF-8.
///
/// # Errors
/// [`EncodeError`] when the encoder fails, and for another number of pixels.
pub fn png(pixels: &[[u8; 3]], size: u32, texts: &[(&str, &str)]) -> Result<Vec<u8>, EncodeError> {
    encode::color(pixels, size as usize, texts)
}

/// The same with a palette, as small as [`Picture::compact_png`].
///
/// # Errors
/// As [`fn@png`].
pub fn compact_png(
    pixels: &[[u8; 3]],
    size: u32,
    texts: &[(&str, &str)],
) -> Result<Vec<u8>, EncodeError> {
    let limit = COMPACT_BYTES * pixels.len() / (SIZE * SIZE) as usize;
    encode::compact(pixels, size as usize, limit, texts)
}

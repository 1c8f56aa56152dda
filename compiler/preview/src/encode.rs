//! Pictures as PNG.

use crate::{
    palette::{Histogram, Indexed},
    surface::Surface,
};
use png::{BitDepth, ColorType, Compression, Encoder, Filter, SrgbRenderingIntent};
use thiserror::Error;

/// A picture that cannot be encoded.
#[derive(Debug, Error)]
#[error("the picture cannot be encoded as PNG: {0}")]
pub struct EncodeError(#[from] png::EncodingError);

/// Palettes that are tried in turn until a picture is small enough.
const COLORS: [usize; 8] = [128, 64, 40, 26, 16, 10, 7, 4];

/// For other programs a picture may be a few percent larger, and is written several times as fast.
fn encoder<'a>(bytes: &'a mut Vec<u8>, size: usize) -> Encoder<'a, &'a mut Vec<u8>> {
    let mut encoder = Encoder::new(bytes, size as u32, size as u32);
    encoder.set_compression(Compression::Balanced);
    encoder
}

/// Says in a picture what it is and what made it: key and text, the keys of PNG's specification.
fn say(encoder: &mut Encoder<'_, &mut Vec<u8>>, texts: &[(&str, &str)]) -> Result<(), EncodeError> {
    for (key, text) in texts {
        encoder.add_itxt_chunk((*key).to_owned(), (*text).to_owned())?;
    }
    Ok(())
}

/// sRGB colours, 8 bits a channel.
pub(crate) fn color(
    pixels: &[[u8; 3]],
    size: usize,
    texts: &[(&str, &str)],
) -> Result<Vec<u8>, EncodeError> {
    let mut bytes = Vec::new();
    let mut encoder = encoder(&mut bytes, size);
    say(&mut encoder, texts)?;
    encoder.set_color(ColorType::Rgb);
    encoder.set_filter(Filter::Adaptive);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    encoder
        .write_header()?
        .write_image_data(pixels.as_flattened())?;
    Ok(bytes)
}

/// sRGB colours of a palette, with as many colours as `limit` bytes allow.
pub(crate) fn compact(
    pixels: &[[u8; 3]],
    size: usize,
    limit: usize,
    texts: &[(&str, &str)],
) -> Result<Vec<u8>, EncodeError> {
    let histogram = Histogram::of(pixels);
    let mut bytes = Vec::new();
    for colors in COLORS {
        bytes = palette(&histogram.indexed(pixels, colors), size, texts)?;
        if bytes.len() <= limit {
            break;
        }
    }
    Ok(bytes)
}

fn palette(picture: &Indexed, size: usize, texts: &[(&str, &str)]) -> Result<Vec<u8>, EncodeError> {
    let mut bytes = Vec::new();
    let mut encoder = encoder(&mut bytes, size);
    say(&mut encoder, texts)?;
    // In an asset every byte counts.
    encoder.set_compression(Compression::High);
    let few = picture.palette.len() <= 16;
    encoder.set_color(ColorType::Indexed);
    encoder.set_depth(if few { BitDepth::Four } else { BitDepth::Eight });
    encoder.set_palette(picture.palette.as_flattened());
    encoder.set_filter(Filter::NoFilter);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    if few {
        let rows = picture.pixels.chunks(size);
        let packed: Vec<u8> = rows
            .flat_map(|row| {
                row.chunks(2)
                    .map(|two| two[0] << 4 | two.get(1).copied().unwrap_or(0))
            })
            .collect();
        writer.write_image_data(&packed)?;
    } else {
        writer.write_image_data(&picture.pixels)?;
    }
    drop(writer);
    Ok(bytes)
}

/// Heights from the lowest, 0, to the highest, 65535, linear.
pub(crate) fn height(surface: &Surface) -> Result<Vec<u8>, EncodeError> {
    let heights = surface.texels.iter().map(|texel| texel.height);
    let low = heights.clone().fold(f32::MAX, f32::min);
    let high = heights.clone().fold(f32::MIN, f32::max);
    let scale = 65535.0 / (high - low).max(1e-9);
    let data: Vec<u8> = heights
        .flat_map(|h| (((h - low) * scale + 0.5) as u16).to_be_bytes())
        .collect();
    let mut bytes = Vec::new();
    let mut encoder = encoder(&mut bytes, surface.size);
    encoder.set_color(ColorType::Grayscale);
    encoder.set_depth(BitDepth::Sixteen);
    encoder.set_filter(Filter::Adaptive);
    encoder.write_header()?.write_image_data(&data)?;
    Ok(bytes)
}

/// Normals as glTF and OpenGL have them: red to the right, green up, blue towards the eye, linear.
pub(crate) fn normals(slopes: &[(f32, f32)], size: usize) -> Result<Vec<u8>, EncodeError> {
    let byte = |x: f32| ((x * 0.5 + 0.5) * 255.0 + 0.5) as u8;
    let data: Vec<u8> = slopes
        .iter()
        .flat_map(|(right, down)| {
            let length = (right * right + down * down + 1.0).sqrt();
            [
                byte(-right / length),
                byte(down / length),
                byte(1.0 / length),
            ]
        })
        .collect();
    let mut bytes = Vec::new();
    let mut encoder = encoder(&mut bytes, size);
    encoder.set_color(ColorType::Rgb);
    encoder.set_filter(Filter::Adaptive);
    encoder.write_header()?.write_image_data(&data)?;
    Ok(bytes)
}

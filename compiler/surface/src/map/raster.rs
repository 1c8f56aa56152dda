//! A picture as numbers, whatever its format.

use asperity_io::diagnostic::Fault;
use std::io::Cursor;
use tiff::{
    ColorType,
    decoder::{Decoder, DecodingResult, Limits},
    tags::Tag,
};
use zune_jpeg::{
    JpegDecoder,
    zune_core::{bytestream::ZCursor, colorspace::ColorSpace, options::DecoderOptions},
};

/// Most pixels.
const MOST_PIXELS: u64 = 8192 * 8192;
/// Most bytes that a picture takes when it is unpacked.
const MOST_BYTES: usize = 1 << 30;
const AGAIN: &str = "copy or export the file again";
const AS_GREY: &str = "save the heights as a greyscale PNG or TIFF of 16 bits";

/// A picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    /// Pixels in a row.
    pub width: usize,
    /// Numbers in a pixel: 1, or 3 for red, green and blue.
    pub channels: usize,
    /// Row by row from the top: whole numbers as parts of the largest, others as they are.
    pub samples: Vec<f32>,
    /// The largest whole number; `None` for floating point.
    pub largest: Option<u32>,
    /// Height of a pixel over its width.
    pub aspect: f64,
    /// True if the file says that its numbers are coded for a screen.
    pub is_coded: bool,
    /// True for a JPEG, which keeps what eyes see.
    pub is_lossy: bool,
}

impl Raster {
    /// Reads a PNG, a TIFF or a JPEG.
    ///
    /// # Errors
    /// [`Fault`] for damage, a size beyond 8192 × 8192, palettes, transparency, and colours other than red, green and blue.
    pub fn read(bytes: &[u8]) -> Result<Self, Fault> {
        if bytes.starts_with(b"\x89PNG") {
            png(bytes)
        } else if bytes.starts_with(b"II") || bytes.starts_with(b"MM") {
            tiff(bytes)
        } else if bytes.starts_with(b"\xff\xd8\xff") {
            jpeg(bytes)
        } else {
            Err(Fault::new("it is no PNG, TIFF or JPEG", AS_GREY))
        }
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.samples.len() / self.channels / self.width
    }
}

fn bounded(width: u32, height: u32) -> Result<(), Fault> {
    if u64::from(width) * u64::from(height) <= MOST_PIXELS {
        return Ok(());
    }
    let what = format!("{width} × {height} pixels; at most 8192 × 8192 are read");
    let remedy = "crop it, and state the width of what is left; 2048 × 2048 pixels are enough";
    Err(Fault::new(what, remedy))
}

fn palette() -> Fault {
    let what = "a picture with a palette: its numbers stand for colours, not for heights";
    Fault::new(what, AS_GREY)
}

fn transparent() -> Fault {
    let what = "some of its pixels are transparent, and have no height";
    Fault::new(what, "fill the holes, and save the heights without alpha")
}

/// The samples without their last channel, where that is opaque everywhere.
fn opaque(samples: Vec<f32>, channels: usize) -> Result<(Vec<f32>, usize), Fault> {
    let kept = channels - 1;
    if samples
        .chunks_exact(channels)
        .any(|pixel| pixel[kept] < 1.0)
    {
        return Err(transparent());
    }
    let pixels = samples.chunks_exact(channels);
    Ok((
        pixels.flat_map(|pixel| &pixel[..kept]).copied().collect(),
        kept,
    ))
}

fn png(bytes: &[u8]) -> Result<Raster, Fault> {
    let damaged = |error: png::DecodingError| Fault::new(format!("a damaged PNG: {error}"), AGAIN);
    let limits = png::Limits { bytes: MOST_BYTES };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(damaged)?;
    let info = reader.info();
    let (width, height) = info.size();
    bounded(width, height)?;
    if info.color_type == png::ColorType::Indexed {
        return Err(palette());
    }
    let largest = (1_u32 << info.bit_depth as u32) - 1;
    let is_coded = info.srgb.is_some()
        || info.icc_profile.is_some()
        || info
            .gama_chunk
            .is_some_and(|gamma| gamma.into_value() < 0.9);
    let aspect = info.pixel_dims.map_or(1.0, |per_unit| {
        f64::from(per_unit.xppu.max(1)) / f64::from(per_unit.yppu.max(1))
    });
    let mut packed = vec![0; reader.output_buffer_size().unwrap_or(0)];
    let frame = reader.next_frame(&mut packed).map_err(damaged)?;
    let channels = frame.color_type.samples();
    packed.truncate(frame.buffer_size());
    let samples: Vec<f32> = match frame.bit_depth {
        png::BitDepth::Sixteen => {
            let pairs = packed.chunks_exact(2);
            pairs
                .map(|pair| f32::from(u16::from_be_bytes([pair[0], pair[1]])) / 65535.0)
                .collect()
        }
        _ => packed.iter().map(|byte| f32::from(*byte) / 255.0).collect(),
    };
    let (samples, channels) = match channels {
        2 | 4 => opaque(samples, channels)?,
        _ => (samples, channels),
    };
    Ok(Raster {
        width: width as usize,
        channels,
        samples,
        largest: Some(largest),
        aspect,
        is_coded,
        is_lossy: false,
    })
}

fn jpeg(bytes: &[u8]) -> Result<Raster, Fault> {
    let damaged = |error| Fault::new(format!("the JPEG cannot be read: {error}"), AGAIN);
    let mut decoder = JpegDecoder::new(ZCursor::new(bytes));
    decoder.decode_headers().map_err(damaged)?;
    let info = decoder
        .info()
        .ok_or_else(|| Fault::new("a JPEG without a size", AGAIN))?;
    bounded(info.width.into(), info.height.into())?;
    let channels = if info.components == 1 { 1 } else { 3 };
    let colors = [ColorSpace::Luma, ColorSpace::RGB][channels / 3];
    decoder.set_options(DecoderOptions::default().jpeg_set_out_colorspace(colors));
    let packed = decoder.decode().map_err(damaged)?;
    Ok(Raster {
        width: info.width.into(),
        channels,
        samples: packed.iter().map(|byte| f32::from(*byte) / 255.0).collect(),
        largest: Some(255),
        aspect: 1.0,
        is_coded: false,
        is_lossy: true,
    })
}

fn tiff(bytes: &[u8]) -> Result<Raster, Fault> {
    let damaged = |error| Fault::new(format!("the TIFF cannot be read: {error}"), AS_GREY);
    let mut limits = Limits::default();
    limits.decoding_buffer_size = MOST_BYTES;
    limits.intermediate_buffer_size = MOST_BYTES;
    let decoder = Decoder::new(Cursor::new(bytes)).map_err(damaged)?;
    let mut decoder = decoder.with_limits(limits);
    let (width, height) = decoder.dimensions().map_err(damaged)?;
    bounded(width, height)?;
    let channels = match decoder.colortype().map_err(damaged)? {
        ColorType::Gray(_) => 1,
        ColorType::GrayA(_) => 2,
        ColorType::RGB(_) => 3,
        ColorType::RGBA(_) => 4,
        ColorType::Palette(_) => return Err(palette()),
        other => {
            let what = format!("a TIFF of colours ({other:?}), not of heights");
            return Err(Fault::new(what, AS_GREY));
        }
    };
    let mut per_unit = |tag| decoder.find_tag(tag).ok().flatten()?.into_f64().ok();
    let per_unit =
        [Tag::XResolution, Tag::YResolution].map(|tag| per_unit(tag).filter(|n| *n > 0.0));
    let aspect = match per_unit {
        [Some(x), Some(y)] => x / y,
        _ => 1.0,
    };
    let (samples, largest): (Vec<f32>, _) = match decoder.read_image().map_err(damaged)? {
        DecodingResult::U8(all) => (parts(&all, 255.0), Some(255)),
        DecodingResult::U16(all) => (parts(&all, 65535.0), Some(65535)),
        DecodingResult::U32(all) => (parts(&all, f64::from(u32::MAX)), Some(u32::MAX)),
        DecodingResult::I16(all) => {
            let above = all.iter().map(|n| f64::from(*n) + 32768.0);
            (above.map(|n| (n / 65535.0) as f32).collect(), Some(65535))
        }
        DecodingResult::F32(all) => (all, None),
        DecodingResult::F64(all) => (all.iter().map(|n| *n as f32).collect(), None),
        _ => {
            let what = "a TIFF of numbers other than 8, 16 or 32 bits, or floats of 32 or 64";
            return Err(Fault::new(what, AS_GREY));
        }
    };
    let (samples, channels) = match channels {
        2 | 4 => opaque(samples, channels)?,
        _ => (samples, channels),
    };
    Ok(Raster {
        width: width as usize,
        channels,
        samples,
        largest,
        aspect,
        is_coded: false,
        is_lossy: false,
    })
}

fn parts<T: Copy + Into<f64>>(all: &[T], largest: f64) -> Vec<f32> {
    all.iter().map(|n| ((*n).into() / largest) as f32).collect()
}

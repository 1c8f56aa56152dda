//! A picture as numbers, whatever its format.

use asperity_io::diagnostic::Fault;
use std::io::Cursor;
use tiff::{
    ColorType,
    decoder::{Decoder, DecodingResult, Limits, ifd::Value},
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
    /// Columns and rows of the file, of which this may be the middle.
    pub whole: [usize; 2],
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

    /// The middle, at most so many pixels wide and high.
    #[must_use]
    pub fn middle(self, most: [usize; 2]) -> Self {
        let (width, height) = (self.width.min(most[0]), self.height().min(most[1]));
        if [width, height] == [self.width, self.height()] {
            return self;
        }
        let (left, top) = ((self.width - width) / 2, (self.height() - height) / 2);
        let rows = self.samples.chunks_exact(self.channels * self.width);
        let kept = self.channels * left..self.channels * (left + width);
        let samples = rows
            .skip(top)
            .take(height)
            .flat_map(|row| &row[kept.clone()]);
        Self {
            width,
            samples: samples.copied().collect(),
            ..self
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

/// Height of a pixel over its width, unless the file states what no pixel has.
fn told(aspect: f64) -> f64 {
    if (0.1..=10.0).contains(&aspect) {
        aspect
    } else {
        1.0
    }
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
        told(f64::from(per_unit.xppu) / f64::from(per_unit.yppu))
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
        whole: [width as usize, height as usize],
        channels,
        samples,
        largest: Some(largest),
        aspect,
        is_coded,
        is_lossy: false,
    })
}

fn jpeg(bytes: &[u8]) -> Result<Raster, Fault> {
    let damaged = |error| Fault::new(format!("a damaged JPEG: {error}"), AGAIN);
    let bounds = DecoderOptions::default()
        .set_strict_mode(true)
        .set_max_width(usize::from(u16::MAX))
        .set_max_height(usize::from(u16::MAX));
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), bounds);
    decoder.decode_headers().map_err(damaged)?;
    let info = decoder
        .info()
        .ok_or_else(|| Fault::new("a JPEG without a size", AGAIN))?;
    bounded(info.width.into(), info.height.into())?;
    let channels = if info.components == 1 { 1 } else { 3 };
    let colors = [ColorSpace::Luma, ColorSpace::RGB][channels / 3];
    decoder.set_options(bounds.jpeg_set_out_colorspace(colors));
    let packed = decoder.decode().map_err(damaged)?;
    Ok(Raster {
        width: info.width.into(),
        whole: [info.width.into(), info.height.into()],
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
        ColorType::Gray(8..) => 1,
        ColorType::GrayA(8..) => 2,
        ColorType::RGB(8..) => 3,
        ColorType::RGBA(8..) => 4,
        ColorType::Palette(_) => return Err(palette()),
        ColorType::Gray(bits) | ColorType::GrayA(bits) | ColorType::RGB(bits) => {
            let what = format!("a TIFF of {bits} bits a number, which is not read");
            return Err(Fault::new(what, AS_GREY));
        }
        other => {
            let what = format!("a TIFF of colours ({other:?}), not of heights");
            return Err(Fault::new(what, AS_GREY));
        }
    };
    let mut tag = |tag| decoder.find_tag(tag).ok().flatten();
    let per_unit = [Tag::XResolution, Tag::YResolution].map(|resolution| match tag(resolution)? {
        Value::Rational(part, of) if part > 0 && of > 0 => Some(f64::from(part) / f64::from(of)),
        _ => None,
    });
    let hole = match tag(Tag::GdalNodata) {
        Some(Value::Ascii(text)) => text.trim_matches(['\0', ' ']).parse::<f64>().ok(),
        _ => None,
    };
    let aspect = match per_unit {
        [Some(x), Some(y)] => told(x / y),
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
            let what = "a TIFF of numbers of a kind that is not read: those are unsigned of 8, 16 or 32 bits, signed of 16, and floats of 32 or 64";
            return Err(Fault::new(what, AS_GREY));
        }
    };
    let (mut samples, channels) = match channels {
        2 | 4 => opaque(samples, channels)?,
        _ => (samples, channels),
    };
    if let (None, Some(hole)) = (largest, hole) {
        // What stands for no height is none.
        let holes = samples.iter_mut().filter(|sample| **sample == hole as f32);
        holes.for_each(|sample| *sample = f32::NAN);
    }
    Ok(Raster {
        width: width as usize,
        whole: [width as usize, height as usize],
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

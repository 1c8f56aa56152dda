//! A picture as numbers, whatever its format.

use asperity_io::diagnostic::Fault;
use std::{
    io::Cursor,
    path::{Path, PathBuf},
};
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
/// Most columns and rows that are kept, those in the middle: no more of a surface is stroked.
const MOST_KEPT: usize = 4096;
/// Tag of a picture's orientation, in TIFF and in EXIF.
const ORIENTATION: u16 = 274;
const AGAIN: &str = "copy or export the file again";
const AS_GREY: &str = "save the heights as a greyscale PNG or TIFF of 16 bits";

/// A picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    /// Its file.
    pub file: PathBuf,
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
    /// True if some of its pixels are transparent.
    pub is_transparent: bool,
    /// Doubts about its numbers, in words for the user.
    pub notes: Vec<String>,
}

/// A picture as its file has it.
struct Unpacked<'a> {
    whole: [usize; 2],
    /// Numbers in a pixel: those of [`Raster`], and one more where it may be transparent.
    channels: usize,
    aspect: f64,
    notes: Vec<String>,
    file: &'a Path,
}

impl Unpacked<'_> {
    /// The middle of all numbers, as parts of the largest.
    fn raster<T: Copy>(self, all: &[T], largest: Option<u32>, part: impl Fn(T) -> f32) -> Raster {
        let Self {
            whole, channels, ..
        } = self;
        let [width, height] = whole.map(|pixels| pixels.min(MOST_KEPT));
        let [left, top] = [(whole[0] - width) / 2, (whole[1] - height) / 2];
        let rows = all.chunks_exact(channels * whole[0]).skip(top).take(height);
        let pixels = rows
            .flat_map(|row| row[channels * left..channels * (left + width)].chunks_exact(channels));
        let kept = if channels == 1 || channels == 2 { 1 } else { 3 };
        let mut samples = Vec::with_capacity(kept * width * height);
        let mut is_transparent = false;
        for pixel in pixels {
            samples.extend(pixel[..kept].iter().map(|n| part(*n)));
            is_transparent |= pixel[kept..].iter().any(|n| part(*n) < 1.0);
        }
        Raster {
            file: self.file.to_owned(),
            width,
            whole,
            channels: kept,
            samples,
            largest,
            aspect: self.aspect,
            is_transparent,
            notes: self.notes,
        }
    }
}

impl Raster {
    /// Reads the middle of a PNG, a TIFF or a JPEG, at most 4096 × 4096 pixels of it.
    ///
    /// # Errors
    /// [`Fault`] for damage, a size beyond 8192 × 8192, palettes, and colours other than red, green and blue.
    pub fn read(file: &Path, bytes: &[u8]) -> Result<Self, Fault> {
        let raster = if bytes.starts_with(b"\x89PNG") {
            png(file, bytes)
        } else if bytes.starts_with(b"II") || bytes.starts_with(b"MM") {
            tiff(file, bytes)
        } else if bytes.starts_with(b"\xff\xd8\xff") {
            jpeg(file, bytes)
        } else {
            Err(Fault::new("it is no PNG, TIFF or JPEG", AS_GREY))
        };
        raster.map_err(|fault| fault.at(file))
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

/// The note on a picture that is shown turned.
fn turned(orientation: Option<u16>) -> Option<String> {
    let orientation = orientation.filter(|orientation| (2..=8).contains(orientation))?;
    Some(format!(
        "the file says that it is to be turned or mirrored (orientation {orientation}); it is read as it is stored: save it upright if its width or direction is wrong"
    ))
}

/// The orientation in the first directory of EXIF data.
fn orientation(exif: &[u8]) -> Option<u16> {
    let is_little = exif.starts_with(b"II");
    let short = |at: usize| {
        let two = [*exif.get(at)?, *exif.get(at + 1)?];
        Some(match is_little {
            true => u16::from_le_bytes(two),
            false => u16::from_be_bytes(two),
        })
    };
    let (low, high) = if is_little { (4, 6) } else { (6, 4) };
    let first = usize::from(short(high)?) << 16 | usize::from(short(low)?);
    let mut entries = (0..usize::from(short(first)?)).map(|n| first + 2 + 12 * n);
    short(entries.find(|entry| short(*entry) == Some(ORIENTATION))? + 8)
}

fn png(file: &Path, bytes: &[u8]) -> Result<Raster, Fault> {
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
    let largest = Some((1_u32 << info.bit_depth as u32) - 1);
    let is_coded = info.srgb.is_some()
        || info.icc_profile.is_some()
        || info
            .gama_chunk
            .is_some_and(|gamma| gamma.into_value() < 0.9);
    let mut notes: Vec<String> = Vec::new();
    if is_coded {
        notes.push("the file says that its numbers are coded for a screen (sRGB); they are taken as they are: save it as linear data if that is wrong".into());
    }
    let aspect = info.pixel_dims.map_or(1.0, |per_unit| {
        told(f64::from(per_unit.xppu) / f64::from(per_unit.yppu))
    });
    let mut packed = vec![0; reader.output_buffer_size().unwrap_or(0)];
    let frame = reader.next_frame(&mut packed).map_err(damaged)?;
    // The data of EXIF may follow the pixels.
    let _ = reader.finish();
    let exif = reader.info().exif_metadata.as_deref();
    notes.extend(turned(exif.and_then(orientation)));
    packed.truncate(frame.buffer_size());
    let unpacked = Unpacked {
        whole: [width as usize, height as usize],
        channels: frame.color_type.samples(),
        aspect,
        notes,
        file,
    };
    Ok(match frame.bit_depth {
        png::BitDepth::Sixteen => unpacked.raster(packed.as_chunks().0, largest, |pair| {
            f32::from(u16::from_be_bytes(pair)) / 65535.0
        }),
        _ => unpacked.raster(&packed, largest, |byte| f32::from(byte) / 255.0),
    })
}

fn jpeg(file: &Path, bytes: &[u8]) -> Result<Raster, Fault> {
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
    let lossy = "a JPEG keeps what eyes see: give a PNG or TIFF where there is one".to_owned();
    let turned = turned(decoder.exif().and_then(|exif| orientation(exif)));
    let unpacked = Unpacked {
        whole: [info.width.into(), info.height.into()],
        channels,
        aspect: 1.0,
        notes: [Some(lossy), turned].into_iter().flatten().collect(),
        file,
    };
    Ok(unpacked.raster(&packed, Some(255), |byte| f32::from(byte) / 255.0))
}

fn tiff(file: &Path, bytes: &[u8]) -> Result<Raster, Fault> {
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
    let turned = turned(tag(Tag::Orientation).and_then(|tag| tag.into_u16().ok()));
    let pages = decoder
        .more_images()
        .then(|| "the TIFF holds several pictures, of which the first is read".to_owned());
    let all = decoder.read_image().map_err(damaged)?;
    let unpacked = Unpacked {
        whole: [width as usize, height as usize],
        channels,
        aspect,
        notes: [turned, pages].into_iter().flatten().collect(),
        file,
    };
    // What stands for no height is none.
    let height = |n: f32| match hole.is_some_and(|hole| hole as f32 == n) {
        true => f32::NAN,
        false => n,
    };
    Ok(match &all {
        DecodingResult::U8(all) => unpacked.raster(all, Some(255), |n| f32::from(n) / 255.0),
        DecodingResult::U16(all) => unpacked.raster(all, Some(65535), |n| f32::from(n) / 65535.0),
        DecodingResult::U32(all) => unpacked.raster(all, Some(u32::MAX), |n| {
            (f64::from(n) / f64::from(u32::MAX)) as f32
        }),
        DecodingResult::I16(all) => unpacked.raster(all, Some(65535), |n| {
            ((f64::from(n) + 32768.0) / 65535.0) as f32
        }),
        DecodingResult::F32(all) => unpacked.raster(all, None, height),
        DecodingResult::F64(all) => unpacked.raster(all, None, |n| height(n as f32)),
        _ => {
            let what = "a TIFF of numbers of a kind that is not read: those are unsigned of 8, 16 or 32 bits, signed of 16, and floats of 32 or 64";
            return Err(Fault::new(what, AS_GREY));
        }
    })
}

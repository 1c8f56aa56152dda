//! Pictures that are no maps of heights, and those that need a word.

use asperity_io::diagnostic::Fault;
use asperity_surface::map::{HeightMap, Pictures, Raster, Size};
use png::{BitDepth, ColorType, Encoder, PixelDimensions, SrgbRenderingIntent, Unit};
use std::io::Cursor;
use tiff::{
    encoder::{TiffEncoder, colortype},
    tags::Tag,
};

const SIDE: u32 = 64;
const SIZE: Size = Size {
    width_mm: Some(6.4),
    depth_mm: Some(0.1),
};

/// A smooth relief from 0 to 1, by column and row.
fn relief(x: u32, y: u32) -> f64 {
    let wave = |n: u32, periods: f64| {
        (periods * f64::from(n) / f64::from(SIDE) * std::f64::consts::TAU).sin()
    };
    0.5 + 0.25 * wave(x, 3.0) + 0.24 * wave(y, 2.0)
}

fn samples(of: impl Fn(u32, u32) -> Vec<u8>) -> Vec<u8> {
    (0..SIDE * SIDE)
        .flat_map(|n| of(n % SIDE, n / SIDE))
        .collect()
}

fn grey16(x: u32, y: u32) -> Vec<u8> {
    ((65535.0 * relief(x, y)) as u16).to_be_bytes().to_vec()
}

fn grey8(x: u32, y: u32) -> u8 {
    (255.0 * relief(x, y)) as u8
}

fn png(
    color: ColorType,
    depth: BitDepth,
    data: &[u8],
    change: impl Fn(&mut Encoder<'_, &mut Vec<u8>>),
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, SIDE, SIDE);
    encoder.set_color(color);
    encoder.set_depth(depth);
    change(&mut encoder);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(data).unwrap();
    writer.finish().unwrap();
    bytes
}

fn tiff<C: colortype::ColorType>(data: &[C::Inner]) -> Vec<u8>
where
    [C::Inner]: tiff::encoder::TiffValue,
{
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
    encoder.write_image::<C>(SIDE, SIDE, data).unwrap();
    bytes.into_inner()
}

fn floats(change: impl Fn(usize, f32) -> f32) -> Vec<u8> {
    let height = |n: u32| 3.0 + 0.1 * relief(n % SIDE, n / SIDE) as f32;
    let all: Vec<f32> = (0..SIDE * SIDE)
        .map(|n| change(n as usize, height(n)))
        .collect();
    tiff::<colortype::Gray32Float>(&all)
}

fn read(bytes: &[u8], size: &Size) -> Result<HeightMap, Fault> {
    Pictures::of(Raster::read("map".as_ref(), bytes)?, None).heights(size)
}

fn refused(bytes: &[u8], size: &Size) -> String {
    let fault = read(bytes, size).unwrap_err();
    format!("{fault}; {}", fault.remedy)
}

fn wide(width_mm: f64) -> Size {
    Size {
        width_mm: Some(width_mm),
        ..SIZE
    }
}

/// Claim: what is no map of heights is refused, with its cause and a remedy.
#[test]
fn what_shows_no_heights_is_refused() {
    let plain = |_: &mut Encoder<'_, &mut Vec<u8>>| {};
    let grey = png(
        ColorType::Grayscale,
        BitDepth::Sixteen,
        &samples(grey16),
        plain,
    );
    let photograph = samples(|x, y| vec![grey8(x, y), grey8(y, x), 80]);
    let normals = samples(|x, y| {
        let tilt = 40.0 * (relief(x, y) - 0.5);
        vec![(127.5 + tilt) as u8, (127.5 - tilt) as u8, 252]
    });
    let holes = samples(|x, y| vec![grey8(x, y), if x == 9 { 0 } else { 255 }]);
    let indexed = png(
        ColorType::Indexed,
        BitDepth::Eight,
        &samples(|x, y| vec![grey8(x, y)]),
        |encoder| {
            encoder.set_palette((0..=255).flat_map(|n| [n, n, n]).collect::<Vec<u8>>());
        },
    );
    let mut cut = grey.clone();
    cut.truncate(cut.len() / 2);
    // A header of 16,384 × 16,384 pixels, with its checksum.
    let mut huge = grey.clone();
    huge[16..24].copy_from_slice(&[0, 0, 64, 0, 0, 0, 64, 0]);
    let crc = crc32(&huge[12..29]);
    huge[29..33].copy_from_slice(&crc.to_be_bytes());
    let rgb = |data: &[u8]| png(ColorType::Rgb, BitDepth::Eight, data, plain);
    for (bytes, size, words) in [
        (
            grey.clone(),
            wide(0.0),
            &["width_mm", "0 mm is no width"][..],
        ),
        (grey.clone(), wide(f64::NAN), &["width_mm", "no width"]),
        (
            grey.clone(),
            Size {
                depth_mm: Some(0.0),
                ..SIZE
            },
            &["depth_mm", "no depth"],
        ),
        (
            grey,
            wide(64.0),
            &["1.00 mm apart", "30 Hz", "192 points", "21 mm"],
        ),
        (cut, SIZE, &["damaged PNG", "export the file again"]),
        (huge, SIZE, &["16384 × 16384", "8192 × 8192", "crop"]),
        (indexed, SIZE, &["palette", "greyscale"]),
        (rgb(&photograph), SIZE, &["photograph", "height map"]),
        (
            rgb(&normals),
            SIZE,
            &["depth_mm", "normal map says its own depth"],
        ),
        (
            png(ColorType::GrayscaleAlpha, BitDepth::Eight, &holes, plain),
            SIZE,
            &["transparent", "fill the holes"],
        ),
        (
            floats(|n, h| if n == 65 { f32::NAN } else { h }),
            SIZE,
            &["1 of its numbers", "row 2, column 2", "fill the holes"],
        ),
        (
            floats(|n, h| if n < 3 { f32::INFINITY } else { h }),
            SIZE,
            &["3 of its numbers", "row 1, column 1"],
        ),
        (
            tiff::<colortype::CMYK8>(&samples(|x, y| vec![grey8(x, y); 4])),
            SIZE,
            &["colours", "greyscale"],
        ),
        (b"II*\0\x08\0\0\0".to_vec(), SIZE, &["TIFF cannot be read"]),
        (b"GIF89a".to_vec(), SIZE, &["no PNG, TIFF or JPEG"]),
    ] {
        let message = refused(&bytes, &size);
        for word in words {
            assert!(message.contains(word), "{word}: {message}");
        }
    }
}

/// Claim: marks of holes in floating point are holes, by the file's word or far from all heights; bits are not taken for bytes.
#[test]
fn marks_of_holes_are_no_heights() {
    let marked = floats(|n, h| if n == 70 { -9999.0 } else { h });
    let message = refused(&marked, &SIZE);
    assert!(
        message.contains("-9999 is far from all others"),
        "{message}"
    );
    let steep = floats(|n, h| h + 0.02 * (n % 64) as f32);
    assert!(read(&steep, &SIZE).is_ok());
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
    let mut image = encoder
        .new_image::<colortype::Gray32Float>(SIDE, SIDE)
        .unwrap();
    image.encoder().write_tag(Tag::GdalNodata, "-1").unwrap();
    let heights: Vec<f32> = (0..SIDE * SIDE)
        .map(|n| if n == 9 { -1.0 } else { (n % 7) as f32 })
        .collect();
    image.write_data(&heights).unwrap();
    let message = refused(&bytes.into_inner(), &SIZE);
    assert!(
        message.contains("1 of its numbers are no heights"),
        "{message}"
    );
}

/// Claim: what can be read with a doubt is read, and the doubt is said.
#[test]
fn doubts_are_said() {
    let notes = |bytes: &[u8], size: &Size| read(bytes, size).unwrap().notes.join("; ");
    let plain = |_: &mut Encoder<'_, &mut Vec<u8>>| {};
    let grey = |change: &dyn Fn(&mut Encoder<'_, &mut Vec<u8>>)| {
        png(
            ColorType::Grayscale,
            BitDepth::Sixteen,
            &samples(grey16),
            change,
        )
    };
    assert_eq!(notes(&grey(&plain), &SIZE), "");
    let coded = grey(&|encoder| encoder.set_source_srgb(SrgbRenderingIntent::Perceptual));
    assert!(notes(&coded, &SIZE).contains("sRGB"));
    let oblong = grey(&|encoder| {
        encoder.set_pixel_dims(Some(PixelDimensions {
            xppu: 1000,
            yppu: 500,
            unit: Unit::Unspecified,
        }));
    });
    assert!(notes(&oblong, &SIZE).contains("2.000 times as high"));
    let [x, y] = read(&oblong, &SIZE).unwrap().field.pitch_mm();
    assert!((y / x - 2.0).abs() < 1e-9);
    // The chunk follows the header: one entry, the orientation 6.
    let mut exif = b"eXIfMM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0".to_vec();
    exif.extend(crc32(&exif).to_be_bytes());
    let mut turned = grey(&plain);
    turned.splice(33..33, [0, 0, 0, 22].into_iter().chain(exif));
    assert!(notes(&turned, &SIZE).contains("orientation 6"));
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
    let heights: Vec<u16> = (0..SIDE * SIDE).map(|n| (n * 7919) as u16).collect();
    for _ in 0..2 {
        let page = encoder.new_image::<colortype::Gray16>(SIDE, SIDE);
        let mut page = page.unwrap();
        page.encoder().write_tag(Tag::Orientation, 3_u16).unwrap();
        page.write_data(&heights).unwrap();
    }
    let pages = notes(&bytes.into_inner(), &SIZE);
    assert!(pages.contains("several pictures") && pages.contains("orientation 3"));
    let absurd = grey(&|encoder| {
        encoder.set_pixel_dims(Some(PixelDimensions {
            xppu: 0,
            yppu: 5000,
            unit: Unit::Unspecified,
        }));
    });
    assert_eq!(notes(&absurd, &SIZE), "");
    let steps = png(
        ColorType::Grayscale,
        BitDepth::Eight,
        &samples(|x, y| vec![grey8(x, y)]),
        plain,
    );
    assert!(
        notes(&steps, &SIZE).contains("steps of 0.392 µm"),
        "{}",
        notes(&steps, &SIZE)
    );
    // Ridges of a tenth of the width, whose inverse would be grooves.
    let ridges = samples(|x, y| {
        let crest = if x % 16 == 0 { 40_000 } else { 0 };
        (crest + 100 * (x as u16 % 7) + y as u16)
            .to_be_bytes()
            .to_vec()
    });
    let ridges = png(ColorType::Grayscale, BitDepth::Sixteen, &ridges, plain);
    assert!(notes(&ridges, &SIZE).contains("negative --depth-mm"));
    let grooves = Size {
        depth_mm: Some(-0.1),
        ..SIZE
    };
    assert_eq!(notes(&ridges, &grooves), "");
}

/// Claim: the same heights are the same field in every format, and of the noise of 8 bits a part is filtered out.
#[test]
fn formats_agree() {
    let plain = |_: &mut Encoder<'_, &mut Vec<u8>>| {};
    let field = |bytes: &[u8]| read(bytes, &SIZE).unwrap().field;
    let fine = field(&png(
        ColorType::Grayscale,
        BitDepth::Sixteen,
        &samples(grey16),
        plain,
    ));
    let rms = |other: &[u8]| {
        let other = field(other);
        let pairs = fine.heights_um().iter().zip(other.heights_um());
        let sum: f64 = pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum();
        (sum / f64::from(SIDE * SIDE)).sqrt()
    };
    let wide: Vec<u16> = (0..SIDE * SIDE)
        .map(|n| (65535.0 * relief(n % SIDE, n / SIDE)) as u16)
        .collect();
    assert!(rms(&tiff::<colortype::Gray16>(&wide)) < 1e-3);
    let rgb = samples(|x, y| [grey16(x, y), grey16(x, y), grey16(x, y)].concat());
    assert!(rms(&png(ColorType::Rgb, BitDepth::Sixteen, &rgb, plain)) < 1e-3);
    // The depth of floating point is that from the lowest to the highest point.
    let heights = (0..SIDE * SIDE).map(|n| relief(n % SIDE, n / SIDE));
    let (low, high) = heights.fold((1.0_f64, 0.0_f64), |(low, high), h| {
        (low.min(h), high.max(h))
    });
    let size = Size {
        depth_mm: Some(0.1 * (high - low)),
        ..SIZE
    };
    let floating = read(&floats(|_, h| h), &size).unwrap().field;
    assert!((floating.rms_um() / fine.rms_um() - 1.0).abs() < 0.02);
    let steps = png(
        ColorType::Grayscale,
        BitDepth::Eight,
        &samples(|x, y| vec![grey8(x, y)]),
        plain,
    );
    let noise_um = 100.0 / 255.0 / 12.0_f64.sqrt();
    assert!(
        rms(&steps) < 0.8 * noise_um,
        "{} of {noise_um}",
        rms(&steps)
    );
}

/// CRC-32 of a PNG's chunk.
fn crc32(bytes: &[u8]) -> u32 {
    let shift = |crc: u32| {
        (0..8).fold(crc, |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg())
        })
    };
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (crc >> 8) ^ shift((crc ^ u32::from(*byte)) & 0xff)
    })
}

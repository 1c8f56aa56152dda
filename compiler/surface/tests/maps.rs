//! Pictures that are no maps of heights, and those that need a word.

use asperity_io::diagnostic::Fault;
use asperity_surface::{
    contact::{Contact, Tip},
    map::{Convention, HeightMap, Pictures, Raster, Size, profile},
    stroke::Strokes,
    stylus::Support,
    wave_spectrum::WaveSpectrum,
};
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
    Pictures::of(Raster::read(bytes)?, None).heights(size)
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
            &["--width-mm", "0 mm is no width"][..],
        ),
        (grey.clone(), wide(f64::NAN), &["--width-mm", "no width"]),
        (
            grey.clone(),
            Size {
                depth_mm: Some(0.0),
                ..SIZE
            },
            &["--depth-mm", "no depth"],
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
            &["--depth-mm", "normal map says its own depth"],
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

/// Points along a side of a surface of which heights and normals are known, and its waves: periods in x and in y, µm.
const FINE: u32 = 256;
const WAVES: [(f64, f64, f64); 4] = [
    (4.0, 1.0, 40.0),
    (11.0, -7.0, 10.0),
    (23.0, 9.0, 3.5),
    (31.0, -20.0, 1.5),
];
const PITCH_MM: f64 = 0.1;

/// Height, µm, and slopes in x and down the rows.
fn known(x: u32, y: u32) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (in_x, in_y, height) in WAVES {
        let turn = std::f64::consts::TAU / f64::from(FINE);
        let (sin, cos) = (turn * (in_x * f64::from(x) + in_y * f64::from(y))).sin_cos();
        let slope = 1e-3 * height * turn / PITCH_MM * cos;
        let parts = [height * sin, in_x * slope, in_y * slope];
        sum.iter_mut()
            .zip(parts)
            .for_each(|(sum, part)| *sum += part);
    }
    sum
}

fn raster(channels: usize, of: impl Fn(u32, u32) -> Vec<f64>) -> Raster {
    let pixels = (0..FINE * FINE).flat_map(|n| of(n % FINE, n / FINE));
    Raster {
        width: FINE as usize,
        whole: [FINE as usize; 2],
        channels,
        samples: pixels.map(|part| part as f32).collect(),
        largest: Some(65535),
        aspect: 1.0,
        is_coded: false,
        is_lossy: false,
    }
}

fn normals(green_down: f64) -> Raster {
    raster(3, |x, y| {
        let [_, in_x, down] = known(x, y);
        let length = (1.0 + in_x * in_x + down * down).sqrt();
        let byte = |part: f64| (255.0 * (0.5 + 0.5 * part / length)).round() / 255.0;
        vec![byte(-in_x), byte(-green_down * down), byte(1.0)]
    })
}

/// Claim: heights, their normals in either convention, and both together vibrate within 1 dB in every direction, and the
/// convention follows from the slopes.
#[test]
fn heights_and_normals_agree() {
    let heights = raster(1, |x, y| vec![0.5 + known(x, y)[0] / 250.0]);
    let level = |pictures: &Pictures, depth_mm: Option<f64>, direction_rad: f64| {
        let size = Size {
            width_mm: Some(f64::from(FINE) * PITCH_MM),
            depth_mm,
        };
        let support = Support {
            modulus_mpa: 1000.0,
            loss_factor: 0.1,
            force_n: 1.0,
        };
        let map = pictures.heights(&size).unwrap();
        let followed = Contact::with(&map.field).followed(&Tip::STYLUS, &support);
        let line = WaveSpectrum::of(&followed).along(direction_rad);
        let power = Strokes::over(&line).power(80.0, &support);
        (10.0 * power.iter().sum::<f64>().log10(), map.notes.concat())
    };
    let height = Pictures::of(heights.clone(), None);
    for (green_down, name) in [(1.0, "dx"), (-1.0, "gl")] {
        let normal = Pictures::of(normals(green_down), None);
        let both = Pictures {
            height: Some(heights.clone()),
            ..normal.clone()
        };
        for direction_rad in [0.0, 0.8, 1.6, 2.4] {
            let (truth, _) = level(&height, Some(0.25), direction_rad);
            let (by_normals, notes) = level(&normal, None, direction_rad);
            assert!(notes.contains(&format!("--normal {name}`, for")), "{notes}");
            for (found, what) in [
                (by_normals, "normals"),
                (level(&both, Some(0.25), direction_rad).0, "both"),
                (level(&both, None, direction_rad).0, "both, without a depth"),
            ] {
                assert!(
                    (found - truth).abs() < 1.0,
                    "{what}, {name}: {found} dB, {truth} dB"
                );
            }
        }
    }
    let wrong = Pictures {
        convention: Some(Convention::Gl),
        ..Pictures::of(normals(1.0), None)
    };
    assert!(
        level(&wrong, None, 0.0)
            .1
            .contains("with dx the slopes would belong to a surface")
    );
    // A relief three times as deep as its normals say, and one turned inside out.
    let both = Pictures {
        height: Some(heights),
        ..Pictures::of(normals(1.0), None)
    };
    assert!(
        level(&both, Some(0.75), 0.0)
            .1
            .contains("0.33 times as deep as stated")
    );
    assert!(
        level(&both, Some(-0.25), 0.0)
            .1
            .contains("turned inside out")
    );
}

/// Claim: a profile in any units is the same field, with its own width; gaps, disorder and missing units are named.
#[test]
fn profiles_are_tables() {
    let size = Size {
        width_mm: None,
        depth_mm: None,
    };
    let table = |head: &str, per_x: f64, per_z: f64| {
        let row = |n: i32| {
            let x = 0.05 * f64::from(n);
            format!("{},{}\n", x / per_x, 1e-3 * (4.0 * x).sin() / per_z)
        };
        head.to_owned() + &(0..400).map(row).collect::<String>()
    };
    let rms = |text: &str, size: &Size| profile(text.as_bytes(), size).unwrap().field.rms_um();
    let millimetres = rms(&table("x_mm,z_mm\n", 1.0, 1.0), &size);
    assert!((millimetres - 0.5_f64.sqrt()).abs() < 0.02, "{millimetres}");
    for (text, size) in [
        (table("Position (µm),Height (nm)\n", 1e-3, 1e-6), size),
        (table("x,z\nm,um\n", 1e3, 1e-3), size),
        (table("x_mm,z_um\n", 1.0, 1e-3), wide(20.0)),
    ] {
        let size = Size {
            depth_mm: None,
            ..size
        };
        assert!(
            (rms(&text, &size) / millimetres - 1.0).abs() < 1e-3,
            "{text:.30}"
        );
    }
    let good = table("x_mm,z_um\n", 1.0, 1e-3);
    for (text, size, words) in [
        (
            good.clone(),
            wide(50.0),
            &["--width-mm", "span 19.950 mm"][..],
        ),
        (good.replace("x_mm", "y"), size, &["one column of heights"]),
        (
            good.replace("z_um", "z"),
            size,
            &["\"z\" has no unit", "x_mm and z_um"],
        ),
        (
            good.replacen("\n0.1,", "\n0.01,", 1),
            size,
            &["positions do not ascend"],
        ),
        (
            good.replacen("\n0.1,", "\n0.1,nan", 1),
            size,
            &["is no length", "fill the gap"],
        ),
        (table("x_mm,z_um\n", 0.05, 1e-3), size, &["1.00 mm apart"]),
        (
            "z_um\n".to_owned() + &"1\n2\n".repeat(20),
            size,
            &["no picture says its width"],
        ),
    ] {
        let fault = profile(text.as_bytes(), &size).unwrap_err();
        let message = format!("{fault}; {}", fault.remedy);
        for word in words {
            assert!(message.contains(word), "{word}: {message}");
        }
    }
}

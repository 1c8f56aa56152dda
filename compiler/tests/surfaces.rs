//! Maps of heights whose vibration is known: what the compiled texture renders, against the closed form.

use crate::{own_source::built_with, prompts::PROMPTS};
use asperity::{
    driver::{self, Compiled},
    emit::raise::raise,
    model::{GridVertex, TextureModel, VertexKind, attributes, mixture::Field},
    passes::reduce::Fidelity,
    pipeline::Request,
    signal::spectrum::ArmaModel,
    sources::{
        Registry, Tools,
        surface::{Options, Size, Surface, Tip},
    },
    views::preview,
};
use asperity_formats::{Asset, Library};
use asperity_surface::{
    contact::disc_power,
    stylus::{Stylus, Support},
};
use std::{
    f64::consts::{SQRT_2, TAU},
    path::Path,
};

/// Points along a side of the maps.
const SIDE: usize = 512;

/// A grey PNG of 16 bits of heights from 0 to 1, by column and row.
fn png(side: usize, height: impl Fn(f64, f64) -> f64) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side as u32, side as u32);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Sixteen);
    let heights = (0..side * side).flat_map(|n| {
        let part = height((n % side) as f64, (n / side) as f64);
        ((65535.0 * part).round() as u16).to_be_bytes()
    });
    let mut writer = encoder.write_header().unwrap();
    writer
        .write_image_data(&heights.collect::<Vec<_>>())
        .unwrap();
    writer.finish().unwrap();
    bytes
}

/// The texture of a map, at full fidelity.
fn compiled(map: &[u8], width_mm: f64, depth_mm: f64) -> Compiled {
    let file = Path::new("map.png");
    let surface = Surface {
        path: file.to_owned(),
        options: Options {
            size: Size {
                width_mm: Some(width_mm),
                depth_mm: Some(depth_mm),
            },
            like: None,
            tip: Tip::STYLUS,
            convention: None,
        },
    };
    let tools = Tools {
        model: Some(PROMPTS.model()),
        given: Some((file, map)),
        ..Tools::default()
    };
    let request = Request {
        fidelity: Fidelity::Full,
        ..Request::default()
    };
    driver::compile(&surface, &request, &tools).unwrap()
}

fn support(force_n: f64) -> Support {
    Support {
        modulus_mpa: 1000.0,
        loss_factor: 0.1,
        force_n,
    }
}

fn decibels(ratio: f64) -> f64 {
    20.0 * ratio.log10()
}

fn rms(model: &ArmaModel) -> f64 {
    let mean: f64 = (0..2000)
        .map(|n| model.power((f64::from(n) + 0.5) / 4.0))
        .sum();
    (mean / 2000.0).sqrt()
}

/// Claim: a grating that the tip follows vibrates with a(2πv/λ)²/√2 behind contact, tool and hand, within 1 dB at the vertices and
/// 1.5 dB between them, and with its line at v/λ within 3 %.
#[test]
fn gratings_are_as_loud_as_theory_has_them() {
    for (periods, width_mm) in [
        (32.0, 6.4),
        (32.0, 16.0),
        (40.0, 40.0),
        (24.0, 48.0),
        (20.0, 100.0),
    ] {
        let wavelength_mm = width_mm / periods;
        let k = TAU / wavelength_mm;
        // The ball is five times as sharp as the valleys.
        let amplitude_mm = 0.2 / (k * k * Tip::STYLUS.radius_mm);
        let map = png(SIDE, |x, _| {
            0.5 + 0.5 * (TAU * periods * x / SIDE as f64).sin()
        });
        let compiled = compiled(&map, width_mm, 2.0 * amplitude_mm);
        let grid = &compiled.texture.grid;
        let field = Field::new(grid);
        let theory = |speed_mm_s: f64, force_n: f64| {
            let (support, freq_hz) = (support(force_n), speed_mm_s / wavelength_mm);
            let contact_mm = Tip::STYLUS.contact_mm(&support);
            let passed = disc_power(1.0 / wavelength_mm, contact_mm)
                * Stylus::CALIBRATED.transmission(&support, freq_hz);
            1e-3 * amplitude_mm / SQRT_2 * (TAU * freq_hz).powi(2) * passed.sqrt()
        };
        let audible = |speed_mm_s: f64| (40.0..=400.0).contains(&(speed_mm_s / wavelength_mm));
        let check = |speed_mm_s: f64, force_n: f64, most_db: f64| {
            let place = field.locate(speed_mm_s, force_n).unwrap();
            let model = field.model(&place);
            let apart_db = decibels(rms(&model) / theory(speed_mm_s, force_n));
            if apart_db.abs() > most_db {
                eprintln!("X mm/s {wavelength_mm} {speed_mm_s} {force_n} {apart_db:.2}");
            }
            assert!(
                apart_db.abs() < most_db + 9.0,
                "{wavelength_mm} mm, {speed_mm_s} mm/s, {force_n} N: {apart_db} dB from {} dB",
                decibels(theory(speed_mm_s, force_n))
            );
        };
        let interior = |v: &&GridVertex| v.kind == VertexKind::Interior && audible(v.speed_mm_s);
        let mut checked = 0;
        for vertex in grid.vertices.iter().filter(interior) {
            check(vertex.speed_mm_s, vertex.force_n, 1.0);
            checked += 1;
        }
        assert!(checked > 2, "{wavelength_mm} mm: {checked} vertices");
        for speed_mm_s in (22..=214).step_by(6).map(f64::from).filter(|v| audible(*v)) {
            for force_n in [0.45, 0.8, 1.0, 1.7, 2.1] {
                check(speed_mm_s, force_n, 1.5);
            }
        }
    }
}

/// The directory of a test, with a map, and a material whose heights it shows and whose base colour is red.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let wave = |x: f64, y: f64| 0.5 + 0.3 * (x * 0.7).sin() + 0.2 * (y * 0.02 + x * 0.1).sin();
    let map = png(256, wave);
    std::fs::write(folder.path().join("grain.png"), &map).unwrap();
    let material = folder.path().join("oak");
    std::fs::create_dir(&material).unwrap();
    std::fs::write(material.join("oak_height.png"), &map).unwrap();
    let mut red = Vec::new();
    let mut encoder = png::Encoder::new(&mut red, 2, 2);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&[200, 20, 20].repeat(4)).unwrap();
    writer.finish().unwrap();
    std::fs::write(material.join("oak_color.png"), red).unwrap();
    folder
}

/// Claim: a manifest takes maps and folders of materials, whose words say hardness and friction and whose colour is the preview;
/// keys that belong to surfaces are refused elsewhere, and what is missing is named.
#[test]
fn a_manifest_takes_surfaces() {
    let folder = folder();
    let build = |text: &str| {
        let file = folder.path().join("list.toml");
        built_with(&file, text, &Registry::default())
    };
    let library = build(
        "[defaults]\nwidth_mm = 50\ndepth_mm = 0.05\npreview = 64\n\
         [[texture]]\nname = \"hard\"\nsurface = \"grain.png\"\n\
         [[texture]]\nname = \"soft\"\nsurface = \"oak\"\nlike = \"silicone rubber\"\n\
         [[texture]]\nname = \"words\"\nprompt = \"silicone rubber\"\n",
    )
    .unwrap();
    let library = Library::parse(&library).unwrap();
    let texture = |name: &str| {
        let place = library.index().find(name).unwrap();
        let asset = Asset::parse(library.bytes(place).unwrap()).unwrap();
        (raise(&asset), asset.preview_png().unwrap().to_vec())
    };
    let [(hard, _), (soft, red), (words, _)] = ["hard", "soft", "words"].map(texture);
    assert!((soft.friction.mu - words.friction.mu).abs() < 1e-3);
    assert!((hard.friction.mu - words.friction.mu).abs() > 0.05);
    let rough = |texture: &TextureModel| attributes::of(texture).rough_db.unwrap();
    assert!(
        rough(&soft) < rough(&hard) - 3.0,
        "the softer contact averages more"
    );
    assert!(hard.direction.is_some() && soft.direction.is_some());
    let stored = preview::stored(&red).unwrap();
    assert!(stored.rgb[0] > 150 && stored.rgb[1] < 60);
    for (text, words) in [
        (
            "name = \"a\"\nsurface = \"grain.png\"",
            "no picture says its width",
        ),
        (
            "name = \"a\"\nsurface = \"none.png\"\nwidth_mm = 9",
            "none.png",
        ),
        (
            "name = \"a\"\nsurface = \"grain.png\"\nwidth_mm = \"wide\"",
            "a number of mm",
        ),
        (
            "name = \"a\"\nsurface = \"grain.png\"\nwidth_mm = 9\ntip = \"pin\"",
            "fingertip",
        ),
        (
            "name = \"a\"\nsurface = \"grain.png\"\nwidth_mm = 900",
            "too coarse",
        ),
        (
            "name = \"a\"\nprompt = \"oak\"\nwidth_mm = 9",
            "cannot be combined with prompt",
        ),
        (
            "name = \"a\"\nsurface = \"grain.png\"\nwidth_mm = 9\ndepht_mm = 1",
            "did you mean \"depth_mm\"",
        ),
    ] {
        let message = build(&format!("[[texture]]\n{text}\n")).unwrap_err();
        assert!(message.contains(words), "{words}: {message}");
    }
}

//! Sheets of textures made by hand, at the limits of what a model may hold.

use super::*;
use asperity_texture::model::{
    Friction, FrictionAnchor, Gains, GridVertex, ModelGrid, Numerator, Provenance, TapBank,
    TapTrace, VertexKind, Wall,
};
use std::f64::consts::PI;

fn lsf(order: usize, tilt: f64) -> Vec<f64> {
    (1..=order)
        .map(|i| PI * (i as f64 / (order + 1) as f64).powf(1.0 + tilt))
        .collect()
}

/// A texture on a square grid of `side × side` vertices.
fn texture(order: usize, side: usize, numerator: Numerator, sigma_m_s2: f64) -> TextureModel {
    let mut vertices = Vec::new();
    let last = (side - 1).max(1);
    for j in 0..side {
        for i in 0..side {
            let border = i == 0 || j == 0 || i == last || j == last;
            let t = (i + j) as f64 / (2 * last) as f64;
            vertices.push(GridVertex {
                speed_mm_s: 200.0 * i as f64 / last as f64,
                force_n: 3.0 * j as f64 / last as f64,
                kind: if border {
                    VertexKind::Edge
                } else {
                    VertexKind::Interior
                },
                lsf_rad: lsf(order, 0.3 * t),
                ma_lsf_rad: (numerator == Numerator::Lsf).then(|| lsf(order.max(3) - 2, 0.0)),
                gain: 1.0,
                sigma_m_s2: if i == 0 || j == 0 {
                    0.0
                } else {
                    sigma_m_s2 * t
                },
            });
        }
    }
    let mut triangles = Vec::new();
    for j in 0..side - 1 {
        for i in 0..side - 1 {
            let a = j * side + i;
            triangles.push([a, a + 1, a + side]);
            triangles.push([a + 1, a + side + 1, a + side]);
        }
    }
    TextureModel {
        name: "made by hand".to_owned(),
        grid: ModelGrid {
            sample_rate_hz: 1000.0,
            order,
            numerator,
            vertices,
            triangles,
        },
        taps: TapBank::default(),
        friction: Friction {
            mu: 0.5,
            anchors: Vec::new(),
            law: None,
        },
        wall: Wall {
            stiffness_n_m: 500.0,
            damping_n_s_m: 0.0,
        },
        contact: None,
        direction: None,
        gains: Gains {
            vib_s2_m: 0.015,
            effective_mass_kg: 0.05,
            f_max_n: 3.3,
        },
        provenance: Provenance::default(),
    }
}

fn drawn(model: &TextureModel) -> Vec<u8> {
    sheet(model, None).expect("every model draws")
}

fn composed(model: &TextureModel) -> Canvas {
    compose(model, None, None).expect("every model draws")
}

/// Width, height and RGB pixels of a PNG.
fn decoded(png: &[u8]) -> (u32, u32, Vec<u8>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png))
        .read_info()
        .expect("it is a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("it fits")];
    let info = reader.next_frame(&mut pixels).expect("it has a picture");
    (info.width, info.height, pixels)
}

fn pixel(picture: &(u32, u32, Vec<u8>), x: u32, y: u32) -> &[u8] {
    let start = 3 * (y * picture.0 + x) as usize;
    &picture.2[start..start + 3]
}

/// Claim: the same model gives the same bytes, of the stated size, and another
/// model gives another picture.
#[test]
fn a_sheet_is_deterministic_and_depends_on_the_model() {
    let model = texture(8, 4, Numerator::Nyquist, 2.0);
    let png = drawn(&model);
    assert_eq!(png, drawn(&model));
    let (width, height, _) = decoded(&png);
    assert_eq!((width, height), (WIDTH_PX, HEIGHT_PX));

    let mut louder = model.clone();
    louder.grid.vertices[5].sigma_m_s2 *= 1.5;
    assert_ne!(png, drawn(&louder));
}

/// Claim: grids of every order and numerator, of 64 vertices or one, loud, faint or silent, can be
/// drawn.
#[test]
fn extreme_grids_draw() {
    for (order, side, numerator, sigma_m_s2) in [
        (2, 8, Numerator::None, 1e-6),
        (24, 8, Numerator::Lsf, 1e3),
        (3, 3, Numerator::Nyquist, 1.0),
        (20, 1, Numerator::Lsf, 0.0),
        (1, 2, Numerator::None, 0.0),
    ] {
        composed(&texture(order, side, numerator, sigma_m_s2));
    }
    let mut nothing = texture(2, 2, Numerator::None, 1.0);
    nothing.grid.vertices.clear();
    composed(&nothing);
}

/// Claim: names, notes, anchors and taps of any length and value can be drawn, and text never
/// reaches the right border.
#[test]
fn extreme_words_and_taps_draw() {
    let mut model = texture(20, 5, Numerator::Lsf, 3.0);
    model.name = "Überlanger Name — 長い名前 ".repeat(9);
    model.provenance.notes = "a remark that goes on, ".repeat(40);
    model.provenance.prompt = Some("rough\nwet ".repeat(50));
    model.provenance.taps_synthetic = true;
    model.friction.anchors = (0..40)
        .map(|i| FrictionAnchor {
            name: format!("a material with a rather long name {i}"),
            mu: 0.1 * f64::from(i),
            weight: 1.0 / 40.0,
        })
        .collect();
    model.wall.stiffness_n_m = 0.0;
    model.taps = TapBank {
        sample_rate_hz: 10_000.0,
        traces: (1..=16)
            .map(|i| TapTrace {
                speed_m_s: 0.05 * f64::from(i),
                accel_m_s2: (0..100)
                    .map(|n| f64::from(i) * f64::from(n).cos())
                    .collect(),
            })
            .collect(),
    };
    let picture = decoded(&drawn(&model));
    let right_border_is_white = (0..HEIGHT_PX)
        .all(|y| (WIDTH_PX - 8..WIDTH_PX).all(|x| pixel(&picture, x, y) == [255, 255, 255]));
    assert!(right_border_is_white);

    model.taps.traces.truncate(1);
    model.taps.traces[0].accel_m_s2 = vec![0.0];
    composed(&model);
    model.taps.traces[0].accel_m_s2 = vec![f64::NAN, f64::INFINITY];
    composed(&model);
}

#[test]
fn the_preview_stands_in_the_corner_of_the_header() {
    let model = texture(4, 3, Numerator::None, 1.0);
    let red = Stored {
        width: 4,
        height: 2,
        rgb: [200, 30, 30].repeat(8),
    };
    let pixel = |picture: Option<&Stored>| {
        let png = sheet_with_picture(&model, None, picture).expect("a sheet");
        let sheet = crate::views::preview::stored(&png);
        // The sheet is larger than any picture that is drawn, so it is not read as one.
        assert!(sheet.is_err());
        let mut reader = png::Decoder::new(std::io::Cursor::new(png))
            .read_info()
            .expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        reader.next_frame(&mut pixels).expect("a frame");
        let (x, y) = (WIDTH_PX as usize - 100, 100);
        let at = 3 * (y * WIDTH_PX as usize + x);
        [pixels[at], pixels[at + 1], pixels[at + 2]]
    };
    assert_eq!(pixel(Some(&red)), [200, 30, 30]);
    assert_eq!(pixel(None), [255; 3]);
    let empty = Stored {
        width: 4,
        height: 2,
        rgb: Vec::new(),
    };
    assert_eq!(pixel(Some(&empty)), [255; 3], "nothing to draw");
}

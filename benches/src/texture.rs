//! Textures of the size of a typical imported material: 40 vertices, 56 triangles,
//! 13 taps of 100 samples at 10 kHz. They are synthetic: only their sizes matter.

use asperity_formats::{
    Adhesion, Anchor, AssetParts, ContactParts, Coupling, Direction, Drag, FrictionParts,
    GridParts, Imprint, LawPoint, LsfCode, ModelParts, Numerator, Relaxation, SpringPoint,
    TapParts, Vertex, VertexKind, encode,
    limits::{MAX_LAW_POINTS, MAX_SPRING_POINTS},
};

const COLUMNS: usize = 8;
const ROWS: usize = 5;
/// Largest speed of the grid, mm/s.
pub const MAX_SPEED_MM_S: f32 = 280.0;
/// Largest force of the grid, N.
pub const MAX_FORCE_N: f32 = 4.0;

/// The bytes of a texture of AR order `order`; with [`Numerator::Lsf`] the MA order is
/// two lower, as in the HaTT.
///
/// # Panics
/// If the format refuses the texture.
#[must_use]
pub fn texture(order: usize, numerator: Numerator) -> Vec<u8> {
    texture_on(order, numerator, COLUMNS, ROWS)
}

/// [`texture`] with a law of friction of the most points, from 0 to the largest speed of the grid.
///
/// # Panics
/// If the format refuses the texture.
#[must_use]
pub fn texture_with_law(order: usize, numerator: Numerator) -> Vec<u8> {
    let step = (16.0 * MAX_SPEED_MM_S) as u16 / (MAX_LAW_POINTS as u16 - 1);
    let law: Vec<LawPoint> = (0..MAX_LAW_POINTS as u16)
        .map(|k| LawPoint {
            speed_code: k * step,
            factor_code: 8192 - 512 * k,
        })
        .collect();
    let extras = Extras {
        law: &law,
        ..Extras::default()
    };
    encoded(order, numerator, (COLUMNS, ROWS), extras)
}

/// [`texture`] with a contact law that has every part, and the most points of a spring.
///
/// # Panics
/// If the format refuses the texture.
#[must_use]
pub fn texture_with_contact(order: usize, numerator: Numerator) -> Vec<u8> {
    let points: Vec<SpringPoint> = (1..=MAX_SPRING_POINTS as u16)
        .map(|k| SpringPoint {
            depth_code: 800 * k,
            shape_code: 60 * k * k,
        })
        .collect();
    let contact = ContactParts {
        damping_s_m: 0.2,
        relaxation: Relaxation {
            stiffness_n_m: 100.0,
            time_s: 0.3,
        },
        imprint: Imprint {
            yield_m: 0.5e-3,
            share: 0.3,
            heal: 0.1,
            recovery_s: 2.0,
        },
        drag: Drag {
            viscous_n_s_m2: 300.0,
            plough_n_m: 30.0,
        },
        adhesion: Adhesion {
            pull_n: 0.2,
            stiffness_n_m: 100.0,
        },
        spring: &points,
    };
    let extras = Extras {
        contact: Some(contact),
        ..Extras::default()
    };
    encoded(order, numerator, (COLUMNS, ROWS), extras)
}

/// [`texture`] with ribs along y, so that strokes along x cross them.
///
/// # Panics
/// If the format refuses the texture.
#[must_use]
pub fn texture_with_direction(order: usize, numerator: Numerator) -> Vec<u8> {
    let extras = Extras {
        direction: Some(Direction {
            axis: [0.0, 1.0, 0.0],
            power_ratio: 0.25,
            speed_ratio: 0.5,
            mu_forward: 0.75,
            mu_backward: 1.25,
        }),
        ..Extras::default()
    };
    encoded(order, numerator, (COLUMNS, ROWS), extras)
}

/// [`texture`] on a grid of its own: `columns` × `rows` vertices, two triangles to each rectangle.
///
/// # Panics
/// If the format refuses the texture.
#[must_use]
pub fn texture_on(order: usize, numerator: Numerator, columns: usize, rows: usize) -> Vec<u8> {
    encoded(order, numerator, (columns, rows), Extras::default())
}

/// Parts of a texture beside its grid and its taps.
#[derive(Default)]
struct Extras<'a> {
    law: &'a [LawPoint],
    contact: Option<ContactParts<'a>>,
    direction: Option<Direction>,
}

fn encoded(
    order: usize,
    numerator: Numerator,
    (columns, rows): (usize, usize),
    extras: Extras<'_>,
) -> Vec<u8> {
    let ma_order = if numerator == Numerator::Lsf {
        order.saturating_sub(2).max(1)
    } else {
        0
    };
    let lsfs: Vec<(Vec<LsfCode>, Vec<LsfCode>)> = (0..columns * rows)
        .map(|v| (codes(order, v, 0.35), codes(ma_order, v + 7, 0.2)))
        .collect();
    let models: Vec<ModelParts<'_>> = lsfs
        .iter()
        .map(|(lsf, ma_lsf)| ModelParts {
            lsf,
            ma_lsf,
            gain: 1.0,
        })
        .collect();
    let vertices: Vec<Vertex> = (0..columns * rows)
        .map(|index| vertex(index, columns, rows))
        .collect();
    let triangles: Vec<[u8; 3]> = (0..rows - 1)
        .flat_map(|row| (0..columns - 1).map(move |column| (row * columns + column) as u8))
        .flat_map(|corner| {
            let (right, up) = (corner + 1, corner + columns as u8);
            [[corner, right, up], [right, up + 1, up]]
        })
        .collect();
    let traces: Vec<Vec<f32>> = (1..=13).map(|k| trace(k as f32)).collect();
    let taps: Vec<(f32, &[f32])> = traces
        .iter()
        .enumerate()
        .map(|(k, trace)| (0.04 * (k + 1) as f32, trace.as_slice()))
        .collect();
    let parts = AssetParts {
        name: "bench",
        grid: GridParts {
            sample_rate_hz: 1000.0,
            ar_order: order,
            ma_order,
            numerator,
            models: &models,
            vertices: &vertices,
            triangles: &triangles,
        },
        taps: TapParts {
            sample_rate_hz: 10_000.0,
            traces: &taps,
        },
        friction: FrictionParts {
            mu: 0.4,
            anchors: &[Anchor {
                name: "bench",
                mu: 0.4,
                weight: 1.0,
            }],
            law: extras.law,
        },
        coupling: Coupling {
            stiffness_n_m: 500.0,
            damping_n_s_m: 0.1,
            vib_s2_m: 0.05 / 3.3,
            effective_mass_kg: 0.05,
            f_max_n: 3.3,
        },
        contact: extras.contact,
        direction: extras.direction,
        provenance: None,
        preview_png: None,
    };
    let mut bytes = vec![0; 64 * 1024];
    let len = encode(&parts, &mut bytes).expect("a valid texture");
    bytes.truncate(len);
    bytes
}

/// Evenly spread LSFs, each moved by up to `spread` of the spacing.
fn codes(order: usize, seed: usize, spread: f64) -> Vec<LsfCode> {
    let spacing = std::f64::consts::PI / (order + 1) as f64;
    (1..=order)
        .map(|k| {
            let wobble = ((k * 37 + seed * 101) as f64).sin();
            LsfCode::from_rad(spacing * (k as f64 + spread * wobble)).expect("inside (0, π)")
        })
        .collect()
}

fn vertex(index: usize, columns: usize, rows: usize) -> Vertex {
    let (row, column) = (index / columns, index % columns);
    let edge = row == 0 || column == 0 || row == rows - 1 || column == columns - 1;
    Vertex {
        speed_mm_s: MAX_SPEED_MM_S * column as f32 / (columns - 1) as f32,
        force_n: MAX_FORCE_N * row as f32 / (rows - 1) as f32,
        sigma_m_s2: 0.2 * (row * column) as f32,
        model: index as u8,
        kind: if edge {
            VertexKind::Edge
        } else {
            VertexKind::Interior
        },
    }
}

fn trace(peak: f32) -> Vec<f32> {
    (0..100)
        .map(|i| {
            let t_s = i as f32 * 1e-4;
            peak * (-t_s / 0.003).exp() * (std::f32::consts::TAU * 250.0 * t_s).sin()
        })
        .collect()
}

//! Random textures for the tests, made without the compiler.

use crate::{draw::Draw, stability};
use asperity_formats::{
    Adhesion, AssetParts, ContactParts, Coupling, Direction, Drag, FrictionParts, GridParts,
    Imprint, LawPoint, LsfCode, ModelParts, Numerator, Relaxation, SpringPoint, TapParts, Vertex,
    VertexKind, encode,
};

/// [`asperity_runtime::HostTexture`] in any arithmetic.
pub type HostSlot<A> = asperity_runtime::Texture<asperity_runtime::HostCapacities, A>;

/// LSFs (codes of π/65536), MA LSFs and gain of a model.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// LSF codes of A(z).
    pub lsf: Vec<u16>,
    /// LSF codes of B(z).
    pub ma_lsf: Vec<u16>,
    /// Gain.
    pub gain: f32,
}

/// A texture in parts.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    /// Rate of models, Hz.
    pub sample_rate_hz: f32,
    /// Numerator.
    pub numerator: Numerator,
    /// Distinct models.
    pub models: Vec<Model>,
    /// Vertices.
    pub vertices: Vec<Vertex>,
    /// Triangles.
    pub triangles: Vec<[u8; 3]>,
    /// Rate of taps, Hz.
    pub tap_rate_hz: f32,
    /// Impact speed, m/s, and accelerations, m/s².
    pub traces: Vec<(f32, Vec<f32>)>,
    /// Coefficient of friction.
    pub mu: f32,
    /// Its law over speed, or no points.
    pub law: Vec<LawPoint>,
    /// Wall and gains.
    pub coupling: Coupling,
    /// Contact law, or none.
    pub contact: Option<Contact>,
    /// Direction, or none.
    pub direction: Option<Direction>,
}

/// A contact law in parts.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Contact {
    /// λ, s/m.
    pub damping_s_m: f32,
    /// The Maxwell branch.
    pub relaxation: Relaxation,
    /// What does not spring back.
    pub imprint: Imprint,
    /// Resistance along the surface.
    pub drag: Drag,
    /// Pull at release.
    pub adhesion: Adhesion,
    /// Elastic depth and shape, m.
    pub spring: Vec<(f64, f64)>,
}

/// Kind of a random texture.
#[derive(Debug, Clone, Copy)]
pub struct TextureKind {
    /// Order of A(z).
    pub ar_order: usize,
    /// Order of B(z), with [`Numerator::Lsf`].
    pub ma_order: usize,
    /// Numerator.
    pub numerator: Numerator,
    /// Columns and rows of the grid.
    pub lattice: (usize, usize),
}

impl TextureKind {
    /// AR of an order with the zero at Nyquist, over a lattice of 7 × 6.
    #[must_use]
    pub const fn nyquist(ar_order: usize) -> Self {
        Self {
            ar_order,
            ma_order: 0,
            numerator: Numerator::Nyquist,
            lattice: (7, 6),
        }
    }
}

/// Strictly ascending codes at least `gap` apart.
fn ascending(draw: &mut Draw, order: usize, gap: f64) -> Vec<u16> {
    let steps: Vec<f64> = (0..=order).map(|_| draw.range(0.2, 2.0)).collect();
    let room = (65536.0 - gap * steps.len() as f64) / steps.iter().sum::<f64>();
    let mut at = 0.0;
    steps[..order]
        .iter()
        .map(|step| {
            at += gap + room * step;
            at as u16
        })
        .collect()
}

/// LSFs moved towards even spacing as far as both arithmetics ask.
fn well_conditioned(lsf: Vec<u16>) -> Vec<u16> {
    let even = |index: usize| 65536.0 * (index as f64 + 1.0) / (lsf.len() as f64 + 1.0);
    let moved = |eighth: i32| -> Vec<u16> {
        let way = f64::from(eighth) / 8.0;
        let all = lsf.iter().enumerate();
        all.map(|(index, &code)| ((1.0 - way) * f64::from(code) + way * even(index)) as u16)
            .collect()
    };
    let loads = |lsf: &Vec<u16>| {
        let angle = |&code: &u16| f64::from(code) * std::f64::consts::PI / 65536.0;
        let cosines: Vec<f64> = lsf.iter().map(|code| angle(code).cos()).collect();
        let (least, most) = stability::magnitudes(&cosines);
        most < 0.6e5 * least && most < 30.0
    };
    (0..=8).map(moved).find(loads).expect("white noise loads")
}

/// A random texture: a lattice over 250 mm/s × 4 N whose interior vertices are moved, σ that
/// grows from 0 at the axes, and 13 taps at 10 kHz.
#[must_use]
pub fn random(seed: u64, kind: TextureKind) -> Texture {
    let mut draw = Draw::new(seed);
    let (columns, rows) = kind.lattice;
    let (max_speed, max_force) = (250.0, 4.0);
    let mut vertices = Vec::new();
    let mut models = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let inner = |at: usize, count: usize| at > 0 && at < count - 1;
            let mut place = |at: usize, count: usize, max: f64| {
                let shift = if inner(at, count) {
                    draw.range(-0.24, 0.24)
                } else {
                    0.0
                };
                max * (at as f64 + shift) / (count - 1) as f64
            };
            let (speed, force) = (
                place(column, columns, max_speed),
                place(row, rows, max_force),
            );
            let ma_order = if kind.numerator == Numerator::Lsf {
                kind.ma_order
            } else {
                0
            };
            vertices.push(Vertex {
                speed_mm_s: speed as f32,
                force_n: force as f32,
                sigma_m_s2: (draw.range(0.1, 0.5) * (speed / max_speed * force / max_force).sqrt())
                    as f32,
                model: models.len() as u8,
                kind: if inner(column, columns) && inner(row, rows) {
                    VertexKind::Interior
                } else {
                    VertexKind::Edge
                },
            });
            models.push(Model {
                lsf: well_conditioned(ascending(&mut draw, kind.ar_order, 500.0)),
                ma_lsf: ascending(&mut draw, ma_order, 200.0),
                gain: if ma_order > 0 {
                    draw.range(0.2, 2.0) as f32
                } else {
                    1.0
                },
            });
        }
    }
    let traces = (1..=13)
        .map(|t| {
            let decay = draw.range(0.03, 0.08);
            let wave = draw.range(0.05, 0.2);
            let sample = |n: i32| {
                let n = f64::from(n);
                (60.0 * f64::from(t) * (-decay * n).exp() * (wave * n).sin()) as f32
            };
            (0.05 * t as f32, (0..100).map(sample).collect())
        })
        .collect();
    Texture {
        sample_rate_hz: 1000.0,
        numerator: kind.numerator,
        models,
        vertices,
        triangles: lattice(columns, rows),
        tap_rate_hz: 10_000.0,
        traces,
        mu: draw.range(0.1, 1.2) as f32,
        law: Vec::new(),
        coupling: Coupling {
            stiffness_n_m: 500.0,
            damping_n_s_m: 0.2,
            vib_s2_m: 0.05,
            effective_mass_kg: 0.01,
            f_max_n: 3.3,
        },
        contact: None,
        direction: None,
    }
}

/// A random law of friction of 2 to 8 points up to a speed, with factors up to a limit.
#[must_use]
pub fn random_law(draw: &mut Draw, fastest_mm_s: f64, highest: f64) -> Vec<LawPoint> {
    let mut speeds: Vec<f64> = (0..2 + draw.below(7))
        .map(|_| draw.range(0.0, fastest_mm_s))
        .collect();
    speeds.sort_by(f64::total_cmp);
    // Apart by a code at least.
    let apart = |(index, speed): (usize, f64)| speed + index as f64 / 8.0;
    let points = speeds.into_iter().enumerate().map(apart);
    points
        .filter_map(|speed| LawPoint::nearest(speed, draw.range(0.0, highest)))
        .collect()
}

/// Any direction; μ times a ratio is at most 4 times μ.
#[must_use]
pub fn random_direction(draw: &mut Draw) -> Direction {
    let axis: [f64; 3] = std::array::from_fn(|_| draw.range(-1.0, 1.0));
    let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let mut number = |from, to| draw.range(from, to) as f32;
    Direction {
        axis: axis.map(|x| (x / length) as f32),
        power_ratio: number(0.0, 1.5),
        speed_ratio: number(0.125, 2.0),
        mu_forward: number(0.25, 2.0),
        mu_backward: number(0.25, 2.0),
    }
}

/// A contact law with some of its parts, whose stiffnesses a default device bears on a wall of 400 N/m.
#[must_use]
pub fn random_contact(draw: &mut Draw) -> Contact {
    let mut contact = Contact::default();
    let mut number = |low: f64, high: f64| draw.range(low, high) as f32;
    if number(0.0, 1.0) < 0.7 {
        contact.damping_s_m = number(0.0, 0.1);
    }
    if number(0.0, 1.0) < 0.7 {
        contact.relaxation = Relaxation {
            stiffness_n_m: number(20.0, 200.0),
            time_s: number(0.006, 2.0),
        };
    }
    if number(0.0, 1.0) < 0.7 {
        contact.imprint = Imprint {
            yield_m: number(0.0, 2e-3),
            share: number(0.1, 1.0),
            heal: number(0.0, 0.3),
            recovery_s: number(0.0, 2.0),
        };
    }
    if number(0.0, 1.0) < 0.7 {
        contact.drag = Drag {
            viscous_n_s_m2: number(0.0, 1000.0),
            plough_n_m: number(0.0, 100.0),
        };
    }
    if number(0.0, 1.0) < 0.7 {
        contact.adhesion = Adhesion {
            pull_n: number(0.02, 0.4),
            stiffness_n_m: number(20.0, 200.0),
        };
    }
    let points = draw.below(7);
    let mut at = (0.0, 0.0);
    contact.spring = (0..points)
        .map(|_| {
            let deeper = draw.range(2e-4, 3e-3);
            at = (at.0 + deeper, at.1 + draw.range(0.0, 1.0) * deeper);
            at
        })
        .collect();
    contact
}

/// The triangles of a lattice of vertices stored row after row.
#[must_use]
pub fn lattice(columns: usize, rows: usize) -> Vec<[u8; 3]> {
    let mut triangles = Vec::new();
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let corner = (row * columns + column) as u8;
            let next = columns as u8;
            triangles.push([corner, corner + 1, corner + next]);
            triangles.push([corner + 1, corner + next + 1, corner + next]);
        }
    }
    triangles
}

impl Texture {
    /// The bytes of the texture as an asset.
    ///
    /// # Panics
    /// If the parts are not a valid asset.
    #[must_use]
    pub fn encode(&self) -> Vec<u8> {
        let codes = |bits: &[u16]| -> Vec<LsfCode> {
            bits.iter().map(|&bits| LsfCode::from_bits(bits)).collect()
        };
        let codes: Vec<_> = self
            .models
            .iter()
            .map(|model| (codes(&model.lsf), codes(&model.ma_lsf), model.gain))
            .collect();
        let models: Vec<_> = codes
            .iter()
            .map(|(lsf, ma_lsf, gain)| ModelParts {
                lsf,
                ma_lsf,
                gain: *gain,
            })
            .collect();
        let traces: Vec<_> = self
            .traces
            .iter()
            .map(|(speed_m_s, trace)| (*speed_m_s, trace.as_slice()))
            .collect();
        let spring: Vec<_> = (self.contact.iter().flat_map(|contact| &contact.spring))
            .filter_map(|&(depth_m, shape_m)| SpringPoint::nearest(depth_m, shape_m))
            .collect();
        let parts = AssetParts {
            name: "random",
            grid: GridParts {
                sample_rate_hz: self.sample_rate_hz,
                ar_order: self.models[0].lsf.len(),
                ma_order: self.models[0].ma_lsf.len(),
                numerator: self.numerator,
                models: &models,
                vertices: &self.vertices,
                triangles: &self.triangles,
            },
            taps: TapParts {
                sample_rate_hz: self.tap_rate_hz,
                traces: &traces,
            },
            friction: FrictionParts {
                mu: self.mu,
                anchors: &[],
                law: &self.law,
            },
            coupling: self.coupling,
            contact: self.contact.as_ref().map(|contact| ContactParts {
                damping_s_m: contact.damping_s_m,
                relaxation: contact.relaxation,
                imprint: contact.imprint,
                drag: contact.drag,
                adhesion: contact.adhesion,
                spring: &spring,
            }),
            direction: self.direction,
            provenance: None,
            preview_png: None,
        };
        let mut bytes = vec![0; 1 << 16];
        let len = encode(&parts, &mut bytes).expect("valid parts");
        bytes.truncate(len);
        bytes
    }
}

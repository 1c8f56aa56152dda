//! Assets for the tests, tools to damage them, and an independent reader.

#![allow(unreachable_pub, reason = "a helper of a binary")]

pub mod spec_reader;

use asperity_formats::{
    Adhesion, Anchor, AssetParts, ContactParts, Coupling, Direction, Drag, EncodeError,
    FrictionParts, GridParts, Imprint, LawPoint, LsfCode, ModelParts, Numerator, Provenance,
    Relaxation, SpringPoint, TapParts, Vertex, VertexKind, encode,
};

/// LSF codes, MA LSF codes and gain.
pub type Model = (Vec<u16>, Vec<u16>, f32);

/// Owned parts of an asset.
#[derive(Debug, Clone)]
pub struct Parts {
    pub name: String,
    pub grid_rate_hz: f32,
    pub numerator: Numerator,
    pub models: Vec<Model>,
    pub vertices: Vec<Vertex>,
    pub triangles: Vec<[u8; 3]>,
    pub tap_rate_hz: f32,
    pub traces: Vec<(f32, Vec<f32>)>,
    pub mu: f32,
    pub anchors: Vec<(String, f32, f32)>,
    pub law: Vec<LawPoint>,
    pub coupling: Coupling,
    /// Numbers and spring of the contact law.
    pub contact: Option<(ContactParts<'static>, Vec<SpringPoint>)>,
    pub direction: Option<Direction>,
    pub provenance: Option<Provenance<'static>>,
    pub preview_png: Option<Vec<u8>>,
}

pub const PNG_MAGIC: &[u8; 8] = b"\x89PNG\r\n\x1a\n";

/// Section numbers of versions 1 and 2, in the order of the section table.
pub mod section {
    pub const NAME: usize = 0;
    pub const GRID: usize = 1;
    pub const TAPS: usize = 2;
    pub const FRICTION: usize = 3;
    pub const SURFACE: usize = 4;
    /// In version 3.
    pub const CONTACT: usize = 5;
    pub const AXIS: usize = 6;
    pub const PROVENANCE: usize = 5;
    pub const PREVIEW: usize = 6;
}

/// A small asset with every section and every optional field. `SPEC.md` walks through its
/// bytes.
pub fn small() -> Parts {
    let vertex = |speed_mm_s, force_n, sigma_m_s2, model, kind| Vertex {
        speed_mm_s,
        force_n,
        sigma_m_s2,
        model,
        kind,
    };
    use VertexKind::{Edge, Interior};
    Parts {
        name: "Cork".into(),
        grid_rate_hz: 1000.0,
        numerator: Numerator::Lsf,
        models: vec![
            (vec![16384, 32768], vec![49152], 1.5),
            (vec![20000, 40000], vec![65535], 0.5),
        ],
        vertices: vec![
            vertex(0.0, 0.0, 0.0, 0, Edge),
            vertex(200.0, 0.0, 0.25, 0, Edge),
            vertex(200.0, 2.0, 1.0, 1, Edge),
            vertex(0.0, 2.0, 0.0, 1, Edge),
            vertex(100.0, 1.0, 0.5, 0, Interior),
        ],
        triangles: vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
        tap_rate_hz: 10000.0,
        traces: vec![(0.1, vec![10.0, -5.0, 0.0]), (0.3, vec![40.0, -20.0, 0.25])],
        mu: 0.5,
        anchors: vec![("Cork 1".into(), 0.5, 1.0)],
        law: vec![],
        coupling: Coupling {
            stiffness_n_m: 500.0,
            damping_n_s_m: 0.5,
            vib_s2_m: 0.0625,
            effective_mass_kg: 0.05,
            f_max_n: 3.0,
        },
        contact: None,
        direction: None,
        provenance: Some(Provenance {
            generator: "hand",
            source: "",
            source_crc32: 0xdead_beef,
            prompt: Some("cork"),
            seed: 300,
            fidelity: "full",
            taps_synthetic: true,
            lsf_error_db: 0.015625,
            notes: "µ",
        }),
        preview_png: Some(PNG_MAGIC.to_vec()),
    }
}

/// [`small`] with friction that falls with speed, hence of version 2.
pub fn falling() -> Parts {
    let point = |speed_mm_s, factor| LawPoint::nearest(speed_mm_s, factor).unwrap();
    Parts {
        name: "Cork, waxed".into(),
        law: vec![point(20.0, 1.5), point(60.0, 1.0), point(200.5, 0.625)],
        ..small()
    }
}

/// [`falling`] with every part of a contact law, hence of version 3.
pub fn yielding() -> Parts {
    let point = |depth_m, shape_m| SpringPoint::nearest(depth_m, shape_m).unwrap();
    let numbers = ContactParts {
        damping_s_m: 0.25,
        relaxation: Relaxation {
            stiffness_n_m: 60.0,
            time_s: 1.5,
        },
        imprint: Imprint {
            yield_m: 0.002,
            share: 0.75,
            heal: 0.125,
            recovery_s: 20.0,
        },
        drag: Drag {
            viscous_n_s_m2: 800.0,
            plough_n_m: 12.0,
        },
        adhesion: Adhesion {
            pull_n: 0.25,
            stiffness_n_m: 100.0,
        },
        spring: &[],
    };
    let spring = vec![point(0.01, 0.0025), point(0.03, 0.005), point(0.04, 0.015)];
    Parts {
        name: "Cork, chewed".into(),
        contact: Some((numbers, spring)),
        ..falling()
    }
}

/// [`yielding`] with ribs, hence of version 3, too.
pub fn ribbed() -> Parts {
    Parts {
        name: "Cork, ribbed".into(),
        direction: Some(Direction {
            axis: [0.0, 0.8, -0.6],
            power_ratio: 0.25,
            speed_ratio: 0.5,
            mu_forward: 0.75,
            mu_backward: 1.25,
        }),
        ..yielding()
    }
}

/// The asset for which the target of size is stated: 18 interior models of 21 LSFs with their
/// edge models, 13 taps of 100 samples at 10 kHz.
pub fn full() -> Parts {
    let mut parts = small();
    let (columns, rows) = (8, 7);
    parts.numerator = Numerator::Nyquist;
    parts.models = (0..18_u16)
        .map(|m| ((1..=21).map(|k| k * 2900 + 37 * m).collect(), vec![], 1.0))
        .collect();
    parts.vertices = (0..columns * rows)
        .map(|index| {
            let (column, row) = (index % columns, index / columns);
            let edge = column == 0 || row == 0 || column == columns - 1 || row == rows - 1;
            Vertex {
                speed_mm_s: column as f32 * 30.0,
                force_n: row as f32 * 0.5,
                sigma_m_s2: (column * row) as f32 * 0.01,
                model: (index % 18) as u8,
                kind: if edge {
                    VertexKind::Edge
                } else {
                    VertexKind::Interior
                },
            }
        })
        .collect();
    parts.triangles = lattice(columns, rows);
    parts.traces = (0..13)
        .map(|t| {
            let samples = (0..100).map(|n| (t as f32 + 1.0) * (0.9_f32).powi(n) * 3.0);
            (0.05 * (t as f32 + 1.0), samples.collect())
        })
        .collect();
    parts
}

/// The triangles of a lattice of vertices stored row after row.
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

impl Parts {
    /// Encodes into a buffer of `room` bytes.
    pub fn encode_into(&self, room: usize) -> Result<Vec<u8>, EncodeError> {
        let codes = |bits: &[u16]| -> Vec<LsfCode> {
            bits.iter().map(|&bits| LsfCode::from_bits(bits)).collect()
        };
        let codes: Vec<_> = self
            .models
            .iter()
            .map(|(ar, ma, gain)| (codes(ar), codes(ma), *gain))
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
        let anchors: Vec<_> = self
            .anchors
            .iter()
            .map(|(name, mu, weight)| Anchor {
                name,
                mu: *mu,
                weight: *weight,
            })
            .collect();
        let parts = AssetParts {
            name: &self.name,
            grid: GridParts {
                sample_rate_hz: self.grid_rate_hz,
                ar_order: self.models.first().map_or(0, |(ar, ..)| ar.len()),
                ma_order: self.models.first().map_or(0, |(_, ma, _)| ma.len()),
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
                anchors: &anchors,
                law: &self.law,
            },
            coupling: self.coupling,
            contact: self
                .contact
                .as_ref()
                .map(|(numbers, spring)| ContactParts { spring, ..*numbers }),
            direction: self.direction,
            provenance: self.provenance,
            preview_png: self.preview_png.as_deref(),
        };
        let mut bytes = vec![0xaa; room];
        let len = encode(&parts, &mut bytes)?;
        bytes.truncate(len);
        Ok(bytes)
    }

    /// The asset's bytes.
    pub fn encode(&self) -> Vec<u8> {
        self.encode_into(1 << 17).expect("valid parts")
    }
}

/// CRC-32 bit by bit, as `SPEC.md` defines it.
pub fn crc32(bytes: impl IntoIterator<Item = u8>) -> u32 {
    !bytes.into_iter().fold(!0_u32, |crc, byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 * (crc & 1))
        })
    })
}

pub fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

pub fn put(bytes: &mut [u8], at: usize, piece: &[u8]) {
    bytes[at..at + piece.len()].copy_from_slice(piece);
}

/// Offset and length of a section, from the table.
pub fn span(asset: &[u8], section: usize) -> (usize, usize) {
    let len = |s: usize| u32_at(asset, 20 + 12 * s + 4) as usize;
    let table_end = 20 + 12 * usize::from(asset[6]);
    (
        table_end + (0..section).map(len).sum::<usize>(),
        len(section),
    )
}

/// Recomputes every CRC after a change, so that the checks behind them are reached. A section
/// whose stated span exceeds the file keeps its CRC.
pub fn seal(asset: &mut [u8]) {
    for section in 0..usize::from(asset[6]) {
        let (start, len) = span(asset, section);
        if let Some(body) = asset.get(start..start.saturating_add(len)) {
            let crc = crc32(body.iter().copied());
            put(asset, 20 + 12 * section + 8, &crc.to_le_bytes());
        }
    }
    seal_header(asset);
}

/// Recomputes only the CRC of the header.
pub fn seal_header(asset: &mut [u8]) {
    let table_end = 20 + 12 * usize::from(asset[6]);
    let crc = crc32(asset[..16].iter().chain(&asset[20..table_end]).copied());
    put(asset, 16, &crc.to_le_bytes());
}

/// Replaces the body of a section and updates every length and CRC.
pub fn replace_section(asset: &mut Vec<u8>, section: usize, body: &[u8]) {
    let (start, len) = span(asset, section);
    asset.splice(start..start + len, body.iter().copied());
    put(
        asset,
        20 + 12 * section + 4,
        &(body.len() as u32).to_le_bytes(),
    );
    restate(asset);
}

/// Appends an ancillary section.
pub fn append_section(asset: &mut Vec<u8>, tag: &[u8; 4], body: &[u8]) {
    let table_end = 20 + 12 * usize::from(asset[6]);
    let mut entry = tag.to_vec();
    entry.extend((body.len() as u32).to_le_bytes());
    entry.extend([0; 4]);
    asset.splice(table_end..table_end, entry);
    asset.extend(body);
    asset[6] += 1;
    restate(asset);
}

/// Sets total and haptic length to the sums of the table, then recomputes the CRCs.
pub fn restate(asset: &mut [u8]) {
    let end = |sections: usize| {
        let (start, len) = span(asset, sections - 1);
        (start + len) as u32
    };
    let tag = |at: usize| asset.get(20 + 12 * at..20 + 12 * at + 4);
    let contact = usize::from(tag(5) == Some(b"CONT"));
    let axis = usize::from(tag(5 + contact) == Some(b"AXIS"));
    let haptic = end(5 + contact + axis);
    let total = end(usize::from(asset[6]));
    put(asset, 8, &total.to_le_bytes());
    put(asset, 12, &haptic.to_le_bytes());
    seal(asset);
}

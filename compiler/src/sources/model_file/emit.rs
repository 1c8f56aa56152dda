//! From a model to the text of a file.

use super::{
    layout::Shallow,
    schema::{Document, FORMAT, Friction, Grid, Provenance, Taps, Trace, VERSION, Vertex},
};
use asperity_texture::model::{Numerator, TextureModel};
use serde::Serialize as _;

/// The file of a model: JSON with one vertex, triangle and trace a line. Every number reads back
/// to the same bits.
#[must_use]
pub fn to_json(texture: &TextureModel) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut serializer = serde_json::Serializer::with_formatter(&mut bytes, Shallow::default());
    // Structures of numbers, strings and lists always serialise, and memory takes every byte.
    let _ = document(texture).serialize(&mut serializer);
    bytes.push(b'\n');
    bytes
}

fn document(texture: &TextureModel) -> Document {
    let grid = &texture.grid;
    let has_numerator = grid.numerator == Numerator::Lsf;
    let provenance = &texture.provenance;
    Document {
        format: FORMAT.into(),
        version: VERSION,
        name: texture.name.clone(),
        grid: Grid {
            sample_rate_hz: grid.sample_rate_hz,
            numerator: grid.numerator,
            vertices: grid
                .vertices
                .iter()
                .map(|vertex| Vertex {
                    speed_mm_s: vertex.speed_mm_s,
                    force_n: vertex.force_n,
                    kind: vertex.kind,
                    sigma_m_s2: vertex.sigma_m_s2,
                    gain: has_numerator.then_some(vertex.gain),
                    lsf_rad: vertex.lsf_rad.clone(),
                    ma_lsf_rad: vertex.ma_lsf_rad.clone().filter(|_| has_numerator),
                })
                .collect(),
            triangles: Some(grid.triangles.clone()),
        },
        taps: Some(Taps {
            sample_rate_hz: texture.taps.sample_rate_hz,
            traces: texture
                .taps
                .traces
                .iter()
                .map(|trace| Trace {
                    speed_m_s: trace.speed_m_s,
                    accel_m_s2: trace.accel_m_s2.clone(),
                })
                .collect(),
        }),
        friction: Friction {
            mu: texture.friction.mu,
            anchors: texture.friction.anchors.clone(),
            law: texture.friction.law.clone(),
        },
        wall: Some(texture.wall),
        gains: Some(texture.gains),
        provenance: Provenance {
            generator: provenance.generator.clone(),
            source: provenance.source.clone(),
            source_crc32: provenance.source_crc32,
            prompt: provenance.prompt.clone(),
            seed: provenance.seed,
            taps_synthetic: provenance.taps_synthetic,
            notes: provenance.notes.clone(),
        },
    }
}

//! From a model to the text of a file.

use super::{
    layout::Shallow,
    schema::{Document, FORMAT, Grid, Provenance, VERSION},
};
use asperity_texture::model::TextureModel;
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
    let provenance = &texture.provenance;
    Document {
        format: FORMAT.into(),
        version: VERSION,
        name: texture.name.clone(),
        grid: Grid {
            sample_rate_hz: grid.sample_rate_hz,
            numerator: grid.numerator,
            vertices: grid.vertices.clone(),
            triangles: Some(grid.triangles.clone()),
        },
        taps: Some(texture.taps.clone()),
        friction: texture.friction.clone(),
        wall: Some(texture.wall),
        contact: texture.contact.clone(),
        direction: texture.direction,
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

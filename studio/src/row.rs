//! The gallery's columns: the figures of every texture of a library.

use asperity::{
    emit::raise::raise,
    learned::Certainty,
    model::attributes::{Attributes, Meter},
    sources::latents::remembered,
};
use asperity_formats::Asset;
use serde::Serialize;

/// The figures of a texture.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TextureSummary {
    /// The name in the index of its library.
    pub(crate) name: String,
    prompt: Option<String>,
    attributes: Attributes,
    /// Bytes of the asset.
    bytes: usize,
    certainty: Option<Certainty>,
}

/// All of them: a list for each figure.
#[derive(Serialize)]
struct Columns<'a> {
    id: &'a str,
    name: &'a str,
    /// Identifier of each texture, where known: `api/texture/ID.png` is then its picture.
    textures: Option<&'a [String]>,
    names: Vec<&'a str>,
    prompts: Vec<Option<&'a str>>,
    rough_db: Vec<Option<f64>>,
    sharp_hz: Vec<Option<f64>>,
    hard_hz: Vec<Option<f64>>,
    mu: Vec<f64>,
    bytes: Vec<usize>,
    certainty: Vec<Option<Certainty>>,
}

impl TextureSummary {
    /// Measures the figures of an asset.
    pub(crate) fn of(meter: &mut Meter, name: &str, asset: &Asset<'_>) -> Self {
        let memory = remembered(asset).ok().flatten();
        Self {
            name: name.to_owned(),
            prompt: asset.provenance().and_then(|p| p.prompt).map(str::to_owned),
            attributes: meter.of(&raise(asset)),
            bytes: asset.total_len(),
            certainty: memory.and_then(|memory| memory.history.certainty),
        }
    }
}

/// The columns of a library, JSON.
pub(crate) fn columns(
    id: &str,
    name: &str,
    rows: &[TextureSummary],
    ids: Option<&[String]>,
) -> Vec<u8> {
    let columns = Columns {
        id,
        name,
        textures: ids,
        names: rows.iter().map(|row| &*row.name).collect(),
        prompts: rows.iter().map(|row| row.prompt.as_deref()).collect(),
        rough_db: rows.iter().map(|row| row.attributes.rough_db).collect(),
        sharp_hz: rows.iter().map(|row| row.attributes.sharp_hz).collect(),
        hard_hz: rows.iter().map(|row| row.attributes.hard_hz).collect(),
        mu: rows.iter().map(|row| row.attributes.mu).collect(),
        bytes: rows.iter().map(|row| row.bytes).collect(),
        certainty: rows.iter().map(|row| row.certainty).collect(),
    };
    // Plain structures of numbers and strings always serialise.
    serde_json::to_vec(&columns).unwrap_or_default()
}

//! The direction of a latent, from its neighbours, as friction has it.

use super::{contact, description::ModelDescription, friction};
use asperity_model::DIRECTIONS;
use asperity_texture::model::{Bearing, Direction};
use serde::Deserialize;
use std::{collections::BTreeMap, sync::LazyLock};

/// Part of its neighbours, by weight, that has a direction where a latent has one.
const MOST: f64 = 0.5;
/// The same where a prompt says how it is stroked.
const LEAST: f64 = 0.25;
/// μ against a nap over that with it from which there is one.
const LEANS: f64 = 1.05;
/// A difference of the level, dB, and of a ratio that nobody feels.
const UNFELT: (f64, f64) = (0.5, 0.03);

/// The direction of strokes that a prompt says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stroke {
    /// Its bearing.
    pub bearing: Bearing,
    /// A material with what the prompt says lies along the axis; `None` where it says only "lengthwise".
    pub like: Option<&'static str>,
}

/// The table, which decides textures as the model does.
pub static TABLE: &str = DIRECTIONS;

/// A material whose relief or friction depends on the direction of a stroke.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Material {
    name: String,
    direction: Direction,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    material: Vec<Material>,
}

/// Directions by the names of materials; a test reads them all.
static MATERIALS: LazyLock<BTreeMap<String, Direction>> = LazyLock::new(|| {
    let table: Option<Table> = toml::from_str(DIRECTIONS).ok();
    let materials = table.into_iter().flat_map(|table| table.material);
    let entry = |material: Material| (material.name, material.direction);
    materials.map(entry).collect()
});

/// Names of the materials that have a direction.
pub fn materials() -> impl Iterator<Item = &'static str> {
    MATERIALS.keys().map(String::as_str)
}

/// The direction at a latent; `None` where its close neighbours that have one are not most of all by weight, and where nobody
/// would feel it.
#[must_use]
pub fn at(z: &[f32], description: &ModelDescription) -> Option<Direction> {
    let shares = shares(z, description, contact::CLOSE);
    let weight: f64 = shares.iter().map(|(weight, _)| weight).sum();
    let mixed = Direction::mixed(shares.into_iter());
    Some(mixed).filter(|direction| weight > MOST && is_felt(direction))
}

/// The direction of a latent whose prompt says how it is stroked: that of the neighbours that have one, if they weigh
/// something and have a nap where it says so, or else that of a material with what the prompt says lies along its axis.
#[must_use]
pub fn said(z: &[f32], description: &ModelDescription, stroke: &Stroke) -> Option<Direction> {
    let shares = shares(z, description, -1.0);
    let weight: f64 = shares.iter().map(|(weight, _)| weight).sum();
    let shares = (shares.into_iter()).map(|(share, direction)| (share / weight, direction));
    let found = Some(Direction::mixed(shares)).filter(|direction| {
        let leans = direction.mu_backward > LEANS * direction.mu_forward;
        let asked = matches!(stroke.bearing, Bearing::With | Bearing::Against);
        weight > LEAST && is_felt(direction) && (leans || !asked)
    });
    found.or_else(|| MATERIALS.get(stroke.like?).copied())
}

/// The neighbours from a cosine on that have a direction, and their weights among all.
fn shares(
    z: &[f32],
    description: &ModelDescription,
    cosine: f64,
) -> Vec<(f64, &'static Direction)> {
    let shares = contact::shares(z, description);
    let close = (shares.iter()).filter(|(_, anchor)| friction::cosine(z, &anchor.z) >= cosine);
    let directed =
        close.filter_map(|(weight, anchor)| Some((*weight, MATERIALS.get(&anchor.name)?)));
    directed.collect()
}

fn is_felt(direction: &Direction) -> bool {
    let [power, rest @ ..] = direction.ratios();
    let level_db = 10.0 * libm::log10(power.max(f64::MIN_POSITIVE));
    level_db.abs() > UNFELT.0 || rest.iter().any(|ratio| (ratio - 1.0).abs() > UNFELT.1)
}

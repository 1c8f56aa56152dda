//! The table of contact laws, by the names of the materials.

use asperity_model::CONTACT_LAWS;
use asperity_texture::model::ContactLaw;
use serde::Deserialize;
use std::{collections::BTreeMap, sync::LazyLock};

/// A material that gives way.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Its name, as the model has it; a few are known by name alone.
    pub name: String,
    /// What else gives way like it, of which the model knows nothing.
    #[serde(default)]
    pub names: Vec<String>,
    /// Its contact law.
    pub law: ContactLaw,
    /// Coefficient of friction in the place of the model's, where a film carries the load.
    #[serde(default)]
    pub mu: Option<f64>,
    /// The source of each part, or that it is an estimate.
    pub from: BTreeMap<String, String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    material: Vec<Material>,
}

/// Every material that gives way; a test reads them all.
pub fn materials() -> impl Iterator<Item = &'static Material> {
    TABLE.values()
}

/// The material of a name, if it gives way.
pub(super) fn material(name: &str) -> Option<&'static Material> {
    TABLE.get(name)
}

static TABLE: LazyLock<BTreeMap<String, Material>> = LazyLock::new(|| {
    let table: Option<Table> = toml::from_str(CONTACT_LAWS).ok();
    let materials = table.into_iter().flat_map(|table| table.material);
    materials
        .map(|material| (material.name.clone(), material))
        .collect()
});

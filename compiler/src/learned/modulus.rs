//! The modulus of a texture, from the materials that its friction comes from.

use asperity_texture::model::FrictionAnchor;
use std::{collections::BTreeMap, sync::LazyLock};

/// The table, which decides textures as the model does.
pub static TABLE: &str = asperity_model::MODULI;

/// ln of the moduli, MPa, by the names of materials.
static MODULI: LazyLock<BTreeMap<&'static str, f64>> = LazyLock::new(|| {
    let entry = |line: &'static str| {
        let (name, modulus) = line.split_once('\t')?;
        Some((name, libm::log(modulus.parse().ok()?)))
    };
    TABLE.lines().filter_map(entry).collect()
});

/// The effective indentation modulus of these anchors, MPa: their geometric mean; `None` where none is known.
#[must_use]
pub fn of(anchors: &[FrictionAnchor]) -> Option<f64> {
    let known = anchors.iter().filter_map(|anchor| {
        let modulus = MODULI.get(anchor.name.as_str())?;
        Some((anchor.weight, anchor.weight * modulus))
    });
    let (weight, sum) = known.fold((0.0, 0.0), |sum, (w, m)| (sum.0 + w, sum.1 + m));
    (weight > 0.0).then(|| libm::exp(sum / weight))
}

//! Textures to touch: the built-in one and materials of the learned model.

use super::error::ImportAccuracyError;
use asperity::{
    learned::{LearnedModel, embedded, inference::Backend, texture::build},
    model::{Provenance, TextureModel},
    sources::builtin,
};

/// The built-in texture, followed by at most `count` materials that the embedded model was trained on, as
/// it decodes them, evenly over its list.
///
/// # Errors
/// [`ImportAccuracyError::Import`] if the embedded model cannot be loaded or does not decode a material.
pub fn materials(count: usize) -> Result<Vec<TextureModel>, ImportAccuracyError> {
    let model = LearnedModel::load(embedded::model(), &Backend::Portable)?;
    let anchors = &model.description().anchors;
    let every = (anchors.len() / count.max(1)).max(1);
    let mut textures = vec![builtin::texture()];
    for anchor in anchors.iter().step_by(every).take(count) {
        let Ok(z) = anchor.z.clone().try_into() else {
            continue;
        };
        let decoded = model.decode(&z)?;
        let (texture, _) = build(
            model.description(),
            &decoded,
            &z,
            anchor.name.clone(),
            Provenance::default(),
        );
        textures.push(texture);
    }
    Ok(textures)
}

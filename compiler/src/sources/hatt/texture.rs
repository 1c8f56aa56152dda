//! A material as a texture: what HaTT lacks is synthesised or set to a default.

use super::material::Material;
use asperity_texture::model::{
    Friction, FrictionAnchor, GridVertex, ModelGrid, Numerator, Provenance, TextureModel,
    VertexKind, defaults, tap_synthesis,
};

const NOTES: &str = "Taps are synthetic: impacts whose contact time follows the \
    spectra. Wall, gains and masses are unconfirmed defaults.";

/// The texture of a material; `source` is the name of its file.
#[must_use]
pub fn to_model(material: &Material, source: &str, source_crc32: u32) -> TextureModel {
    let has_numerator = material.models.iter().any(|m| !m.ma.lsf_rad.is_empty());
    let vertices = material
        .models
        .iter()
        .map(|model| {
            let on_border = |value: f64, border: f64| value == 0.0 || value == border;
            let is_edge = on_border(model.speed_mm_s, material.max_speed_mm_s)
                || on_border(model.force_n, material.max_force_n);
            let sigma = model.variance.sqrt();
            GridVertex {
                speed_mm_s: model.speed_mm_s,
                force_n: model.force_n,
                kind: if is_edge {
                    VertexKind::Edge
                } else {
                    VertexKind::Interior
                },
                lsf_rad: model.ar.lsf_rad.clone(),
                ma_lsf_rad: has_numerator.then(|| model.ma.lsf_rad.clone()),
                // Without a numerator there is no gain: the level is all in σ.
                gain: if has_numerator { model.gain } else { 1.0 },
                sigma_m_s2: if has_numerator {
                    sigma
                } else {
                    sigma * model.gain
                },
            }
        })
        .collect();
    let grid = ModelGrid {
        sample_rate_hz: material.sample_rate_hz,
        order: material.models.first().map_or(0, |m| m.ar.lsf_rad.len()),
        numerator: if has_numerator {
            Numerator::Lsf
        } else {
            Numerator::None
        },
        vertices,
        triangles: material.triangles.clone(),
    };
    let gains = defaults::gains();
    TextureModel {
        name: material.name.clone(),
        taps: tap_synthesis::bank(tap_synthesis::frequency_hz(&grid), &gains),
        grid,
        friction: Friction {
            mu: material.mu,
            anchors: vec![FrictionAnchor {
                name: material.name.clone(),
                mu: material.mu,
                weight: 1.0,
            }],
            law: None,
        },
        wall: defaults::wall(),
        contact: None,
        direction: None,
        gains,
        provenance: Provenance {
            generator: format!("asperity {} import hatt", env!("CARGO_PKG_VERSION")),
            source: source.to_owned(),
            source_crc32,
            prompt: None,
            seed: 0,
            fidelity: "full".into(),
            taps_synthetic: true,
            lsf_error_db: 0.0,
            notes: NOTES.into(),
        },
    }
}

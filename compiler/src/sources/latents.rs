//! Latents as a source: a blend, a composition, an edit, a recording that was encoded.

use super::{Source, Sourced, Tools};
use crate::{
    driver::Failure,
    edit::{History, Latents, Memory},
    learned::{Decoded, LearnedModel, ModelError, friction, texture},
    model::{FrictionLaw, Provenance, TextureModel},
    pipeline::{Pass, Pipeline, Request, Ringing},
    prompt::phrase::adjust::adjust,
};

/// A texture that is decoded from latents.
#[derive(Debug, Clone)]
pub struct FromLatents {
    /// The latents.
    pub latents: Latents,
    /// Name of the texture.
    pub name: String,
    /// Where it comes from.
    pub provenance: Provenance,
    /// How it was made and edited.
    pub history: History,
    /// How friction depends on speed, of which latents say nothing: its factors multiply what they
    /// say of μ.
    pub law: Option<FrictionLaw>,
    /// Certainty of the prompt that it began with, 0..=1.
    pub certainty: Option<f64>,
    /// What a user should be told.
    pub warnings: Vec<String>,
}

impl FromLatents {
    /// Latents of which nothing else is known.
    #[must_use]
    pub fn new(latents: Latents, name: String, provenance: Provenance, history: History) -> Self {
        Self {
            latents,
            name,
            provenance,
            history,
            law: None,
            certainty: None,
            warnings: Vec::new(),
        }
    }
}

impl Source for FromLatents {
    fn read(
        &self,
        _: &Request,
        tools: &Tools<'_>,
        pipeline: &mut Pipeline,
    ) -> Result<Sourced, Failure> {
        let model = tools.model()?;
        let mut texture = pipeline.run(Pass::Decode, || {
            decode(model, &self.latents, &self.name, self.provenance.clone())
        })?;
        let mu = texture.friction.mu;
        texture.friction.law = self.law.clone().map(|law| law.beside(mu));
        Ok(Sourced {
            ringing: Ringing::Stabilised,
            memory: Some(Memory {
                model_crc32: model.crc32(),
                latents: self.latents,
                history: self.history.clone(),
            }),
            certainty: self.certainty,
            warnings: self.warnings.clone(),
            ..Sourced::new(texture)
        })
    }
}

/// The texture of these latents before it is reduced.
///
/// # Errors
/// [`ModelError`] when a network fails.
pub fn decode(
    model: &LearnedModel,
    latents: &Latents,
    name: &str,
    provenance: Provenance,
) -> Result<TextureModel, ModelError> {
    let description = model.description();
    let mut decoded = model.decode(&latents.slide)?;
    if latents.tap != latents.slide {
        let Decoded { taps_m_s2, .. } = model.decode(&latents.tap)?;
        decoded.taps_m_s2 = taps_m_s2;
    }
    let name = name.to_owned();
    let (mut texture, _) =
        texture::build(description, &decoded, &latents.friction, name, provenance);
    if latents.tap != latents.friction {
        let near = friction::neighbours(&latents.tap, &description.anchors, description.friction);
        texture.wall.stiffness_n_m = friction::stiffness_n_m(&near, &description.anchors);
    }
    adjust(&mut texture, &latents.shift);
    Ok(texture)
}

//! Where a prompt lies in the latent, and how far its grammar moves the texture from there.

use super::{
    Projection, PromptCompiler, PromptError,
    named_things::Thing,
    phrase::{self, Phrase},
};
use crate::learned::{Decoded, Latent, texture};
use asperity_texture::model::{
    Provenance, TextureModel,
    attributes::{self, Attributes},
    shift::{self, Scales, Shift, adjust},
};
use std::sync::Arc;

/// What a prompt means.
#[derive(Debug, Clone, PartialEq)]
pub struct Meaning {
    /// Its latent.
    pub z: Latent,
    /// How far attributes move from what the latent decodes to.
    pub shift: Shift,
    /// What the latent decodes to.
    pub decoded: Arc<Decoded>,
}

impl PromptCompiler {
    /// The meaning of a prompt that was [projected](PromptCompiler::project).
    ///
    /// The words say how rough, slippery and hard a thing is, and the latent says all the rest: the
    /// decoded texture is moved to the attributes of the words. Grammar moves these.
    ///
    /// # Errors
    /// [`PromptError`] for a failing network.
    pub fn meaning(&self, projection: &Projection) -> Result<Meaning, PromptError> {
        let (z, wanted) = self.resolve_target(projection)?;
        self.decode_target(z, wanted)
    }

    /// The latent of a prompt, and the attributes that its words ask for.
    pub(super) fn resolve_target(
        &self,
        projection: &Projection,
    ) -> Result<(Latent, Option<Scales>), PromptError> {
        let phrase = phrase::parse(&projection.reading.words);
        Ok(match phrase {
            Phrase::Plain => (projection.z, projection.felt),
            Phrase::Changed { base, changes } => {
                let base = self.thing(&base)?;
                let said = self.wanted(projection)?;
                let wanted = phrase::changed(&base.wanted, &said, &changes);
                (projection.z, Some(wanted))
            }
            Phrase::Between(first, second) => {
                let (first, second) = (self.thing(&first)?, self.thing(&second)?);
                let z = std::array::from_fn(|k| 0.5 * (first.z[k] + second.z[k]));
                (z, Some(shift::middle(&first.wanted, &second.wanted)))
            }
            Phrase::Covered { inside, cover } => {
                let (inside, cover) = (self.thing(&inside)?, self.thing(&cover)?);
                let [rough, slippery, _] = cover.wanted;
                let [_, _, hard] = shift::middle(&inside.wanted, &cover.wanted);
                (cover.z, Some([rough, slippery, hard]))
            }
        })
    }

    /// What a latent decodes to, and the way from there to what is wanted.
    pub(super) fn decode_target(
        &self,
        z: Latent,
        wanted: Option<Scales>,
    ) -> Result<Meaning, PromptError> {
        let decoded = self.decoded(&z)?;
        let shift = wanted.map_or_else(Shift::default, |wanted| {
            shift::to(&wanted, &self.attributes(&z, &decoded))
        });
        Ok(Meaning { z, shift, decoded })
    }

    /// The decoder's texture of a prompt: neither varied nor reduced.
    ///
    /// # Errors
    /// [`PromptError`] for an empty prompt or a failing network.
    pub fn texture(&self, prompt: &str) -> Result<TextureModel, PromptError> {
        let Meaning { z, shift, decoded } = self.meaning(&self.project(prompt)?)?;
        let mut texture = self.plain(&z, &decoded);
        adjust(&mut texture, &shift);
        Ok(texture)
    }

    /// A thing that a phrase names. Prompts of a library have few of them.
    fn thing(&self, text: &str) -> Result<Thing, PromptError> {
        if let Some(known) = self.things.get(text) {
            return Ok(known);
        }
        let projection = self.project(text)?;
        let found = Thing {
            z: projection.z,
            wanted: self.wanted(&projection)?,
        };
        self.things.keep(text, found);
        Ok(found)
    }

    /// The attributes that words ask for, or those of the decoded texture where the model does not
    /// say.
    fn wanted(&self, projection: &Projection) -> Result<Scales, PromptError> {
        if let Some(felt) = projection.felt {
            return Ok(felt);
        }
        let decoded = self.decoded(&projection.z)?;
        Ok(shift::scales(&self.attributes(&projection.z, &decoded)))
    }

    fn attributes(&self, z: &Latent, decoded: &Decoded) -> Attributes {
        attributes::of(&self.plain(z, decoded))
    }

    fn plain(&self, z: &Latent, decoded: &Decoded) -> TextureModel {
        let (name, provenance) = (String::new(), Provenance::default());
        texture::build(self.model().description(), decoded, z, name, provenance).0
    }
}

//! Where a prompt lies in the latent, and how far its grammar moves the texture from there.

use super::{
    Projection, PromptCompiler, PromptError,
    named_things::{Referent, Things},
    phrase::Phrase,
    reading::Reading,
};
use crate::learned::{Decoded, Latent, contact, description::ModelDescription, direction, texture};
use asperity_texture::model::{
    Direction, Provenance, TextureModel,
    attributes::{self, Attributes},
    shift::{self, Scales, Shift, adjust},
};
use std::sync::Arc;

/// Meaning of a prompt.
#[derive(Debug, Clone, PartialEq)]
pub struct Meaning {
    /// Its latent.
    pub z: Latent,
    /// Shift of the attributes from those of the decoded latent.
    pub shift: Shift,
    /// The decoded latent.
    pub decoded: Arc<Decoded>,
}

impl PromptCompiler {
    /// The meaning of a prompt that was [projected](PromptCompiler::project).
    ///
    /// The words determine how rough, slippery and hard a material is, and the latent everything else:
    /// the decoded texture is moved to the attributes of the words. Grammar moves these.
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
        let plain = || {
            let (z, felt) = (projection.z, projection.felt);
            let ([name], Some(wanted)) = (&projection.reading.words[..], felt) else {
                return Ok((z, felt));
            };
            let thing = self.as_thing(z, Some(wanted), false)?;
            let wood = self.wood(name, thing)?;
            Ok(wood.map_or((z, felt), |wood| (wood.z, Some(wood.wanted))))
        };
        let (z, wanted) = match &projection.reading.phrase {
            Phrase::Plain => return plain(),
            Phrase::Changed { base, changes } => {
                let base = self.thing(base)?;
                // The vector of a composed thing says little of it, and less of its changes.
                let (z, said) = if base.composed {
                    (base.z, base.wanted)
                } else {
                    (projection.z, self.wanted(projection)?)
                };
                (z, super::changed(&base.wanted, &said, changes))
            }
            Phrase::Graded { base, grades } => {
                let graded = self.graded(base, grades)?;
                (graded.z, graded.wanted)
            }
            Phrase::Part { name, .. } if self.own_latent(name).is_some() => return plain(),
            Phrase::Part { part, .. } => (self.thing(part)?.z, self.wanted(projection)?),
            Phrase::Between(first, second) => {
                let (first, second) = (self.thing(first)?, self.thing(second)?);
                let z = std::array::from_fn(|k| 0.5 * (first.z[k] + second.z[k]));
                (z, shift::middle(&first.wanted, &second.wanted))
            }
            // What is outside is stroked, and both yield.
            Phrase::Covered {
                inside,
                cover: outside,
            }
            | Phrase::Made {
                object: inside,
                material: outside,
            } => {
                let (inside, outside) = (self.thing(inside)?, self.thing(outside)?);
                let [rough, slippery, _] = outside.wanted;
                let [_, _, hard] = shift::middle(&inside.wanted, &outside.wanted);
                (outside.z, [rough, slippery, hard])
            }
        };
        Ok((z, Some(wanted)))
    }

    /// Decodes a latent, and computes the shift from there to the wanted attributes.
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
        let projection = self.project(prompt)?;
        let Meaning { z, shift, decoded } = self.meaning(&projection)?;
        let mut texture = self.plain(&z, &decoded);
        adjust(&mut texture, &shift);
        let law = self.contact_law(&projection, &z)?;
        contact::give(&mut texture, law, &z, self.model().description());
        self.slide_between(&mut texture, &projection.reading)?;
        Ok(self.directed(texture, &projection, &z)?.0)
    }

    /// A texture with the direction of its material, or as strokes of the bearing of its prompt feel it. Gives the direction,
    /// too.
    pub(super) fn directed(
        &self,
        mut texture: TextureModel,
        projection: &Projection,
        z: &Latent,
    ) -> Result<(TextureModel, Option<Direction>), PromptError> {
        let z = self.latent_of_material(projection, z)?;
        let description = self.model().description();
        let Some(stroke) = projection.stroke else {
            texture.direction = direction::at(&z, description);
            let found = texture.direction;
            return Ok((texture, found));
        };
        texture.direction = direction::said(&z, description, &stroke);
        let found = texture.direction;
        Ok((texture.stroked(stroke.bearing), found))
    }

    /// Puts μ between those of two things, of which films may carry the load.
    pub(super) fn slide_between(
        &self,
        texture: &mut TextureModel,
        reading: &Reading,
    ) -> Result<(), PromptError> {
        if let Phrase::Between(first, second) = &reading.phrase
            && texture.contact.is_some()
        {
            let mu = |thing| self.texture(thing).map(|texture| texture.friction.mu);
            texture.friction.mu = (mu(first)? * mu(second)?).sqrt();
        }
        Ok(())
    }

    /// The contact law of a prompt at this latent: that of the material without its changes, as its words move it. Every
    /// piece of a material gives way alike, so no seed moves it.
    pub(super) fn contact_law(
        &self,
        projection: &Projection,
        z: &Latent,
    ) -> Result<Option<contact::Choice>, PromptError> {
        let z = self.latent_of_material(projection, z)?;
        Ok(contact_law(
            &z,
            self.model().description(),
            &projection.reading,
        ))
    }

    /// The latent of what a prompt at this latent is about, without its changes.
    fn latent_of_material(
        &self,
        projection: &Projection,
        z: &Latent,
    ) -> Result<Latent, PromptError> {
        Ok(match &projection.reading.phrase {
            // The vector of "sticky honey" lies towards tape, and what its words move is moved by them.
            Phrase::Changed { base, .. } | Phrase::Graded { base, .. } => self.thing(base)?.z,
            _ => *z,
        })
    }

    /// The material that a text names; the text may be a phrase itself. Prompts of a library name few of them.
    pub(super) fn thing(&self, text: &str) -> Result<Referent, PromptError> {
        kept(&self.things, text, || {
            let projection = self.projected(text, self.read_surface(text))?;
            let composed = projection.reading.phrase != Phrase::Plain;
            let (z, wanted) = self.resolve_target(&projection)?;
            self.as_thing(z, wanted, composed)
        })
    }

    /// A material by the name under which the model knows it; the name is not parsed.
    pub(super) fn named_thing(&self, name: &str) -> Result<Referent, PromptError> {
        kept(&self.known, name, || {
            let (_, projected) = &*self.encode(name)?;
            let felt = projected.felt.map(|felt| felt.map(|x| Some(x.into())));
            self.as_thing(self.own_latent(name).unwrap_or(projected.z), felt, false)
        })
    }

    fn as_thing(
        &self,
        z: Latent,
        wanted: Option<Scales>,
        composed: bool,
    ) -> Result<Referent, PromptError> {
        Ok(Referent {
            z,
            wanted: self.or_decoded(&z, wanted)?,
            composed,
        })
    }

    /// The attributes that words ask for, or those of the decoded texture where the model does not
    /// say.
    fn wanted(&self, projection: &Projection) -> Result<Scales, PromptError> {
        self.or_decoded(&projection.z, projection.felt)
    }

    fn or_decoded(&self, z: &Latent, wanted: Option<Scales>) -> Result<Scales, PromptError> {
        if let Some(wanted) = wanted {
            return Ok(wanted);
        }
        let decoded = self.decoded(z)?;
        Ok(shift::scales(&self.attributes(z, &decoded)))
    }

    fn attributes(&self, z: &Latent, decoded: &Decoded) -> Attributes {
        attributes::of(&self.plain(z, decoded))
    }

    fn plain(&self, z: &Latent, decoded: &Decoded) -> TextureModel {
        let (name, provenance) = (String::new(), Provenance::default());
        texture::build(self.model().description(), decoded, z, name, provenance).0
    }
}

/// The contact law at a latent, as the words of a prompt name and move it.
pub(crate) fn contact_law(
    z: &Latent,
    description: &ModelDescription,
    reading: &Reading,
) -> Option<contact::Choice> {
    let text = match &reading.phrase {
        Phrase::Plain | Phrase::Changed { .. } | Phrase::Graded { .. } => reading.words.join(" "),
        // What is made of, covered or between things is none of them.
        _ => String::new(),
    };
    contact::of(z, description, &text, reading)
}

fn kept(
    things: &Things,
    text: &str,
    thing: impl FnOnce() -> Result<Referent, PromptError>,
) -> Result<Referent, PromptError> {
    if let Some(known) = things.get(text) {
        return Ok(known);
    }
    let found = thing()?;
    things.keep(text, found);
    Ok(found)
}

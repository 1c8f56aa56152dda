//! Where a prompt lies in the latent, and how far its grammar moves the texture from there.

use super::{
    Author, PromptError,
    phrase::{
        self, Phrase,
        adjust::{self, Shift},
    },
};
use crate::{
    front_ends::learned::{Latent, texture},
    model::{
        Provenance, TextureModel,
        attributes::{self, Attributes},
    },
};

/// What a prompt means.
#[derive(Debug, Clone, PartialEq)]
pub struct Meaning {
    /// Its latent.
    pub z: Latent,
    /// How far attributes move from what the latent decodes to.
    pub shift: Shift,
}

impl Author {
    /// The meaning of a prompt whose text vector lies at `z`.
    ///
    /// # Errors
    /// [`PromptError`] for a failing network.
    pub fn meaning(&self, prompt: &str, z: Latent) -> Result<Meaning, PromptError> {
        let plain = Meaning {
            z,
            shift: Shift::default(),
        };
        if self.names_a_material(prompt) {
            return Ok(plain);
        }
        match phrase::parse(prompt) {
            Phrase::Plain => Ok(plain),
            Phrase::Changed { base, changes } => {
                let (_, base) = self.thing(&base)?;
                let shift = adjust::from_base(&base, &self.attributes(&z)?, &changes);
                Ok(Meaning { z, shift })
            }
            Phrase::Between(first, second) => {
                let ((first, at_first), (second, at_second)) =
                    (self.thing(&first)?, self.thing(&second)?);
                let z = std::array::from_fn(|k| 0.5 * (first[k] + second[k]));
                let shift = adjust::to_middle(&at_first, &at_second, &self.attributes(&z)?);
                Ok(Meaning { z, shift })
            }
            Phrase::Covered { inside, cover } => {
                let (_, inside) = self.thing(&inside)?;
                let (z, cover) = self.thing(&cover)?;
                let shift = Shift {
                    hard: adjust::to_middle(&inside, &cover, &cover).hard,
                    ..Shift::default()
                };
                Ok(Meaning { z, shift })
            }
        }
    }

    /// The decoder's texture of a prompt: neither varied nor reduced.
    ///
    /// # Errors
    /// [`PromptError`] for an empty prompt or a failing network.
    pub fn texture(&self, prompt: &str) -> Result<TextureModel, PromptError> {
        let prompt = prompt.trim();
        let meaning = self.meaning(prompt, self.project(prompt)?.z)?;
        let mut texture = self.plain(&meaning.z)?;
        adjust::adjust(&mut texture, &meaning.shift);
        Ok(texture)
    }

    /// Whether a prompt is the name of a material: it then has no grammar.
    fn names_a_material(&self, prompt: &str) -> bool {
        let bare = |text: &str| {
            let text = text.trim().to_lowercase();
            let article = ["a ", "an ", "the "].iter();
            let without = article
                .filter_map(|article| text.strip_prefix(article))
                .next();
            without.unwrap_or(&text).to_owned()
        };
        let prompt = bare(prompt);
        let anchors = &self.model().description().anchors;
        anchors.iter().any(|anchor| bare(&anchor.name) == prompt)
    }

    /// Latent and attributes of a thing that a phrase names. Prompts of a library have few of them.
    fn thing(&self, text: &str) -> Result<(Latent, Attributes), PromptError> {
        if let Some(known) = self.things.get(text) {
            return Ok(known);
        }
        let z = self.project(text)?.z;
        let found = (z, self.attributes(&z)?);
        self.things.keep(text, found);
        Ok(found)
    }

    fn attributes(&self, z: &Latent) -> Result<Attributes, PromptError> {
        Ok(attributes::of(&self.plain(z)?))
    }

    fn plain(&self, z: &Latent) -> Result<TextureModel, PromptError> {
        let description = self.model().description();
        let decoded = self.model().decode(z)?;
        let (name, provenance) = (String::new(), Provenance::default());
        Ok(texture::build(description, &decoded, z, name, provenance).0)
    }
}

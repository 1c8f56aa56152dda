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
                let base = self.attributes(&self.project(&base)?.z)?;
                let shift = adjust::from_base(&base, &self.attributes(&z)?, &changes);
                Ok(Meaning { z, shift })
            }
            Phrase::Between(first, second) => {
                let (first, second) = (self.project(&first)?.z, self.project(&second)?.z);
                let z = std::array::from_fn(|k| 0.5 * (first[k] + second[k]));
                let ends = (self.attributes(&first)?, self.attributes(&second)?);
                let shift = adjust::to_middle(&ends.0, &ends.1, &self.attributes(&z)?);
                Ok(Meaning { z, shift })
            }
            Phrase::Covered { inside, cover } => {
                let (inside, z) = (self.project(&inside)?.z, self.project(&cover)?.z);
                let (inside, cover) = (self.attributes(&inside)?, self.attributes(&z)?);
                let [_, _, hard] = adjust::to_middle(&inside, &cover, &cover).0;
                let shift = Shift([None, None, hard]);
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

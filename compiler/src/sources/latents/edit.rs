//! Edits, along the sliders or in words: "less gritty, more waxy".

use super::{
    attribute_cache::AttributeCache, fault::not_understood, latent_editor::LatentEditor,
    scale::Scale,
};
use crate::{
    edit_memory::{Axis, Latents, Sliders},
    pipeline::Request,
    sources::prompt::{
        from_base,
        phrase::{Towards, relative},
    },
};
use asperity_io::diagnostic::Fault;
use asperity_texture::model::{attributes::Attributes, shift::Shift};
use serde::{Deserialize, Serialize};

/// An edit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Edit {
    /// Along the sliders.
    Steps(Sliders),
    /// In words.
    Words(String),
}

impl Default for Edit {
    fn default() -> Self {
        Self::Steps(Sliders::default())
    }
}

impl Edit {
    /// Returns true if nothing is moved.
    #[must_use]
    pub fn is_still(&self) -> bool {
        matches!(self, Self::Steps(sliders) if sliders.are_still())
    }
}

/// Result of an edit.
#[derive(Debug, Clone, PartialEq)]
pub struct EditResult {
    /// The latents after it.
    pub latents: Latents,
    /// The steps that its words ask for, after the blend towards a material.
    pub sliders: Sliders,
    /// The material that it was blended towards.
    pub towards: Option<Towards>,
    /// Words that were not understood.
    pub unread: Vec<String>,
}

impl EditResult {
    /// An edit that leaves the latents where they are.
    pub(super) fn still(latents: &Latents) -> Self {
        Self {
            latents: *latents,
            sliders: Sliders::default(),
            towards: None,
            unread: Vec::new(),
        }
    }
}

impl LatentEditor<'_> {
    /// Applies an edit to a texture.
    ///
    /// # Errors
    /// As [`edited`](Self::edited) and [`worded`](Self::worded).
    pub fn edit(
        &self,
        latents: &Latents,
        edit: &Edit,
        request: &Request,
    ) -> Result<EditResult, Fault> {
        match edit {
            Edit::Steps(sliders) => Ok(EditResult {
                latents: self.edited(latents, sliders, request)?,
                sliders: *sliders,
                ..EditResult::still(latents)
            }),
            Edit::Words(text) => self.worded(latents, text, request),
        }
    }

    /// The latents after an edit in words. A likeness ("more like leather") is a blend with the
    /// texture of its words; every other change moves an attribute from its present value as far as
    /// the grammar of `compile` would move it from that of a material.
    ///
    /// # Errors
    /// A usage error where the words ask for nothing; else as
    /// [`edited`](Self::edited).
    pub fn worded(
        &self,
        latents: &Latents,
        text: &str,
        request: &Request,
    ) -> Result<EditResult, Fault> {
        let asked = relative(text);
        if asked.is_nothing() {
            return Err(not_understood(format_args!("the edit {text:?}")).usage());
        }
        let cache = AttributeCache::new(self.prompt_compiler, request);
        let base = cache.kept(latents)?;
        let mut start = *latents;
        if let Some(towards) = &asked.towards {
            let projection = self.prompt_compiler.project(&towards.thing)?;
            let meaning = self.prompt_compiler.meaning(&projection)?;
            let thing = Latents::whole(meaning.z).shifted(meaning.shift);
            start = Latents::between(latents, &thing, towards.share);
        }
        let now = cache.kept(&start)?;
        let shift = from_base(&base, &now, &asked.changes);
        let sliders = steps(&self.scale, &now, &shift);
        Ok(EditResult {
            latents: self.searched(&start, &sliders, &cache)?,
            sliders,
            towards: asked.towards,
            unread: asked.unread,
        })
    }
}

/// The steps of the sliders that a shift moves attributes by from where they are.
fn steps(scale: &Scale, from: &Attributes, shift: &Shift) -> Sliders {
    let to = Attributes {
        rough_db: from.rough_db.map(|db| db + shift.rough_db),
        mu: from.mu * libm::exp(-shift.slippery),
        hard_hz: from.hard_hz.map(|hz| hz * libm::exp(shift.hard)),
        ..*from
    };
    let by = |axis: Axis| {
        let apart = scale.place(axis, &to).zip(scale.place(axis, from));
        apart.map_or(0.0, |(to, from)| to - from)
    };
    Sliders {
        rougher: by(Axis::Rough),
        sharper: 0.0,
        harder: by(Axis::Hard),
        slipperier: by(Axis::Slippery),
    }
}

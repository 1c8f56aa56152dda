//! What latents feel like, each looked at once: a search comes back to where it began.

use super::{error::EditError, latent_editor::LatentEditor};
use crate::{
    edit_memory::Latents,
    pipeline::{Pipeline, Request},
};
use asperity_texture::model::attributes::{Attributes, Meter};
use std::cell::RefCell;

/// The looks of one search.
pub(super) struct Look<'a> {
    editor: &'a LatentEditor<'a>,
    request: &'a Request,
    meter: RefCell<Meter>,
    decoded: RefCell<Vec<(Latents, Attributes)>>,
    kept: RefCell<Vec<(Latents, Attributes)>>,
}

impl<'a> Look<'a> {
    pub(super) fn new(editor: &'a LatentEditor<'a>, request: &'a Request) -> Self {
        Self {
            editor,
            request,
            meter: RefCell::default(),
            decoded: RefCell::default(),
            kept: RefCell::default(),
        }
    }

    /// The attributes of what these latents decode to, before anything is reduced.
    pub(super) fn decoded(&self, latents: &Latents) -> Result<Attributes, EditError> {
        once(&self.decoded, latents, || {
            let texture = self.editor.texture(latents)?;
            Ok(self.meter.borrow_mut().of(&texture))
        })
    }

    /// The attributes of the asset that these latents give: what is left out counts no more.
    pub(super) fn kept(&self, latents: &Latents) -> Result<Attributes, EditError> {
        once(&self.kept, latents, || {
            let mut pipeline = Pipeline::default();
            let texture = pipeline.converted(self.editor.texture(latents)?, self.request)?;
            let kept = pipeline.reduce(&texture, self.request.fidelity).texture;
            Ok(self.meter.borrow_mut().of(&kept))
        })
    }
}

/// What was found of these latents, or what `find` finds.
fn once(
    found: &RefCell<Vec<(Latents, Attributes)>>,
    latents: &Latents,
    find: impl FnOnce() -> Result<Attributes, EditError>,
) -> Result<Attributes, EditError> {
    // Searches take tens of looks. Latents with a NaN are looked at again.
    let known = found.borrow().iter().find(|(of, _)| of == latents).copied();
    if let Some((_, attributes)) = known {
        return Ok(attributes);
    }
    let attributes = find()?;
    found.borrow_mut().push((*latents, attributes));
    Ok(attributes)
}

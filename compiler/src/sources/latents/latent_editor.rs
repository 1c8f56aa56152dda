//! From latents to assets, and from assets back to their latents.

use super::{
    attribute_cache::AttributeCache,
    fault::no_latent,
    scale::Scale,
    solve::Metric,
    source::{FromLatents, decode},
};
use crate::{
    edit_memory::{Latents, Memory, remembered},
    emit::raise::raise,
    passes::reduce::Fidelity,
    pipeline::Request,
    sources::prompt::PromptCompiler,
    views::preview,
};
use asperity_formats::Asset;
use asperity_io::diagnostic::Fault;
use asperity_texture::model::{Provenance, TextureModel, attributes::Attributes};

/// Everything that mixes and edits: a prompt compiler's model, and where its sliders lie.
pub struct LatentEditor<'a> {
    pub(super) prompt_compiler: &'a PromptCompiler,
    pub(super) scale: Scale,
    pub(super) metric: Metric,
}

impl<'a> LatentEditor<'a> {
    /// An editor on a prompt compiler.
    #[must_use]
    pub fn new(prompt_compiler: &'a PromptCompiler) -> Self {
        let description = prompt_compiler.model().description();
        Self {
            prompt_compiler,
            scale: Scale::of(description),
            metric: Metric::of(&description.anchors),
        }
    }

    /// The prompt compiler.
    #[must_use]
    pub fn prompt_compiler(&self) -> &'a PromptCompiler {
        self.prompt_compiler
    }

    /// The scale of the sliders.
    #[must_use]
    pub fn scale(&self) -> &Scale {
        &self.scale
    }

    /// Reads the edit memory of an asset.
    ///
    /// # Errors
    /// [`Fault`] for an asset without a latent, or with one of another model.
    pub fn memory(&self, asset: &Asset<'_>) -> Result<Memory, Fault> {
        let name = asset.name();
        let memory = remembered(asset)?.ok_or_else(|| no_latent(name))?;
        let model = self.prompt_compiler.model();
        if model.has_latent_of(memory.model_crc32) {
            Ok(memory)
        } else {
            let what = format!(
                "{name:?} was decoded with model {:08x}, but this is model {:08x}",
                memory.model_crc32,
                model.crc32()
            );
            let remedy = "give the folder of its model with --model, or compile its prompt again";
            Err(Fault::new(what, remedy))
        }
    }

    /// The texture that an asset remembers.
    ///
    /// # Errors
    /// As [`memory`](Self::memory).
    pub fn remembered(&self, asset: &Asset<'_>) -> Result<FromLatents, Fault> {
        Ok(FromLatents::remembered(raise(asset), self.memory(asset)?))
    }

    /// Returns the request that an asset was compiled with, so that it can be compiled again in the same way. The rate
    /// is the decoder's own if `None`.
    #[must_use]
    pub fn request(&self, asset: &Asset<'_>) -> Request {
        let fidelity = asset.provenance().map(|p| p.fidelity.parse());
        let rate_hz = f64::from(asset.grid().sample_rate_hz());
        let own_hz = self
            .prompt_compiler
            .model()
            .description()
            .grid
            .sample_rate_hz;
        Request {
            fidelity: fidelity.and_then(Result::ok).unwrap_or(Fidelity::Auto),
            rate_hz: (rate_hz != own_hz).then_some(rate_hz),
            // What is no picture of a known size is drawn at the usual one.
            preview_px: asset
                .preview_png()
                .map(|png| preview::width(png).unwrap_or(preview::SIZE)),
            ..Request::default()
        }
    }

    /// The texture of these latents before it is reduced.
    ///
    /// # Errors
    /// [`Fault`] when a network fails.
    pub fn texture(&self, latents: &Latents) -> Result<TextureModel, Fault> {
        let model = self.prompt_compiler.model();
        decode(model, latents, "", Provenance::default())
    }

    /// The attributes of these latents, before anything is reduced.
    ///
    /// # Errors
    /// As [`texture`](Self::texture).
    pub fn attributes(&self, latents: &Latents) -> Result<Attributes, Fault> {
        AttributeCache::new(self.prompt_compiler, &Request::default()).decoded(latents)
    }

    /// The attributes of the asset that these latents give: what is left out counts no more.
    ///
    /// # Errors
    /// As [`texture`](Self::texture), and for a rate that the models cannot have.
    pub fn kept_attributes(
        &self,
        latents: &Latents,
        request: &Request,
    ) -> Result<Attributes, Fault> {
        AttributeCache::new(self.prompt_compiler, request).kept(latents)
    }
}

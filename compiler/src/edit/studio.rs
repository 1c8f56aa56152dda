//! From latents to assets, and from assets back to their latents.

use super::{
    error::EditError,
    history::{History, Source},
    latents::Latents,
    loudness::equal_loudness,
    memory::{Memory, remember, remembered},
    scale::Scale,
    solve::Metric,
};
use crate::{
    emit::raise,
    learned::{Decoded, friction, texture},
    model::{
        FrictionLaw, Provenance, TextureModel,
        attributes::{self, Attributes},
    },
    passes::reduce::Fidelity,
    pipeline::{Pass, Passed, Pipeline, Request, Ringing, Timings},
    sources::prompt::{Author, phrase::adjust::adjust},
    views::preview,
};
use asperity_formats::Asset;

/// Everything that mixes and edits: an author's model, and where its sliders lie.
pub struct Studio<'a> {
    pub(super) author: &'a Author,
    model_crc32: u32,
    pub(super) scale: Scale,
    pub(super) metric: Metric,
}

/// How an asset is compiled once its latents are known.
#[derive(Debug, Clone, PartialEq)]
pub struct How {
    /// What is asked of any texture; the rate is the decoder's own if `None`.
    pub request: Request,
    /// How friction depends on speed, of which latents say nothing: its factors multiply what they
    /// say of μ.
    pub law: Option<FrictionLaw>,
}

/// A compiled texture with its memory.
#[derive(Debug, Clone)]
pub struct Made {
    /// The asset, latents and history included.
    pub bytes: Vec<u8>,
    /// The texture that it holds.
    pub texture: TextureModel,
    /// Bytes that a runtime needs.
    pub haptic_bytes: usize,
    /// Gain of the vibration before the ceiling lowered it, s²/m.
    pub asked_s2_m: f64,
    /// Attributes of that texture.
    pub attributes: Attributes,
    /// Fraction of the way to white noise that the models were moved, 0..=1.
    pub stabilised: f64,
    /// The time of every pass.
    pub timings: Timings,
}

impl<'a> Studio<'a> {
    /// A studio of an author whose model has this CRC-32.
    #[must_use]
    pub fn new(author: &'a Author, model_crc32: u32) -> Self {
        let description = author.model().description();
        Self {
            author,
            model_crc32,
            scale: Scale::of(description),
            metric: Metric::of(&description.anchors),
        }
    }

    /// The author.
    #[must_use]
    pub fn author(&self) -> &'a Author {
        self.author
    }

    /// CRC-32 of the model.
    #[must_use]
    pub fn model_crc32(&self) -> u32 {
        self.model_crc32
    }

    /// The scale of the sliders.
    #[must_use]
    pub fn scale(&self) -> &Scale {
        &self.scale
    }

    /// What an asset remembers.
    ///
    /// # Errors
    /// [`EditError`] for an asset without a latent, or with one of another model.
    pub fn memory(&self, asset: &Asset<'_>) -> Result<Memory, EditError> {
        let name = asset.name().to_owned();
        let memory = remembered(asset)?.ok_or_else(|| EditError::NoLatent(name.clone()))?;
        if memory.model_crc32 == self.model_crc32 {
            Ok(memory)
        } else {
            Err(EditError::OtherModel {
                name,
                found: memory.model_crc32,
                expected: self.model_crc32,
            })
        }
    }

    /// A texture that another one is made of.
    ///
    /// # Errors
    /// As [`memory`](Self::memory).
    pub fn source(&self, asset: &Asset<'_>) -> Result<(Source, Latents), EditError> {
        let latents = self.memory(asset)?.latents;
        let prompt = asset.provenance().and_then(|p| p.prompt);
        Ok((Source::new(asset.name(), prompt, &latents), latents))
    }

    /// How an asset was compiled, so that it can be compiled again in the same way.
    #[must_use]
    pub fn how(&self, asset: &Asset<'_>) -> How {
        let fidelity = asset.provenance().map(|p| p.fidelity.parse());
        let rate_hz = f64::from(asset.grid().sample_rate_hz());
        let own_hz = self.author.model().description().grid.sample_rate_hz;
        How {
            request: Request {
                fidelity: fidelity.and_then(Result::ok).unwrap_or(Fidelity::Auto),
                rate_hz: (rate_hz != own_hz).then_some(rate_hz),
                // What is no picture of a known size is drawn at the usual one.
                preview_px: asset
                    .preview_png()
                    .map(|png| preview::width(png).unwrap_or(preview::SIZE)),
                ..Request::default()
            },
            law: raise::law(asset),
        }
    }

    /// Where a texture of this command comes from.
    #[must_use]
    pub fn provenance(&self, command: &str) -> Provenance {
        let description = self.author.model().description();
        let synthetic = if description.corpus.taps_synthetic {
            "Trained on synthetic taps. "
        } else {
            ""
        };
        Provenance {
            generator: format!("asperity {} {command}", env!("CARGO_PKG_VERSION")),
            source: format!("model {}", description.name),
            source_crc32: description.corpus.crc32,
            taps_synthetic: true,
            notes: format!(
                "Decoded from a learned model of the {} corpus, text encoder {}. {synthetic}Gains and wall are unconfirmed defaults.",
                description.corpus.name, description.text_encoder.name
            ),
            ..Provenance::default()
        }
    }

    /// The texture of these latents before it is reduced.
    ///
    /// # Errors
    /// [`EditError::Model`] when a network fails.
    pub fn texture(
        &self,
        latents: &Latents,
        name: &str,
        provenance: Provenance,
    ) -> Result<TextureModel, EditError> {
        let model = self.author.model();
        let description = model.description();
        let decoded = self.decoded(latents)?;
        let (mut texture, _) = texture::build(
            description,
            &decoded,
            &latents.friction,
            name.to_owned(),
            provenance,
        );
        if latents.tap != latents.friction {
            let near =
                friction::neighbours(&latents.tap, &description.anchors, description.friction);
            texture.wall.stiffness_n_m = friction::stiffness_n_m(&near, &description.anchors);
        }
        adjust(&mut texture, &latents.shift);
        Ok(texture)
    }

    fn decoded(&self, latents: &Latents) -> Result<Decoded, EditError> {
        let model = self.author.model();
        let slide = model.decode(&latents.slide)?;
        if latents.tap == latents.slide {
            return Ok(slide);
        }
        let tap = model.decode(&latents.tap)?;
        Ok(Decoded {
            taps_m_s2: tap.taps_m_s2,
            ..slide
        })
    }

    /// The attributes of these latents, before anything is reduced.
    ///
    /// # Errors
    /// As [`texture`](Self::texture).
    pub fn attributes(&self, latents: &Latents) -> Result<Attributes, EditError> {
        let texture = self.texture(latents, "", Provenance::default())?;
        Ok(attributes::of(&texture))
    }

    /// The attributes of the asset that these latents give: what is left out counts no more.
    ///
    /// # Errors
    /// As [`texture`](Self::texture), and for a rate that the models cannot have.
    pub fn kept_attributes(&self, latents: &Latents, how: &How) -> Result<Attributes, EditError> {
        let mut pipeline = Pipeline::default();
        let mut texture = self.texture(latents, "", Provenance::default())?;
        if let Some(rate_hz) = how.request.rate_hz {
            texture = pipeline.rerate(texture, rate_hz)?;
        }
        let kept = pipeline.reduce(&texture, how.request.fidelity).texture;
        Ok(attributes::of(&kept))
    }

    /// Compiles latents to an asset that remembers them.
    ///
    /// # Errors
    /// [`EditError`] for a texture that does not pass the pipeline.
    pub fn compile(
        &self,
        latents: &Latents,
        name: &str,
        provenance: Provenance,
        history: History,
        how: &How,
    ) -> Result<Made, EditError> {
        let mut pipeline = Pipeline::default();
        let texture = pipeline.run(Pass::Decode, || self.texture(latents, name, provenance));
        let mut texture = texture?;
        let mu = texture.friction.mu;
        texture.friction.law = how.law.clone().map(|law| law.beside(mu));
        if let Some(level_db) = history.loudness_db {
            equal_loudness(&mut texture, level_db);
        }
        let compiled = pipeline.compile(texture, &how.request, Ringing::Stabilised);
        let Passed {
            whole,
            texture,
            lowered,
            stabilised,
            ..
        } = compiled?;
        let memory = Memory {
            model_crc32: self.model_crc32,
            latents: *latents,
            history,
        };
        Ok(Made {
            bytes: remember(&lowered.bytes, &memory)?,
            haptic_bytes: lowered.haptic_bytes,
            asked_s2_m: whole.gains.vib_s2_m,
            attributes: attributes::of(&texture),
            texture,
            stabilised,
            timings: pipeline.timings().clone(),
        })
    }
}

//! From latents to assets, and from assets back to their latents.

use super::{
    error::EditError,
    history::{History, Source},
    latents::Latents,
    loudness::equal_loudness,
    memory::{Memory, remember, remembered},
    scale::{AXES, Axis, Scale},
    sliders::Sliders,
    solve::{Metric, along, reach},
};
use crate::{
    front_ends::{
        learned::{Decoded, Latent, friction, texture},
        prompt::Author,
    },
    model::{
        Provenance, TextureModel,
        attributes::{self, Attributes},
    },
    passes::reduce::Fidelity,
    pipeline::{Compiled, Pass, Pipeline, Preview, Settings, Timings},
    views::preview,
};
use asperity_formats::Asset;

/// Everything that mixes and edits: an author's model, and where its sliders lie.
pub struct Studio<'a> {
    author: &'a Author,
    model_crc32: u32,
    scale: Scale,
    metric: Metric,
}

/// Times that a way is corrected by what is kept at its end.
const CORRECTIONS: usize = 6;
/// Distance at which no more is corrected, steps of a slider.
const NEAR: f64 = 0.5;
/// Steps that a correction may aim beyond what was asked for.
const FARTHER: f64 = 30.0;

/// How an asset is compiled once its latents are known.
#[derive(Debug, Clone, PartialEq)]
pub struct How {
    /// How much of the model the asset keeps.
    pub fidelity: Fidelity,
    /// Rate of the AR models, Hz; the decoder's own if `None`.
    pub rate_hz: Option<f64>,
    /// Whether a preview is drawn.
    pub preview: bool,
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
            fidelity: fidelity.and_then(Result::ok).unwrap_or(Fidelity::Auto),
            rate_hz: (rate_hz != own_hz).then_some(rate_hz),
            preview: asset.preview_png().is_some(),
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
        if let Some(rate_hz) = how.rate_hz {
            texture = pipeline.rerate(texture, rate_hz)?;
        }
        let kept = pipeline.reduce(&texture, how.fidelity).texture;
        Ok(attributes::of(&kept))
    }

    /// The latents after an edit. Each slider moves its attribute by as many steps of the scale, as
    /// far as the model's materials allow, and leaves the others where they are: level and centroid
    /// of the vibration lie in what sliding was decoded from, the centroid of the taps in what
    /// tapping was, μ in friction. What counts is the asset, whose vertices are fewer than those
    /// that are decoded, so the way is corrected by what is kept at its end.
    ///
    /// # Errors
    /// As [`kept_attributes`](Self::kept_attributes).
    pub fn edited(
        &self,
        latents: &Latents,
        sliders: &Sliders,
        how: &How,
    ) -> Result<Latents, EditError> {
        let before = self.kept_attributes(latents, how)?;
        let mut aim = *sliders;
        let mut best = (f64::INFINITY, *latents);
        for _ in 0..CORRECTIONS {
            let edited = self.moved(latents, sliders, &aim)?;
            let after = self.kept_attributes(&edited, how)?;
            let missing = AXES.map(|axis| {
                let place = |attributes| self.scale.place(axis, attributes).unwrap_or(0.0);
                sliders.along(axis) - (place(&after) - place(&before))
            });
            let worst = missing.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            if worst < best.0 {
                best = (worst, edited);
            }
            if worst < NEAR {
                break;
            }
            for (axis, missing) in AXES.into_iter().zip(missing) {
                let furthest = sliders.along(axis).abs() + FARTHER;
                let step = aim.along(axis) + missing;
                *aim.along_mut(axis) = step.clamp(-furthest, furthest);
            }
        }
        Ok(best.1)
    }

    /// The latents after a move to these aims, of the parts that the sliders ask to move. Attributes
    /// are those of what is decoded.
    fn moved(
        &self,
        latents: &Latents,
        sliders: &Sliders,
        aim: &Sliders,
    ) -> Result<Latents, EditError> {
        let before = self.attributes(latents)?;
        let mut edited = *latents;
        let asked = |axis: Axis| sliders.along(axis) != 0.0;
        let target = |axis: Axis| {
            let place = self.scale.place(axis, &before);
            place.map(|place| place + aim.along(axis))
        };
        let gradient = |axis: Axis| self.scale.gradients[axis as usize].as_slice();
        if asked(Axis::Rough) || asked(Axis::Sharp) {
            let axes = [Axis::Rough, Axis::Sharp];
            if let [Some(rough), Some(sharp)] = axes.map(target) {
                let look = |z: &Latent| self.seen(z, &axes);
                let gradients = axes.map(gradient);
                let found = reach(
                    &latents.slide,
                    &gradients,
                    &self.metric,
                    &[rough, sharp],
                    look,
                )?;
                edited.slide = found.z;
            }
        }
        if asked(Axis::Hard)
            && let Some(hard) = target(Axis::Hard)
        {
            let look = |z: &Latent| self.seen(z, &[Axis::Hard]);
            let gradients = [gradient(Axis::Hard)];
            edited.tap = reach(&latents.tap, &gradients, &self.metric, &[hard], look)?.z;
        }
        if asked(Axis::Slippery)
            && let Some(slippery) = target(Axis::Slippery)
        {
            let description = self.author.model().description();
            let look = |z: &Latent| {
                let near = friction::neighbours(z, &description.anchors, description.friction);
                let attributes = Attributes {
                    mu: friction::mu(&near, &description.anchors),
                    ..before
                };
                self.scale.place(Axis::Slippery, &attributes).unwrap_or(0.0)
            };
            let gradient = gradient(Axis::Slippery);
            edited.friction = along(&latents.friction, gradient, &self.metric, slippery, look);
        }
        Ok(edited)
    }

    /// Places on the sliders of what one latent decodes to.
    fn seen(&self, z: &Latent, axes: &[Axis]) -> Result<Option<Vec<f64>>, EditError> {
        let attributes = self.attributes(&Latents::whole(*z))?;
        let places = axes.iter().map(|&axis| self.scale.place(axis, &attributes));
        Ok(places.collect())
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
        if let Some(level_db) = history.loudness_db {
            equal_loudness(&mut texture, level_db);
        }
        let settings = Settings {
            rate_hz: how.rate_hz,
            fidelity: how.fidelity,
            preview: how.preview.then_some(Preview {
                size_px: preview::SIZE,
            }),
            stabilise: true,
        };
        let Compiled {
            whole,
            texture,
            lowered,
            stabilised,
            ..
        } = pipeline.compile(texture, &settings)?;
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

//! From a prompt to a verified texture.

use super::{
    CompiledPrompt, Nearest, PromptError,
    encoding_cache::{EncodingCache, Read},
    error::unread,
    named_things::Things,
    readable::{Understood, check, understood},
    reading::{Reader, Reading, shown},
    stroke::split_stroke,
};
use crate::{
    edit_memory::{History, Latents, Memory},
    learned::{
        Certainty, Decoded, Latent, LearnedModel, contact,
        direction::Stroke,
        embedded,
        files::wrong_width,
        friction::Neighbour,
        inference::Backend,
        text::{TextEncoder, WordStates, WordTable},
        texture,
    },
    pipeline::{Pass, Pipeline, Ringing},
    sources::SourceOutput,
};
use asperity_formats::limits;
use asperity_io::{diagnostic::Fault, shown::shortened};
use asperity_texture::model::{
    Provenance, TextureModel,
    shift::{Scales, adjust},
};
use rand_core::{Rng as _, SeedableRng as _};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::sync::Arc;

/// Bytes of a prompt that the provenance keeps.
const KEPT_PROMPT_BYTES: usize = 2048;

/// Everything that turns prompts into textures; loaded once, asked often.
pub struct PromptCompiler {
    pub(super) text: Box<dyn TextEncoder>,
    model: LearnedModel,
    reader: Reader<WordTable, WordStates>,
    pub(super) things: Things,
    /// Those that the model knows by name.
    pub(super) known: Things,
    pub(super) cache: EncodingCache,
    /// True if its networks give a row of a batch the same bits as the row alone.
    pub(super) together: bool,
}

impl PromptCompiler {
    /// A compiler of prompts, from a text encoder and a model trained with it.
    ///
    /// # Errors
    /// [`Fault`] when they do not belong together.
    pub fn new(text: Box<dyn TextEncoder>, model: LearnedModel) -> Result<Self, Fault> {
        let expected = model.description().text_encoder.width;
        if text.width() == expected {
            Ok(Self {
                text,
                model,
                reader: Reader::new(embedded::word_table()?, embedded::word_states()),
                things: Things::default(),
                known: Things::default(),
                cache: EncodingCache::default(),
                together: false,
            })
        } else {
            Err(wrong_width(expected, text.width()))
        }
    }

    /// The embedded model on a back end.
    ///
    /// # Errors
    /// [`Fault`] when the back end refuses a network.
    pub fn embedded(backend: &Backend) -> Result<Self, Fault> {
        let text = embedded::text_encoder(backend)?;
        let model = LearnedModel::load(embedded::model(), backend)?;
        Ok(Self {
            together: matches!(backend, Backend::Portable),
            ..Self::new(Box::new(text), model)?
        })
    }

    /// The learned model.
    #[must_use]
    pub fn model(&self) -> &LearnedModel {
        &self.model
    }

    /// Reads the names and touch qualities in a prompt, which are encoded.
    #[must_use]
    pub fn read(&self, prompt: &str) -> Reading {
        let cached = self.cache.reading(prompt);
        cached.unwrap_or_else(|| self.reader.read(&split_stroke(prompt).0))
    }

    /// The same of a text that names a surface, and nothing else.
    pub(super) fn read_surface(&self, text: &str) -> Reading {
        self.reader.read_surface(text)
    }

    /// The latent of a prompt before a seed moves it.
    ///
    /// # Errors
    /// [`PromptError`] for an empty prompt or a failing network.
    pub fn project(&self, prompt: &str) -> Result<Projection, PromptError> {
        check(prompt)?;
        self.projected(prompt, self.read(prompt))
    }

    /// The same of what was read of it.
    pub(super) fn projected(
        &self,
        prompt: &str,
        reading: Reading,
    ) -> Result<Projection, PromptError> {
        let read = self.encode(&reading.text())?;
        let (encoded, projected) = (&read.0, &read.1);
        let similarity = projected
            .similarity
            .iter()
            .fold(f64::NEG_INFINITY, |best, &s| best.max(f64::from(s)));
        let unfamiliar = f64::from(projected.familiarity) < self.model.description().unfamiliar;
        let own = match &reading.words[..] {
            [name] => self.own_latent(name),
            _ => None,
        };
        Ok(Projection {
            z: own.unwrap_or(projected.z),
            felt: projected.felt.map(|felt| felt.map(|x| Some(x.into()))),
            similarity,
            familiarity: f64::from(projected.familiarity),
            certainty: self.certainty(&reading, unfamiliar),
            tokens: (encoded.tokens, encoded.cut),
            reading,
            stroke: split_stroke(prompt).1,
            understood: understood(shown(prompt).trim(), |word| self.text.reads(word)),
        })
    }

    /// The latent of a material that the model has by this name; no vector of its name lies nearer.
    pub(super) fn own_latent(&self, name: &str) -> Option<Latent> {
        let anchors = &self.model.description().anchors;
        let anchor = anchors
            .iter()
            .find(|anchor| anchor.name.eq_ignore_ascii_case(name))?;
        anchor.z[..].try_into().ok()
    }

    pub(super) fn encode(&self, text: &str) -> Result<Read, PromptError> {
        if let Some(read) = self.cache.read(text) {
            return Ok(read);
        }
        let encoded = self.text.encode(text).map_err(unread)?;
        let projected = self.model.project(&encoded.vector)?;
        Ok(Arc::new((encoded, projected)))
    }

    /// The parameters that a latent decodes to.
    pub(super) fn decoded(&self, z: &Latent) -> Result<Arc<Decoded>, Fault> {
        match self.cache.decoded(z) {
            Some(decoded) => Ok(decoded),
            None => Ok(Arc::new(self.model.decode(z)?)),
        }
    }

    /// The texture of a prompt before any pass, with its latent and what is to know of it.
    pub(super) fn sourced(
        &self,
        prompt: &str,
        seed: u64,
        pipeline: &mut Pipeline,
    ) -> Result<SourceOutput, PromptError> {
        let prompt = prompt.trim();
        let projection = pipeline.run(Pass::Text, || self.project(prompt))?;
        let (z, wanted) = pipeline.run(Pass::Text, || self.resolve_target(&projection))?;
        let meant = pipeline.run(Pass::Decode, || self.decode_target(z, wanted))?;
        let (shift, place) = (meant.shift, meant.z);
        let z = varied(place, &self.model.description().spread, seed);
        let decoded = pipeline.run(Pass::Decode, || match seed {
            0 => Ok(meant.decoded),
            _ => self.decoded(&z),
        })?;
        let (mut texture, neighbours) = self.named(&decoded, &z, prompt, seed);
        adjust(&mut texture, &shift);
        let law = self.contact_law(&projection, &place)?;
        contact::give(&mut texture, law, &place, self.model.description());
        self.slide_between(&mut texture, &projection.reading)?;
        let (texture, direction) = self.directed(texture, &projection, &place)?;
        let memory = Memory {
            model_crc32: self.model.crc32(),
            latents: Latents::whole(z).shifted(shift),
            history: History {
                // Programs from before there was a level for no contact edit such an asset, too.
                certainty: Some(projection.certainty.max(Certainty::Guess)),
                ..History::default()
            },
        };
        let compiled = CompiledPrompt {
            z,
            shift,
            nearest: self.nearest(&neighbours),
            certainty: projection.certainty,
            similarity: projection.similarity,
            tokens: projection.tokens,
            reading: projection.reading,
            bearing: projection.stroke.map(|stroke| stroke.bearing),
            direction,
            understood: projection.understood,
        };
        Ok(SourceOutput {
            // Latents far from anything trained can decode to models that ring.
            ringing: Ringing::Stabilised,
            memory: Some(memory),
            certainty: Some(compiled.certainty),
            warnings: compiled.warnings(),
            findings: Some(Arc::new(compiled)),
            ..SourceOutput::new(texture)
        })
    }

    /// A decoded latent with the prompt's name and provenance.
    fn named(
        &self,
        decoded: &Decoded,
        z: &Latent,
        prompt: &str,
        seed: u64,
    ) -> (TextureModel, Vec<Neighbour>) {
        let provenance = Provenance {
            prompt: Some(shortened(prompt, KEPT_PROMPT_BYTES).trim_end().to_owned()),
            seed,
            ..self.model.provenance("compile")
        };
        let name = title(prompt);
        texture::build(self.model.description(), decoded, z, name, provenance)
    }

    fn nearest(&self, neighbours: &[Neighbour]) -> Vec<Nearest> {
        neighbours
            .iter()
            .map(|neighbour| {
                let anchor = &self.model.description().anchors[neighbour.index];
                Nearest {
                    name: anchor.name.clone(),
                    family: anchor.family.clone(),
                    mu: anchor.mu,
                    weight: neighbour.weight,
                }
            })
            .collect()
    }
}

/// A prompt in the latent.
#[derive(Debug, Clone, PartialEq)]
pub struct Projection {
    /// The latent.
    pub z: Latent,
    /// The attributes that the words ask for, if the model says.
    pub felt: Option<Scales>,
    /// Largest cosine with a material's mean caption.
    pub similarity: f64,
    /// Soft maximum of the cosines with all that the projection was trained on.
    pub familiarity: f64,
    /// Certainty of the interpretation.
    pub certainty: Certainty,
    /// Tokens read, and cut off.
    pub tokens: (usize, usize),
    /// Names and touch qualities in the prompt.
    pub reading: Reading,
    /// The direction of the strokes, where the prompt says one.
    pub stroke: Option<Stroke>,
    /// Which words the encoder can read.
    pub understood: Understood,
}

// Texts of a length that an asset can hold.

/// A name that an asset can hold: the beginning of the prompt, without control characters.
pub(crate) fn title(prompt: &str) -> String {
    let plain = prompt.replace(char::is_control, " ");
    let words: Vec<&str> = plain.split_whitespace().collect();
    let words = words.join(" ");
    shortened(&words, limits::MAX_NAME_BYTES)
        .trim_end()
        .to_owned()
}

// Another piece of the same material.

/// The latent moved as far as instances of one material lie apart; not at all by seed 0.
///
/// `spread` is the standard deviation of each component within a material.
fn varied(mut z: Latent, spread: &[f32], seed: u64) -> Latent {
    if seed == 0 {
        return z;
    }
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    for (x, spread) in z.iter_mut().zip(spread) {
        *x += spread * normal(&mut random) as f32;
    }
    z
}

/// A standard normal number, by Box and Muller.
fn normal(random: &mut Xoshiro256PlusPlus) -> f64 {
    let mut uniform = || ((random.next_u64() >> 11) as f64 + 0.5) / (1u64 << 53) as f64;
    let radius = (-2.0 * libm::log(uniform())).sqrt();
    radius * libm::cos(std::f64::consts::TAU * uniform())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_title_ends_at_a_whole_character_within_the_limit() {
        assert_eq!(title(" wet\u{0}ice\n"), "wet ice");
        let long = title(&"ä".repeat(40));
        assert_eq!(long, "ä".repeat(32));
    }
}

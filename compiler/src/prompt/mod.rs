//! A prompt becomes a texture: text vector, latent, parameters, asset, preview.

pub mod finish;
mod report;

use crate::{
    attributes::{self, Attributes},
    diagnostic::Diagnostic,
    inference::Backend,
    learned::{self, Files, Latent, LearnedModel, ModelError, friction::Neighbour, texture},
    lower::{LowerError, Lowered},
    model::{Provenance, TextureModel},
    preview::PreviewError,
    reduce::{self, Fidelity},
    rerate,
    text::{TextEncoder, TextError},
    verify::{VerifyError, VerifyReport},
};
use asperity_formats::limits;
use finish::Finished;
use rand_core::SeedableRng as _;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::time::{Duration, Instant};
use thiserror::Error;

/// Below it a prompt is far from anything the model was trained on.
pub const LOW_CERTAINTY: f64 = 0.2;
/// Bytes of a prompt that the provenance keeps.
const KEPT_PROMPT_BYTES: usize = 2048;

/// Why a prompt gave no texture.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PromptError {
    /// Nothing to go by.
    #[error("the prompt is empty")]
    Empty,
    /// The text encoder failed.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The learned model failed.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The rate is none the models can have.
    #[error("--rate {0} Hz: not in {min}..={max} Hz", min = rerate::RATE_RANGE_HZ.0, max = rerate::RATE_RANGE_HZ.1)]
    Rate(f64),
    /// The texture cannot be lowered.
    #[error(transparent)]
    Lower(#[from] LowerError),
    /// The texture is not fit to be felt.
    #[error(transparent)]
    Verify(#[from] VerifyError),
    /// The preview cannot be drawn.
    #[error(transparent)]
    Preview(#[from] PreviewError),
}

impl Diagnostic for PromptError {
    fn remedy(&self) -> String {
        match self {
            Self::Empty => {
                "describe a surface: asperity compile \"rough abrasive sheet\" -o sheet.asp".into()
            }
            Self::Text(_) => "try `asperity doctor`, or leave --text-encoder out".into(),
            Self::Model(error) => error.remedy(),
            Self::Rate(_) => "give the rate of the servo loop, e.g. --rate 1000".into(),
            Self::Lower(error) => error.remedy(),
            Self::Verify(error) => error.remedy(),
            Self::Preview(error) => error.remedy(),
        }
    }

    fn is_usage(&self) -> bool {
        matches!(self, Self::Empty | Self::Rate(_))
    }
}

/// What a user can ask of a texture beside its prompt.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// 0: the texture that the prompt means. Others: variations, as another piece of
    /// the same material varies.
    pub seed: u64,
    /// How much of the model the asset keeps.
    pub fidelity: Fidelity,
    /// Rate of the AR models, Hz; the decoder's own if `None`.
    pub rate_hz: Option<f64>,
    /// Whether a preview is drawn.
    pub preview: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            seed: 0,
            fidelity: Fidelity::Auto,
            rate_hz: None,
            preview: true,
        }
    }
}

/// A stage of the way, and how long it took.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stage {
    /// Its name.
    pub name: &'static str,
    /// Its time.
    pub took: Duration,
}

/// A texture made of a prompt, and what there is to know of it.
#[derive(Debug, Clone)]
pub struct Authored {
    /// The texture as it was verified.
    pub texture: TextureModel,
    /// The asset.
    pub lowered: Lowered,
    /// The preview, if one was asked for.
    pub preview: Option<Vec<u8>>,
    /// The latent it was decoded from.
    pub z: Latent,
    /// The nearest materials: index, name, family, weight in the friction.
    pub nearest: Vec<Nearest>,
    /// Objective attributes.
    pub attributes: Attributes,
    /// Certainty, 0..=1.
    pub certainty: f64,
    /// Largest cosine between the prompt and a material's mean caption.
    pub similarity: f64,
    /// Tokens read, and cut off.
    pub tokens: (usize, usize),
    /// What the fidelity left out, and what that cost.
    pub reduction: reduce::Report,
    /// What verification saw.
    pub verified: VerifyReport,
    /// How far the models had to be moved towards white noise to pass, 0..=1: 0 but for
    /// latents far from anything trained.
    pub calmed: f64,
    /// Time a stage.
    pub stages: Vec<Stage>,
}

/// A material near the prompt.
#[derive(Debug, Clone, PartialEq)]
pub struct Nearest {
    /// Its name.
    pub name: String,
    /// Its family.
    pub family: String,
    /// Its coefficient of friction.
    pub mu: f64,
    /// Its weight, 0..=1.
    pub weight: f64,
}

/// Everything that turns prompts into textures; loaded once, asked often.
pub struct Author {
    text: Box<dyn TextEncoder>,
    model: LearnedModel,
}

impl Author {
    /// An author of a text encoder and a model trained with it.
    ///
    /// # Errors
    /// [`ModelError::Width`] when they do not belong together.
    pub fn new(text: Box<dyn TextEncoder>, model: LearnedModel) -> Result<Self, ModelError> {
        let expected = model.description().text_encoder.width;
        if text.width() == expected {
            Ok(Self { text, model })
        } else {
            Err(ModelError::Width {
                expected,
                found: text.width(),
            })
        }
    }

    /// The embedded model on a back end.
    ///
    /// # Errors
    /// [`ModelError`] when the back end refuses a network.
    pub fn embedded(backend: &Backend) -> Result<Self, ModelError> {
        let text = crate::embedded::text_encoder(backend)?;
        let model = LearnedModel::load(crate::embedded::model(), backend)?;
        Self::new(Box::new(text), model)
    }

    /// An author of a model folder.
    ///
    /// # Errors
    /// As [`Author::new`], and [`ModelError`] for a folder that is none.
    pub fn with_folder(
        text: Box<dyn TextEncoder>,
        folder: &std::path::Path,
        backend: &Backend,
    ) -> Result<Self, ModelError> {
        Self::new(text, LearnedModel::load(Files::read(folder)?, backend)?)
    }

    /// The learned model.
    #[must_use]
    pub fn model(&self) -> &LearnedModel {
        &self.model
    }

    /// The latent of a prompt before a seed moves it.
    ///
    /// # Errors
    /// [`PromptError`] for an empty prompt or a failing network.
    pub fn project(&self, prompt: &str) -> Result<Prompted, PromptError> {
        let prompt = prompt.trim();
        if prompt.is_empty() {
            return Err(PromptError::Empty);
        }
        let encoded = self.text.encode(prompt)?;
        let projected = self.model.project(&encoded.vector)?;
        let similarity = projected
            .similarity
            .iter()
            .fold(f64::NEG_INFINITY, |best, &s| best.max(f64::from(s)));
        Ok(Prompted {
            z: projected.z,
            similarity,
            certainty: learned::certainty(&self.model.description().certainty, similarity),
            tokens: (encoded.tokens, encoded.cut),
        })
    }

    /// The texture of a prompt, verified.
    ///
    /// # Errors
    /// [`PromptError`] with the stage that failed.
    pub fn author(&self, prompt: &str, options: &Options) -> Result<Authored, PromptError> {
        let mut clock = Clock::default();
        let prompt = prompt.trim();
        let prompted = self.project(prompt)?;
        clock.lap("text");
        let z = self.vary(prompted.z, options.seed);
        let (mut texture, neighbours) = self.decode(&z, prompt, options)?;
        clock.lap("decode");
        if let Some(rate_hz) = options.rate_hz {
            texture.grid =
                rerate::rerate(&texture.grid, rate_hz).ok_or(PromptError::Rate(rate_hz))?;
        }
        let nearest = self.nearest(&neighbours);
        let families: Vec<(&str, f64)> = nearest
            .iter()
            .map(|near| (near.family.as_str(), near.weight))
            .collect();
        let Finished {
            texture,
            reduction,
            preview,
            lowered,
            verified,
            calmed,
        } = finish::finish(&texture, &families, options, &mut clock)?;
        Ok(Authored {
            attributes: attributes::of(&texture),
            texture,
            lowered,
            preview,
            z,
            nearest,
            certainty: prompted.certainty,
            similarity: prompted.similarity,
            tokens: prompted.tokens,
            reduction,
            verified,
            calmed,
            stages: clock.stages,
        })
    }

    fn decode(
        &self,
        z: &Latent,
        prompt: &str,
        options: &Options,
    ) -> Result<(TextureModel, Vec<Neighbour>), PromptError> {
        let description = self.model.description();
        let decoded = self.model.decode(z)?;
        let synthetic = if description.corpus.taps_synthetic {
            "Trained on synthetic taps. "
        } else {
            ""
        };
        let provenance = Provenance {
            generator: format!("asperity {} compile", env!("CARGO_PKG_VERSION")),
            source: format!("model {}", description.name),
            source_crc32: description.corpus.crc32,
            prompt: Some(shortened(prompt, KEPT_PROMPT_BYTES).to_owned()),
            seed: options.seed,
            fidelity: options.fidelity.to_string(),
            taps_synthetic: true,
            lsf_error_db: 0.0,
            notes: format!(
                "Decoded from a learned model of the {} corpus, text encoder {}. {synthetic}Gains and wall are unconfirmed defaults.",
                description.corpus.name, description.text_encoder.name
            ),
        };
        let name = title(prompt);
        Ok(texture::build(description, &decoded, z, name, provenance))
    }

    /// Moves a latent as far as instances of one material lie apart.
    fn vary(&self, mut z: Latent, seed: u64) -> Latent {
        if seed == 0 {
            return z;
        }
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        for (x, spread) in z.iter_mut().zip(&self.model.description().spread) {
            *x += spread * normal(&mut random) as f32;
        }
        z
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
pub struct Prompted {
    /// The latent.
    pub z: Latent,
    /// Largest cosine with a material's mean caption.
    pub similarity: f64,
    /// Certainty, 0..=1.
    pub certainty: f64,
    /// Tokens read, and cut off.
    pub tokens: (usize, usize),
}

/// A name that an asset can hold: the beginning of the prompt, without control characters.
fn title(prompt: &str) -> String {
    let plain = prompt.replace(char::is_control, " ");
    let words: Vec<&str> = plain.split_whitespace().collect();
    shortened(&words.join(" "), limits::MAX_NAME_BYTES).to_owned()
}

/// The longest beginning of whole characters within a number of bytes.
fn shortened(text: &str, bytes: usize) -> &str {
    let mut end = text.len().min(bytes);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    text[..end].trim_end()
}

/// Standard normal, by Box and Muller.
fn normal(random: &mut Xoshiro256PlusPlus) -> f64 {
    use rand_core::Rng as _;
    let mut uniform = || ((random.next_u64() >> 11) as f64 + 0.5) / (1u64 << 53) as f64;
    let radius = (-2.0 * libm::log(uniform())).sqrt();
    radius * libm::cos(std::f64::consts::TAU * uniform())
}

/// Times the stages of the way.
pub struct Clock {
    last: Instant,
    stages: Vec<Stage>,
}

impl Default for Clock {
    fn default() -> Self {
        Self {
            last: Instant::now(),
            stages: Vec::new(),
        }
    }
}

impl Clock {
    fn lap(&mut self, name: &'static str) {
        let now = Instant::now();
        self.stages.push(Stage {
            name,
            took: now - self.last,
        });
        self.last = now;
    }
}

//! The configuration of a training run: every number of the recipe, in one TOML file.

mod validate;

use asperity_corpus::ConstantSet;
use asperity_io::diagnostic::Diagnostic;
use serde::{Deserialize, Serialize};
use std::{
    fs, io,
    path::{Path, PathBuf},
};
use thiserror::Error;

/// `configs/paper.toml`.
pub const PAPER: &str = include_str!("../configs/paper.toml");
/// `configs/hatt.toml`.
pub const HATT: &str = include_str!("../configs/hatt.toml");
/// `configs/reference.toml`.
pub const REFERENCE: &str = include_str!("../configs/reference.toml");

/// A training run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Config {
    /// Name of the model.
    pub name: String,
    /// Seed of initialisation, shuffles and noise.
    pub seed: u64,
    /// Training corpus.
    pub corpus: CorpusChoice,
    /// Coding of an instance's numbers for the network.
    pub coding: Coding,
    /// Sizes.
    pub network: Network,
    /// Weights of the terms of the loss.
    pub loss: Loss,
    /// Optimisation of the whole network.
    pub optimiser: Optimiser,
    /// Augmentation while training.
    pub augmentation: Augmentation,
    /// The second stage, which projects texts from memory; none in the paper.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub text_stage: Option<TextStage>,
    /// Estimation of μ from the anchors.
    pub friction: Friction,
    /// Cross-validation.
    pub evaluation: Evaluation,
}

/// Training corpus.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CorpusChoice {
    /// Which corpus.
    pub kind: CorpusKind,
    /// Augmented instances a material.
    pub instances: usize,
    /// Constants of the generator that makes the reference corpus.
    #[serde(default)]
    pub constants: ConstantSet,
}

/// The corpora there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CorpusKind {
    /// The synthetic reference corpus.
    Reference,
    /// A folder of HaTT models.
    Hatt,
}

/// Coding of an instance's numbers for the network.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coding {
    /// The 22nd channel.
    pub excitation: Excitation,
    /// Grouping of the values that share a mean and a deviation.
    pub normalisation: Normalisation,
}

/// Content of the 22nd channel of a bin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Excitation {
    /// Variance of the white noise that drives the filter, (m/s²)²: the paper's.
    Variance,
    /// RMS of the vibration itself, dB re 1 m/s².
    Level,
}

/// Grouping of the values that share a mean and a deviation. Taps always share them within a trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Normalisation {
    /// A channel over all bins: the paper's.
    Channel,
    /// A channel of one bin.
    Bin,
}

/// Sizes of the network.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Network {
    /// Width of the latent; the compiler knows 64.
    pub latent: usize,
    /// Widths of the AR encoder after its 396 inputs.
    pub ar_encoder: Vec<usize>,
    /// Widths of the tap encoder after its 1,300 inputs.
    pub tap_encoder: Vec<usize>,
    /// Widths of both decoders between latent and residual blocks.
    pub decoder: Vec<usize>,
    /// Residual blocks of the AR decoder.
    pub ar_residual_blocks: usize,
    /// Residual blocks of the tap decoder.
    pub tap_residual_blocks: usize,
    /// Hidden widths of the text projection.
    pub text_projection: Vec<usize>,
    /// Hidden width of the latent's own projection.
    pub latent_projection: usize,
    /// Dropout in residual blocks and in the latent's projection.
    pub dropout: f64,
}

/// Weights of the terms of the loss.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Loss {
    /// λ_rec.
    pub reconstruction: f64,
    /// λ_ar.
    pub ar: f64,
    /// λ_tap.
    pub taps: f64,
    /// Share of the excitation in the AR term, 0..=1; the paper's mean over all channels
    /// gives it 1/22.
    pub excitation_share: f64,
    /// λ_text, of InfoNCE.
    pub contrastive: f64,
    /// τ of InfoNCE.
    pub temperature: f64,
    /// λ_align, of the mean square of μ̂ − μ.
    pub alignment: f64,
    /// Weight of the mean square of μ − c, c a learned centre for each material (Wen et al. 2016, centre loss); none in
    /// the paper.
    #[serde(default)]
    pub compactness: f64,
    /// Weight of the mean square error of ln μ_friction, standardised, read linearly from the posterior's mean:
    /// encoders see no friction, yet it is read from neighbours in the latent; none in the paper.
    #[serde(default)]
    pub friction: f64,
    /// β at its largest.
    pub kl: f64,
    /// Epoch until which β is zero.
    pub kl_from_epoch: usize,
    /// Epoch from which β is at its largest; linear in between.
    pub kl_to_epoch: usize,
}

/// Optimisation: Adam with decoupled weight decay.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Optimiser {
    /// Passes over the corpus.
    pub epochs: usize,
    /// Instances a step.
    pub batch: usize,
    /// Step size.
    pub learning_rate: f64,
    /// Step size at the end, reached along half a cosine; constant if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub final_learning_rate: Option<f64>,
    /// Largest norm of the gradient over all parameters.
    pub clip_norm: f64,
    /// Decoupled weight decay, as a rate per unit of step size.
    pub weight_decay: f64,
}

/// Augmentation while training.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Augmentation {
    /// Probability that an encoder sees only one modality of an instance.
    pub modality_dropout: f64,
    /// Norm of the Gaussian noise on a caption's unit vector.
    pub caption_noise: f64,
    /// Probability that a caption's vector is mixed with another's of its material.
    pub caption_mixup: f64,
    /// Probability that the AR decoder gets a mixture of the latents of two instances and is asked for the same
    /// mixture of their models: ours, so that textures change evenly between materials (Verma et al., 2019).
    #[serde(default)]
    pub latent_mixup: f64,
}

/// The second stage: the VAE stands, and a memory of captions and lexicon takes the place of the
/// trained text projection.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TextStage {
    /// τ_t of the weights by meaning.
    pub lexicon_temperature: f64,
    /// h of the weights by rating, on the scale 0–100.
    pub lexicon_bandwidth: f64,
    /// The projection from memory.
    pub memory: Memory,
}

/// The projection from memory: kernel ridge regression over captions and lexicon.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Memory {
    /// γ of `exp(γ(cos − 1))`.
    pub concentration: f64,
    /// λ.
    pub ridge: f64,
    /// Steps of the solver at most.
    pub iterations: usize,
    /// Principal directions of the text vectors that are kept.
    pub directions: usize,
    /// Weight of a caption relative to a name or a surely rated phrase: captions speak of several aspects at once, and
    /// few of them are about sliding contact.
    pub caption_weight: f64,
    /// γ of the regression of the three attributes.
    pub felt_concentration: f64,
    /// Weight of a caption in that regression.
    pub felt_caption_weight: f64,
    /// Draws a text that is clearly about one material to it; none if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub recall: Option<Recall>,
}

/// Recall, which draws a text to the material that it is about.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Recall {
    /// τ of the softmax over names, synonyms and mean texts of materials.
    pub temperature: f64,
    /// Directions of a linear discriminant analysis on which texts are compared.
    pub directions: usize,
    /// Shrinkage of its scatter within materials towards a multiple of the unit matrix: that multiple, over the mean
    /// variance.
    pub shrinkage: f64,
    /// Weight of a mean text relative to a name.
    pub mean_weight: f64,
    /// Cosine on these directions that a material's text must exceed, for its latent to count more
    /// than the regression's.
    pub familiar: f64,
    /// τ of the softmax over names, synonyms and phrases of the lexicon that draws the three
    /// attributes.
    pub felt_temperature: f64,
    /// Weight of a phrase in that softmax relative to a name: a phrase keeps the regression's result.
    pub felt_phrase_weight: f64,
}

/// Estimation of μ from the anchors.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Friction {
    /// Number of anchors that count.
    pub top_k: usize,
    /// Temperature of the softmax over cosines.
    pub temperature: f64,
}

/// Cross-validation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evaluation {
    /// Number of folds.
    pub folds: usize,
}

/// Why a configuration cannot be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// The file cannot be read.
    #[error("{}: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The file is no TOML, or has a field too many or too few.
    #[error("{file}: {message}")]
    Syntax {
        /// The file.
        file: String,
        /// Where and what.
        message: String,
    },
    /// A field has a value that makes no sense.
    #[error("{field} = {value}: must be {expected}")]
    Value {
        /// The field, with its table.
        field: &'static str,
        /// Its value.
        value: String,
        /// The permitted values.
        expected: &'static str,
    },
}

impl Diagnostic for ConfigError {
    fn remedy(&self) -> String {
        match self {
            Self::Unreadable { .. } => "give a TOML file, or one of: paper, reference, hatt".into(),
            Self::Syntax { .. } => {
                "start from `asperity-train config reference`, or `paper`, or `hatt`".into()
            }
            Self::Value {
                field, expected, ..
            } => format!("set {field} to {expected}"),
        }
    }

    fn is_usage(&self) -> bool {
        true
    }
}

impl Config {
    /// `paper`, `reference`, `hatt`, or the path of a file.
    ///
    /// # Errors
    /// [`ConfigError`].
    pub fn find(name_or_path: &str) -> Result<Self, ConfigError> {
        match name_or_path {
            "paper" => Self::parse("paper", PAPER),
            "reference" => Self::parse("reference", REFERENCE),
            "hatt" => Self::parse("hatt", HATT),
            path => {
                let text = fs::read_to_string(path).map_err(|source| ConfigError::Unreadable {
                    path: Path::new(path).to_owned(),
                    source,
                })?;
                Self::parse(path, &text)
            }
        }
    }

    /// Reads and validates a configuration; `file` is for messages.
    ///
    /// # Errors
    /// [`ConfigError`].
    pub fn parse(file: &str, text: &str) -> Result<Self, ConfigError> {
        let config: Self = toml::from_str(text).map_err(|e| ConfigError::Syntax {
            file: file.to_owned(),
            message: e.to_string().trim_end().to_owned(),
        })?;
        config.validate()?;
        Ok(config)
    }

    /// The configuration as TOML, which [`parse`](Self::parse) reads back.
    ///
    /// # Errors
    /// [`ConfigError::Syntax`] where TOML has no such number, such as a seed of 2⁶³.
    pub fn to_toml(&self) -> Result<String, ConfigError> {
        toml::to_string(self).map_err(|e| ConfigError::Syntax {
            file: self.name.clone(),
            message: e.to_string(),
        })
    }
}

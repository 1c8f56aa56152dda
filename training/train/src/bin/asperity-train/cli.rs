//! Command-line arguments.

use asperity::learned::{inference::BackendName, text::TextEncoderChoice};
use asperity_corpus::ConstantSet;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::{num::NonZeroUsize, path::PathBuf};

/// Trains and evaluates the learned texture model.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Train on a corpus and write a model folder
    Fit(Fit),
    /// Report what a model is worth: on its corpus, on captions and materials never seen
    Evaluate(crate::evaluate::Evaluate),
    /// Print a recipe, to start one's own from
    Config(Config),
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  asperity-train fit -o model
  asperity-train fit --config paper --hatt ~/HaTT/Models -o hatt-model
  asperity-train fit --config mine.toml --text-encoder clip:./clip -o clip-model")]
pub(crate) struct Fit {
    /// `paper`, `reference`, `hatt`, or a TOML file
    #[arg(long, default_value = "reference", value_name = "NAME|FILE")]
    pub(crate) config: String,
    /// The model folder to write; a model that is there is replaced
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    /// A folder of family files instead of the embedded reference corpus
    #[arg(long, value_name = "DIR", conflicts_with = "hatt")]
    pub(crate) corpus: Option<PathBuf>,
    /// Your folder of HaTT models, for a configuration with corpus.kind = "hatt", which
    /// this option implies
    #[arg(long, value_name = "DIR")]
    pub(crate) hatt: Option<PathBuf>,
    /// Constants of the generator that makes the reference corpus, instead of the configuration's
    #[arg(long, value_name = "SET")]
    pub(crate) constants: Option<Constants>,
    /// Instead of the configuration's
    #[arg(long)]
    pub(crate) seed: Option<u64>,
    /// Instead of the configuration's
    #[arg(long)]
    pub(crate) epochs: Option<usize>,
    /// `minilm`, embedded, or `clip:DIR` with an export of CLIP's text tower
    #[arg(long, default_value = "minilm", value_name = "minilm|clip:DIR")]
    pub(crate) text_encoder: TextEncoderChoice,
    /// Where the text encoder runs: `portable`, or `onnxruntime` where it is installed
    #[arg(long, default_value_t, value_name = "portable|onnxruntime")]
    pub(crate) backend: BackendName,
    /// Keep text vectors in this file, and take from it those that are there
    #[arg(long, value_name = "FILE")]
    pub(crate) vectors: Option<PathBuf>,
    /// Threads; as many as there are cores if left out. The model does not depend on it
    #[arg(long)]
    pub(crate) threads: Option<NonZeroUsize>,
    /// No progress bar
    #[arg(short, long)]
    pub(crate) quiet: bool,
    /// Print the metrics as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Constants {
    /// Fitted to measured materials, as aggregates
    Calibrated,
    /// From physics and openly licensed measurements alone
    Open,
}

impl From<Constants> for ConstantSet {
    fn from(set: Constants) -> Self {
        match set {
            Constants::Calibrated => Self::Calibrated,
            Constants::Open => Self::Open,
        }
    }
}

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  asperity-train config reference > mine.toml")]
pub(crate) struct Config {
    /// Which
    pub(crate) name: Recipe,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Recipe {
    /// The paper's
    Paper,
    /// The shipped model's
    Reference,
    /// For your own HaTT
    Hatt,
}

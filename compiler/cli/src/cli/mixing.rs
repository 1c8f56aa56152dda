//! Arguments of the commands that mix and edit in the latent.

use super::{Inference, PreviewOptions, ReportOptions};
use asperity::edit::Part;
use clap::Args;
use std::path::PathBuf;

/// Where a mixed texture goes, and how.
#[derive(Debug, Args)]
pub(crate) struct Mixed {
    /// The asset to write (.asp); `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// Name of the texture
    #[arg(long)]
    pub(crate) name: Option<String>,
    #[command(flatten)]
    pub(crate) preview: PreviewOptions,
    #[command(flatten)]
    pub(crate) inference: Inference,
    #[command(flatten)]
    pub(crate) reporting: ReportOptions,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Both textures remember the latent they were decoded from; the one between them is \
decoded from (1 − t)·a + t·b. It is kept as A was: fidelity and rate.

Examples:
  asperity blend towel.asp whiteboard.asp -o between.asp
  asperity blend towel.asp whiteboard.asp -t 0.25 -o quarter.asp --name \"mostly towel\""
)]
pub(crate) struct Blend {
    /// The texture at t = 0 (.asp, or FILE.aspl#NAME)
    pub(crate) a: String,
    /// The texture at t = 1
    pub(crate) b: String,
    /// Where between them, 0 to 1
    #[arg(short, default_value_t = 0.5, value_parser = share)]
    pub(crate) t: f64,
    #[command(flatten)]
    pub(crate) mixed: Mixed,
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(share) if (0.0..=1.0).contains(&share) => Ok(share),
        _ => Err("a number from 0 to 1".to_owned()),
    }
}

#[derive(Debug, Args)]
#[command(
    after_help = "Taps and wall come from one texture, the models from another, friction from a \
third. Without --friction it comes from the one that is slid on.

Examples:
  asperity compose --tap anvil.asp --slide velvet.asp -o mixed.asp
  asperity compose --tap anvil.asp --slide velvet.asp --friction ice.asp -o mixed.asp"
)]
pub(crate) struct Compose {
    /// What tapping feels like (.asp, or FILE.aspl#NAME)
    #[arg(long, value_name = "FILE")]
    pub(crate) tap: String,
    /// What sliding feels like
    #[arg(long, value_name = "FILE")]
    pub(crate) slide: String,
    /// Where friction comes from
    #[arg(long, value_name = "FILE")]
    pub(crate) friction: Option<String>,
    #[command(flatten)]
    pub(crate) mixed: Mixed,
}

#[derive(Debug, Args)]
#[command(
    after_help = "A slider of 0 to 100 spans the materials of the model, from the 5 % that have the \
least of an attribute to the 5 % that have the most. Each option moves its attribute by as many \
steps, down if it is negative, and leaves the others where they are. What the model cannot reach \
is moved after decoding. --prompt says in words what changes from where the texture is: qualities \
with their degree, and things to be more like. The asset remembers every edit; --undo takes back \
the last one.

Examples:
  asperity edit sheet.asp --rougher 20 -o rougher.asp
  asperity edit sheet.asp --rougher 20 --harder -10 --slipperier 5 -o other.asp
  asperity edit sheet.asp --prompt \"less gritty, more waxy\" -o waxy.asp
  asperity edit sheet.asp --prompt \"a bit softer, more like leather\" -o soft.asp
  asperity edit other.asp --undo -o sheet-again.asp"
)]
pub(crate) struct Edit {
    /// The texture (.asp, or FILE.aspl#NAME)
    pub(crate) file: String,
    /// Steps of level of the vibration
    #[arg(long, value_name = "STEPS", value_parser = steps, allow_hyphen_values = true)]
    pub(crate) rougher: Option<f64>,
    /// Steps of spectral centroid of the vibration
    #[arg(long, value_name = "STEPS", value_parser = steps, allow_hyphen_values = true)]
    pub(crate) sharper: Option<f64>,
    /// Steps of spectral centroid of taps
    #[arg(long, value_name = "STEPS", value_parser = steps, allow_hyphen_values = true)]
    pub(crate) harder: Option<f64>,
    /// Steps of friction, less of it if positive
    #[arg(long, value_name = "STEPS", value_parser = steps, allow_hyphen_values = true)]
    pub(crate) slipperier: Option<f64>,
    /// What changes, in words, such as "less gritty, more waxy"
    #[arg(long, value_name = "TEXT", conflicts_with_all = ["rougher", "sharper", "harder", "slipperier"])]
    pub(crate) prompt: Option<String>,
    /// Take back the last edit
    #[arg(long, conflicts_with_all = ["rougher", "sharper", "harder", "slipperier", "prompt"])]
    pub(crate) undo: bool,
    #[command(flatten)]
    pub(crate) mixed: Mixed,
}

fn steps(text: &str) -> Result<f64, String> {
    let largest = asperity::edit::Sliders::LARGEST;
    match text.parse() {
        Ok(steps) if (-largest..=largest).contains(&steps) => Ok(steps),
        _ => Err(format!("a number from {} to {largest}", -largest)),
    }
}

#[derive(Debug, Args)]
#[command(
    after_help = "The encoder of the model places a recording among the materials that it was \
trained on, and the texture is decoded from there: what was not recorded is completed. Says how \
far the decoded spectra are from the recorded ones.

Examples:
  asperity import hatt Models_Cork.xml -o cork.asp
  asperity encode cork.asp -o cork-latent.asp
  asperity encode cork.asp --part slide -o slid.asp --json"
)]
pub(crate) struct Encode {
    /// The recording (.asp, or FILE.aspl#NAME)
    pub(crate) file: String,
    /// What of it is encoded [default: what was recorded; synthesised taps were not]
    #[arg(long, value_name = "whole|taps|slide")]
    pub(crate) part: Option<Part>,
    #[command(flatten)]
    pub(crate) mixed: Mixed,
}

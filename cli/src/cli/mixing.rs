//! Arguments of the commands that mix and edit in the latent.

use super::{Inference, PreviewOptions, ReportOptions, name};
use asperity::sources::latents::Part;
use clap::Args;
use std::path::PathBuf;

/// Where a mixed texture goes, and how.
#[derive(Debug, Args)]
pub(crate) struct Mixed {
    /// The asset to write (.asp); `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// Name of the texture, 1 to 64 bytes
    #[arg(long, value_parser = name)]
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
    after_help = "Each texture stores the latent it was decoded from. The new one is decoded from \
(1 − t)·a + t·b, with the fidelity and the rate of A.

Examples:
  asperity blend towel.asp whiteboard.asp -o between.asp
  asperity blend towel.asp whiteboard.asp -t 0.25 -o quarter.asp --name \"mostly towel\""
)]
pub(crate) struct Blend {
    /// The texture at t = 0 (.asp, or FILE.aspl#NAME)
    pub(crate) a: String,
    /// The texture at t = 1
    pub(crate) b: String,
    /// Position between A and B, 0 to 1
    #[arg(short, default_value_t = 0.5, value_parser = share)]
    pub(crate) t: f64,
    #[command(flatten)]
    pub(crate) mixed: Mixed,
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(share) if (0.0..=1.0).contains(&share) => Ok(share),
        _ => Err("must be a number from 0 to 1".to_owned()),
    }
}

#[derive(Debug, Args)]
#[command(
    after_help = "Taps and wall come from --tap, the AR models from --slide, and friction from \
--friction, or from --slide if --friction is not given.

Examples:
  asperity compose --tap anvil.asp --slide velvet.asp -o mixed.asp
  asperity compose --tap anvil.asp --slide velvet.asp --friction ice.asp -o mixed.asp"
)]
pub(crate) struct Compose {
    /// Texture that gives the taps (.asp, or FILE.aspl#NAME)
    #[arg(long, value_name = "FILE")]
    pub(crate) tap: String,
    /// Texture that gives the vibration of sliding
    #[arg(long, value_name = "FILE")]
    pub(crate) slide: String,
    /// Texture that gives the friction [default: that of --slide]
    #[arg(long, value_name = "FILE")]
    pub(crate) friction: Option<String>,
    #[command(flatten)]
    pub(crate) mixed: Mixed,
}

#[derive(Debug, Args)]
#[command(
    after_help = "The sliders run from 0 to 100, which are the 5th and the 95th percentile of that \
attribute over the materials of the model. Each option moves its attribute by this many steps, the \
other way if negative, and holds the others still. Changes that the model cannot reach are applied after \
decoding. --prompt describes the change in words: qualities with their degree, and materials to be \
more like. The asset stores every edit; --undo reverts the last one.

Examples:
  asperity edit sheet.asp --rougher 20 -o rougher.asp
  asperity edit sheet.asp --rougher 20 --softer 10 --slipperier 5 -o other.asp
  asperity edit sheet.asp --prompt \"less gritty, more waxy\" -o waxy.asp
  asperity edit sheet.asp --prompt \"a bit softer, more like leather\" -o soft.asp
  asperity edit other.asp --undo -o sheet-again.asp"
)]
pub(crate) struct Edit {
    /// The texture (.asp, or FILE.aspl#NAME)
    pub(crate) file: String,
    /// Raise the vibration level by this many steps
    #[arg(long, value_name = "STEPS", value_parser = steps, allow_hyphen_values = true)]
    pub(crate) rougher: Option<f64>,
    /// Lower the vibration level by this many steps
    #[arg(long, value_name = "STEPS", value_parser = steps, allow_hyphen_values = true, conflicts_with = "rougher")]
    pub(crate) smoother: Option<f64>,
    /// Raise the spectral centroid of the vibration by this many steps
    #[arg(long, value_name = "STEPS", value_parser = steps, allow_hyphen_values = true)]
    pub(crate) sharper: Option<f64>,
    /// Lower the spectral centroid of the vibration by this many steps
    #[arg(long, value_name = "STEPS", value_parser = steps, allow_hyphen_values = true, conflicts_with = "sharper")]
    pub(crate) duller: Option<f64>,
    /// Raise the spectral centroid of the taps by this many steps
    #[arg(long, value_name = "STEPS", value_parser = steps, allow_hyphen_values = true)]
    pub(crate) harder: Option<f64>,
    /// Lower the spectral centroid of the taps by this many steps
    #[arg(long, value_name = "STEPS", value_parser = steps, allow_hyphen_values = true, conflicts_with = "harder")]
    pub(crate) softer: Option<f64>,
    /// Lower the friction by this many steps
    #[arg(long, value_name = "STEPS", value_parser = steps, allow_hyphen_values = true)]
    pub(crate) slipperier: Option<f64>,
    /// Raise the friction by this many steps
    #[arg(long, value_name = "STEPS", value_parser = steps, allow_hyphen_values = true, conflicts_with = "slipperier")]
    pub(crate) stickier: Option<f64>,
    /// Describe the change in words, such as "less gritty, more waxy"
    #[arg(long, value_name = "TEXT", conflicts_with_all = SLIDERS)]
    pub(crate) prompt: Option<String>,
    /// Revert the last edit
    #[arg(long, conflicts_with = "prompt", conflicts_with_all = SLIDERS)]
    pub(crate) undo: bool,
    #[command(flatten)]
    pub(crate) mixed: Mixed,
}

/// The options that move sliders, both ways.
const SLIDERS: [&str; 8] = [
    "rougher",
    "smoother",
    "sharper",
    "duller",
    "harder",
    "softer",
    "slipperier",
    "stickier",
];

fn steps(text: &str) -> Result<f64, String> {
    let largest = asperity::sources::latents::Sliders::LARGEST;
    match text.parse() {
        Ok(steps) if (-largest..=largest).contains(&steps) => Ok(steps),
        _ => Err(format!("must be a number from {} to {largest}", -largest)),
    }
}

#[derive(Debug, Args)]
#[command(
    after_help = "The encoder of the model maps the recording to a latent, and the texture is \
decoded from it, which also fills in what was not recorded. The report gives the distance of the \
decoded spectra from the recorded ones.

Examples:
  asperity import hatt Models_Cork.xml -o cork.asp
  asperity encode cork.asp -o cork-latent.asp
  asperity encode cork.asp --part slide -o slid.asp --json"
)]
pub(crate) struct Encode {
    /// The recording (.asp, or FILE.aspl#NAME)
    pub(crate) file: String,
    /// Part to encode [default: what was recorded, which excludes synthesised taps]
    #[arg(long, value_name = "whole|taps|slide")]
    pub(crate) part: Option<Part>,
    #[command(flatten)]
    pub(crate) mixed: Mixed,
}

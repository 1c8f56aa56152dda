//! The command line: commands, arguments, help.

mod groups;
mod import;
mod interchange;
mod library;
mod mixing;
mod studio;
mod study;
mod views;

pub(crate) use groups::{PreviewOptions, ReportOptions};
pub(crate) use import::{
    Import, ImportHatt, ImportModel, ImportRecording, ImportSurface, MeasuredTexture, RecordCheck,
};
pub(crate) use interchange::{Export, ImportEffects};
pub(crate) use library::{Build, Diff, Extract, List, Merge, Rename, Split};
pub(crate) use mixing::{Blend, Compose, Edit, Encode, Mixed};
pub(crate) use studio::Studio;
pub(crate) use study::{CheckStudy, RunStudy, SimulateStudy, Study};
pub(crate) use views::{Inspect, Listen, Plot, Preview, Render};

use asperity::{
    learned::{inference::BackendName, text::TextEncoderChoice},
    library::check_name,
    passes::reduce::Fidelity,
    views::preview,
};
use asperity_console::manual::{Completions, Manual};
use clap::{Args, Parser, Subcommand};
use std::{ops::RangeInclusive, path::PathBuf};

#[derive(Debug, Parser)]
#[command(
    name = "asperity",
    version,
    about = "Compile prompts, recordings and models into haptic textures; inspect, edit and export them",
    after_help = "Examples:
  asperity compile \"rough abrasive sheet with gritty particles\" -o sandpaper.asp
  asperity builtin -o grit.asp
  asperity inspect grit.asp
  asperity plot grit.asp -o grit.png
  asperity import hatt Models_Cork.xml -o cork.asp
  asperity import model bench.json -o bench.asp
  asperity build library.toml -o library.aspl
  asperity edit sandpaper.asp --rougher 20 -o rougher.asp
  asperity record-check oak/
  asperity import recording oak/ -o oak.asp --plot oak.png
  asperity export grit.asp --to ahap -o grit.ahap
  asperity build desk.toml -o desk.aspl --target cortex-m4f@16MHz
  asperity studio

Give `-` as an output to write it to standard output; the report then goes to standard error. An
output must not be the same file as an input or as another output.

Exit status: 0 on success, 1 on failure, 2 on wrong usage."
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Print neither progress nor a report of what was written; requested results, --json and
    /// warnings are still printed
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Compile a prompt into a texture
    Compile(Compile),
    /// Build a library from a manifest, or pack the textures of a scene within a budget
    Build(Build),
    /// Merge libraries, such as shards that were built on several machines
    Merge(Merge),
    /// List the textures of a library
    List(List),
    /// Extract one texture from a library
    Extract(Extract),
    /// Rename a texture in a library or an asset
    Rename(Rename),
    /// Split a library into one asset per texture, or into several smaller libraries
    Split(Split),
    /// Show what changed between two libraries, or two assets
    Diff(Diff),
    /// Interpolate between two textures
    Blend(Blend),
    /// Combine the taps of one texture, the vibration of another and the friction of a third
    Compose(Compose),
    /// Make a texture rougher, sharper, harder or more slippery
    Edit(Edit),
    /// Encode a recorded texture with the learned model, so that it can be blended and edited
    Encode(Encode),
    /// Export a texture or a library to another tool's format, and report what is lost
    Export(Export),
    /// Import recordings, HaTT materials, effects of other tools, and your own models
    #[command(subcommand)]
    Import(Import),
    /// Check a recording: one verdict per channel, and a remedy for every problem
    RecordCheck(RecordCheck),
    /// Write the built-in synthetic texture
    Builtin(Builtin),
    /// Show everything in an asset or a library
    Inspect(Inspect),
    /// Draw a texture on one sheet: poles, spectra, taps, grid, friction
    Plot(Plot),
    /// Write the preview picture of a texture, and its height and normal maps if requested
    Preview(Preview),
    /// Render strokes and taps to a WAV file, so that you can hear them
    Listen(Listen),
    /// Render a trajectory offline, with the runtime itself
    Render(Render),
    /// Open the studio: a page to type prompts, see surfaces, stroke and hear them
    Studio(Studio),
    /// Check, run or simulate a study, in which people rate textures
    #[command(subcommand)]
    Study(Study),
    /// Show which encoders, models and back ends are available, and how to get the others
    Doctor(Doctor),
    /// Print what a shell needs to complete arguments
    #[command(after_help = "Example:
  asperity completions bash > ~/.local/share/bash-completion/completions/asperity")]
    Completions(Completions),
    /// Write manual pages
    #[command(after_help = "Example:
  asperity manual -o ~/.local/share/man/man1")]
    Manual(Manual),
}

#[derive(Debug, Args)]
#[command(
    after_help = "A frozen text encoder reads the prompt, and a learned model places it among \
the materials it was trained on and decodes it into a texture. The texture is then reduced, \
verified with the runtime itself, and written. With the portable back end, the same prompt, \
options and version give the same bytes on every machine.

Examples:
  asperity compile \"rough abrasive sheet with gritty particles\" -o sandpaper.asp --plot sandpaper.png
  asperity compile \"wet ice\" -o ice.asp --no-preview --json
  asperity compile \"cork\" -o cork.asp --fidelity 8 --seed 3
  asperity compile \"felt\" -o felt.asp --text-encoder clip:./clip --model ./clip-model
  asperity compile \"felt\" -o felt.asp --emit-model felt.json --timings"
)]
pub(crate) struct Compile {
    /// Description of the surface: what it feels or looks like, is made of, or is used for
    pub(crate) prompt: String,
    /// The asset to write; `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// Name of the texture, 1 to 64 bytes [default: the prompt, shortened]
    #[arg(long, value_parser = name)]
    pub(crate) name: Option<String>,
    /// Seed: 0 gives the texture that the prompt describes, other values give variations of it
    #[arg(long, default_value_t = 0)]
    pub(crate) seed: u64,
    /// Model detail to keep: everything, as little as stays within 0.5 dB, or this AR order
    #[arg(long, default_value = "auto", value_name = "full|auto|ORDER")]
    pub(crate) fidelity: Fidelity,
    /// Sample rate of the AR models, Hz; use the rate of your servo loop
    #[arg(long, value_name = "HZ")]
    pub(crate) rate: Option<f64>,
    #[command(flatten)]
    pub(crate) inference: Inference,
    #[command(flatten)]
    pub(crate) preview: PreviewOptions,
    /// Draw the picture with Stable Diffusion, from this ONNX folder (see docs/preview.md)
    #[arg(long, value_name = "DIR", conflicts_with = "no_preview")]
    pub(crate) diffusion: Option<PathBuf>,
    /// Draw the texture on one sheet, as `asperity plot` does
    #[arg(long, value_name = "FILE.png")]
    pub(crate) plot: Option<PathBuf>,
    /// Also write the unreduced texture as JSON, which `asperity import model` reads
    #[arg(long, value_name = "FILE.json")]
    pub(crate) emit_model: Option<PathBuf>,
    /// Explain how each word was read, and how far it moved each attribute
    #[arg(long)]
    pub(crate) explain: bool,
    #[command(flatten)]
    pub(crate) reporting: ReportOptions,
}

fn pixels(text: &str) -> Result<u32, String> {
    let sizes = preview::SIZES;
    match text.parse() {
        Ok(pixels) if sizes.contains(&pixels) => Ok(pixels),
        _ => Err(format!(
            "must be {} to {} pixels",
            sizes.start(),
            sizes.end()
        )),
    }
}

/// A name that an asset can hold.
fn name(text: &str) -> Result<String, String> {
    check_name(text)
        .map(|()| text.to_owned())
        .map_err(|fault| fault.to_string())
}

/// A number between two, for options that state a quantity.
fn within(text: &str, range: &RangeInclusive<f32>) -> Result<f32, String> {
    match text.parse() {
        Ok(value) if range.contains(&value) => Ok(value),
        _ => Err(format!(
            "must be a number from {} to {}",
            range.start(),
            range.end()
        )),
    }
}

/// Where networks come from and where they run.
#[derive(Debug, Clone, Args)]
pub(crate) struct Inference {
    /// Text encoder: the embedded `minilm`, or `clip:DIR` for an exported text tower of CLIP
    #[arg(long, default_value = "minilm", value_name = "minilm|clip:DIR")]
    pub(crate) text_encoder: TextEncoderChoice,
    /// Model folder written by `asperity-train fit` [default: the embedded model]
    #[arg(long, value_name = "DIR")]
    pub(crate) model: Option<PathBuf>,
    /// Inference back end: `portable`, which gives the same bits everywhere, or `onnxruntime`
    #[arg(long, default_value_t, value_name = "portable|onnxruntime")]
    pub(crate) backend: BackendName,
}

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  asperity doctor --text-encoder clip:./clip")]
pub(crate) struct Doctor {
    #[command(flatten)]
    pub(crate) inference: Inference,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  asperity builtin -o grit.asp
  asperity builtin -o grit.asp --emit-model grit.json")]
pub(crate) struct Builtin {
    /// The asset to write; `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// Also write the unreduced texture as JSON, which `asperity import model` reads
    #[arg(long, value_name = "FILE.json")]
    pub(crate) emit_model: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) reporting: ReportOptions,
}

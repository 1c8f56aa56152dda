//! Arguments of the commands that make libraries and take them apart.

use super::{Inference, PreviewOptions, ReportOptions};
use asperity::{learned::Certainty, library::Shard, scene::Target};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(
    after_help = "A manifest is a TOML file with [defaults], include = [...] and [[texture]] entries \
(name and one of prompt, import, asset, blend, compose, and options of its own), a CSV file whose \
header names the same keys, or JSON lines. What was made before is taken from a cache: an \
interrupted build goes on where it stopped. Textures are made in parallel; the bytes do not depend \
on order, threads, cache or parts. FILE.lock pins model and versions.

A scene is a TOML manifest with servo_rate_hz and [[surface]] entries (texture and one of plane, \
sphere, box). Only textures that a surface wears are packed, each once. A target limits the \
instructions of a tick, a clock by a share of its period at one instruction a clock. Within a \
budget, textures have no preview, and each has the fidelity that the budget allows, unless the \
manifest states it: it is lowered where that costs the least error.

Examples:
  asperity build library.toml -o library.aspl
  asperity build prompts.csv -o prompts.aspl --json
  asperity build prompts.csv -o prompts.aspl --min-certainty close
  asperity build library.toml -o small.aspl --preview-size 128
  asperity build library.toml --check
  asperity build received/list.toml --confined -o received.aspl
  asperity build library.toml -o part1.aspl --shard 1/4 --locked
  asperity build desk.toml -o desk.aspl --target cortex-m4f@48MHz --share 5
  asperity build desk.toml -o desk.aspl --target 2500 --budget-bytes 8192 --json"
)]
pub(crate) struct Build {
    /// The manifest (.toml, .csv, .jsonl) or the scene (.toml)
    #[arg(value_name = "MANIFEST")]
    pub(crate) scene: PathBuf,
    /// The library to write (.aspl); `-` is standard output
    #[arg(short, long, required_unless_present = "check")]
    pub(crate) output: Option<PathBuf>,
    /// Check the manifest and all that it names, and build nothing
    #[arg(long, conflicts_with_all = ["output", "shard"])]
    pub(crate) check: bool,
    /// Build one part of several, such as 1/4; `asperity merge` joins them
    #[arg(long, value_name = "i/n")]
    pub(crate) shard: Option<Shard>,
    /// Folder that keeps textures between builds [default: ASPERITY_CACHE, or the user's cache]
    #[arg(long, value_name = "DIR")]
    pub(crate) cache: Option<PathBuf>,
    /// Make every texture, and keep none
    #[arg(long, conflicts_with = "cache")]
    pub(crate) no_cache: bool,
    /// Refuse a model or a version that the lock file does not pin
    #[arg(long)]
    pub(crate) locked: bool,
    /// Refuse prompts that are less certain: known, close (to what is known), guess
    #[arg(long, value_name = "known|close|guess", value_parser = certainty)]
    pub(crate) min_certainty: Option<Certainty>,
    /// For a list that others sent: refuse every path that leaves the manifest's folder
    #[arg(long)]
    pub(crate) confined: bool,
    #[command(flatten)]
    pub(crate) preview: PreviewOptions,
    /// Scenes: where a tick has to fit, a processor and its clock, or a number of instructions
    #[arg(long, value_name = "cortex-m4f@168MHz|INSTRUCTIONS")]
    pub(crate) target: Option<Target>,
    /// Scenes: percent of the target's clocks that a tick may take
    #[arg(long, default_value_t = 100.0 * asperity::scene::DEFAULT_SHARE, value_name = "PERCENT", value_parser = percent, requires = "target")]
    pub(crate) share: f64,
    /// Scenes: bytes that the library may take
    #[arg(long, value_name = "N")]
    pub(crate) budget_bytes: Option<u64>,
    #[command(flatten)]
    pub(crate) inference: Inference,
    #[command(flatten)]
    pub(crate) reporting: ReportOptions,
}

fn certainty(text: &str) -> Result<Certainty, String> {
    text.parse()
        .map_err(|()| "known, close or guess".to_owned())
}

fn percent(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(percent) if percent > 0.0 && percent <= 100.0 => Ok(percent),
        _ => Err("above 0, at most 100".to_owned()),
    }
}

#[derive(Debug, Args)]
#[command(
    after_help = "The parts of a manifest, built with --shard, give the bytes of one build. A \
texture may be in several libraries if it is the same in all.

Examples:
  asperity merge part1.aspl part2.aspl -o library.aspl
  asperity merge parts/*.aspl -o - | asperity list -"
)]
pub(crate) struct Merge {
    /// The libraries (.aspl) or assets (.asp)
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// The library to write (.aspl); `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  asperity list library.aspl
  asperity list library.aspl --json")]
pub(crate) struct List {
    /// A library (.aspl) or an asset (.asp); `-` is standard input
    pub(crate) file: PathBuf,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  asperity extract library.aspl cork -o cork.asp
  asperity extract library.aspl 0 -o - | asperity inspect -")]
pub(crate) struct Extract {
    /// A library (.aspl); `-` is standard input
    pub(crate) file: PathBuf,
    /// The texture, by name or index from 0
    #[arg(value_name = "NAME|INDEX")]
    pub(crate) texture: String,
    /// The asset to write (.asp); `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
}

#[derive(Debug, Args)]
#[command(after_help = "Example:
  asperity rename library.aspl cork \"natural cork\" -o renamed.aspl")]
pub(crate) struct Rename {
    /// A library (.aspl) or an asset (.asp); `-` is standard input
    pub(crate) file: PathBuf,
    /// The texture, by name or index from 0
    #[arg(value_name = "NAME|INDEX")]
    pub(crate) texture: String,
    /// Its new name
    pub(crate) name: String,
    /// The library or asset to write; `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  asperity split library.aspl -o assets
  asperity split library.aspl -o parts --into 4")]
pub(crate) struct Split {
    /// A library (.aspl); `-` is standard input
    pub(crate) file: PathBuf,
    /// The folder to write into
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    /// Write this number of libraries instead of an asset a texture
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=9999))]
    pub(crate) into: Option<u32>,
}

#[derive(Debug, Args)]
#[command(
    after_help = "One line a texture that changed: how far apart the spectra are, and forces, \
friction and picture where they differ. Two assets are compared whatever their names.

Exit status: 0 if nothing changed, 1 if something did or the comparison failed, 2 wrong usage.

Examples:
  asperity diff old.aspl new.aspl
  asperity diff old.aspl new.aspl --within 0.5
  asperity diff cork.asp edited.asp --json"
)]
pub(crate) struct Diff {
    /// The old library (.aspl) or asset (.asp)
    pub(crate) old: PathBuf,
    /// The new one
    pub(crate) new: PathBuf,
    /// Exit with 0 also if all that changed are spectra, by this many dB at worst
    #[arg(long, value_name = "DB")]
    pub(crate) within: Option<f64>,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

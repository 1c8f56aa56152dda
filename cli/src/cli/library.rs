//! Arguments of the commands that make libraries and take them apart.

use super::{Inference, PreviewOptions, ReportOptions};
use asperity::{learned::Certainty, library::Shard, scene::Target};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(
    after_help = "A manifest is a TOML file with [defaults], include = [...] and [[texture]] entries \
(a name, one of prompt, import, asset, blend and compose, and options for this texture), a CSV file \
whose header names the same keys, or JSON lines. Compiled textures are cached, so an interrupted \
build resumes where it stopped. Textures are compiled in parallel; the bytes do not depend on \
order, threads, cache or shards. FILE.lock pins the model and the versions.

A scene is a TOML manifest with servo_rate_hz and [[surface]] entries (a texture and one of plane, \
sphere and box). Only textures used by a surface are packed, each of them once. --target limits the \
instructions per tick, either to a number or to a share of the clock cycles of a period, counted \
as one instruction per cycle. Within a budget, textures have no preview, and fidelity is reduced \
where that costs the least error, except for textures whose fidelity the manifest gives.

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
    /// Check the manifest and the files it names, without building anything
    #[arg(long, conflicts_with_all = ["output", "shard"])]
    pub(crate) check: bool,
    /// Build one shard of several, such as 1/4; join them with `asperity merge`
    #[arg(long, value_name = "i/n")]
    pub(crate) shard: Option<Shard>,
    /// Folder of the texture cache [default: $ASPERITY_CACHE, or the user's cache folder]
    #[arg(long, value_name = "DIR")]
    pub(crate) cache: Option<PathBuf>,
    /// Compile every texture afresh, and cache none
    #[arg(long, conflicts_with = "cache")]
    pub(crate) no_cache: bool,
    /// Fail if the model or a version differs from the lock file
    #[arg(long)]
    pub(crate) locked: bool,
    /// Fail for prompts that are less certain than this: known, close (to something known) or guess
    #[arg(long, value_name = "known|close|guess", value_parser = certainty)]
    pub(crate) min_certainty: Option<Certainty>,
    /// For untrusted manifests: refuse every path outside the manifest's folder
    #[arg(long)]
    pub(crate) confined: bool,
    #[command(flatten)]
    pub(crate) preview: PreviewOptions,
    /// Scenes: what a tick must fit into, a processor and its clock or a number of instructions
    #[arg(long, value_name = "cortex-m4f@168MHz|INSTRUCTIONS")]
    pub(crate) target: Option<Target>,
    /// Scenes: percentage of the target's clock cycles that a tick may use
    #[arg(long, default_value_t = 100.0 * asperity::scene::DEFAULT_SHARE, value_name = "PERCENT", value_parser = percent, requires = "target")]
    pub(crate) share: f64,
    /// Scenes: largest size of the library, bytes
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
        _ => Err("must be a percentage above 0 and at most 100".to_owned()),
    }
}

#[derive(Debug, Args)]
#[command(
    after_help = "Merging all shards of a manifest, built with --shard, gives the same bytes as \
one build. A texture may be in several of the libraries if it is identical in all of them.

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
    /// Write this number of libraries instead of one asset per texture
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=9999))]
    pub(crate) into: Option<u32>,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Prints one line per changed texture: the distance of the spectra, and forces, \
friction and picture if they differ. Two assets are compared even if their names differ.

Exit status: 0 if nothing changed, 1 if something did or the comparison failed, 2 on wrong usage.

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
    /// Also exit with 0 if only spectra changed, by at most this many dB
    #[arg(long, value_name = "DB")]
    pub(crate) within: Option<f64>,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

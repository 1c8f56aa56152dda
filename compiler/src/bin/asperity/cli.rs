//! The command line: commands, arguments, help.

use asperity::{inference::BackendName, reduce::Fidelity, scene::Target, text::TextEncoderChoice};
use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;

#[derive(Debug, Parser)]
#[command(
    name = "asperity",
    version,
    about = "Haptic textures: from a prompt or a recording to an asset, and back to the eye",
    after_help = "Examples:
  asperity compile \"rough abrasive sheet with gritty particles\" -o sandpaper.asp
  asperity builtin -o grit.asp
  asperity inspect grit.asp
  asperity plot grit.asp -o grit.png
  asperity import hatt Models_Cork.xml -o cork.asp
  asperity import model bench.json -o bench.asp
  asperity record-check oak/
  asperity import recording oak/ -o oak.asp --plot oak.png
  asperity build desk.toml -o desk.aspl --target cortex-m4f@16MHz

A file that is written to `-` goes to standard output, and the report then to standard error. An
output that is also an input, or another output, is refused.

Exit status: 0 success, 1 failure, 2 wrong usage."
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Show no progress; results and warnings are printed all the same
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Make a texture of a prompt
    Compile(Compile),
    /// Pack what a scene touches, within a budget
    Build(Build),
    /// Import recorded textures, and models of one's own
    #[command(subcommand)]
    Import(Import),
    /// Check a recording: a verdict for each channel, and what to do about it
    RecordCheck(RecordCheck),
    /// Write the built-in synthetic texture
    Builtin(Builtin),
    /// Show everything in an asset or a library
    Inspect(Inspect),
    /// Draw a texture on one sheet: poles, spectra, taps, grid, friction
    Plot(Plot),
    /// Run a trajectory through the runtime, offline
    Render(Render),
    /// Show which encoders, models and back ends were found
    Doctor(Doctor),
}

#[derive(Debug, Args)]
#[command(
    after_help = "The prompt is read by a frozen text encoder, placed among the materials a \
model was trained on, decoded, reduced, verified by the runtime itself and written. The same \
prompt, options and version give the same bytes on any machine with the portable back end.

Examples:
  asperity compile \"rough abrasive sheet with gritty particles\" -o sandpaper.asp --plot sandpaper.png
  asperity compile \"wet ice\" -o ice.asp --no-preview --json
  asperity compile \"cork\" -o cork.asp --fidelity 8 --seed 3
  asperity compile \"felt\" -o felt.asp --text-encoder clip:./clip --model ./clip-model
  asperity compile \"felt\" -o felt.asp --emit-model felt.json --timings"
)]
pub(crate) struct Compile {
    /// What the surface feels like, looks like, is made of or is for
    pub(crate) prompt: String,
    /// The asset to write; `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// 0 for the texture that the prompt means, others for variations of it
    #[arg(long, default_value_t = 0)]
    pub(crate) seed: u64,
    /// How much of the texture is kept: all, the least within 0.5 dB, or an AR order
    #[arg(long, default_value = "auto", value_name = "full|auto|ORDER")]
    pub(crate) fidelity: Fidelity,
    /// Rate of the AR models, Hz: that of the servo loop
    #[arg(long, value_name = "HZ")]
    pub(crate) rate: Option<f64>,
    #[command(flatten)]
    pub(crate) inference: Inference,
    /// Draw no preview
    #[arg(long)]
    pub(crate) no_preview: bool,
    /// Draw the texture on one sheet, as `asperity plot` does
    #[arg(long, value_name = "FILE.png")]
    pub(crate) plot: Option<PathBuf>,
    /// Write the texture before its reduction as JSON, for `asperity import model`
    #[arg(long, value_name = "FILE.json")]
    pub(crate) emit_model: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Print on standard error how long each pass took
    #[arg(long)]
    pub(crate) timings: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "A scene is a TOML file of [[texture]] entries (name and one of prompt, import, \
asset) and [[surface]] entries (texture and one of plane, sphere, box). Only textures that a \
surface wears are packed, each once, in full where nothing limits them. A target limits the \
instructions of a tick, a clock by a share of its period at one instruction a clock. Where a \
budget is too small, fidelity is lowered where that costs the least error.

Examples:
  asperity build desk.toml -o desk.aspl
  asperity build desk.toml -o desk.aspl --target cortex-m4f@48MHz --share 5
  asperity build desk.toml -o desk.aspl --target 2500 --budget-bytes 8192 --json"
)]
pub(crate) struct Build {
    /// The scene (.toml)
    pub(crate) scene: PathBuf,
    /// The library to write (.aspl); `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// Where a tick has to fit: a processor and its clock, or a number of instructions
    #[arg(long, value_name = "cortex-m4f@168MHz|INSTRUCTIONS")]
    pub(crate) target: Option<Target>,
    /// Percent of the target's clocks that a tick may take
    #[arg(long, default_value_t = 100.0 * asperity::scene::DEFAULT_SHARE, value_name = "PERCENT", value_parser = percent, requires = "target")]
    pub(crate) share: f64,
    /// Bytes that the library may take
    #[arg(long, value_name = "N")]
    pub(crate) budget_bytes: Option<u64>,
    #[command(flatten)]
    pub(crate) inference: Inference,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Print on standard error how long each pass took
    #[arg(long)]
    pub(crate) timings: bool,
}

fn percent(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(percent) if percent > 0.0 && percent <= 100.0 => Ok(percent),
        _ => Err("above 0, at most 100".to_owned()),
    }
}

/// Where networks come from and where they run.
#[derive(Debug, Args)]
pub(crate) struct Inference {
    /// `minilm`, embedded, or `clip:DIR` with an export of CLIP's text tower
    #[arg(long, default_value = "minilm", value_name = "minilm|clip:DIR")]
    pub(crate) text_encoder: TextEncoderChoice,
    /// A model folder that `asperity-train fit` wrote, instead of the embedded one
    #[arg(long, value_name = "DIR")]
    pub(crate) model: Option<PathBuf>,
    /// `portable`, the same bits everywhere, or `onnxruntime` where it is installed
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

#[derive(Debug, Subcommand)]
pub(crate) enum Import {
    /// Import materials of the Penn Haptic Texture Toolkit
    Hatt(ImportHatt),
    /// Import a model of one's own, or one that --emit-model wrote
    Model(ImportModel),
    /// Make a texture of a recording: acceleration, force and motion of a tool on a surface
    Recording(ImportRecording),
}

#[derive(Debug, Args)]
#[command(
    after_help = "A recording is a folder with recording.toml and CSV, WAV or NumPy files; \
docs/recording.md lists every key. The check aligns the files and looks for clipping, drop-outs, \
impossible values, clock drift, delays, hum and wrong units. A folder without recording.toml gets \
a proposal from the files' headers. Exit status 1 if a fault was found.

Examples:
  asperity record-check oak/
  asperity record-check oak/ --json"
)]
pub(crate) struct RecordCheck {
    /// The folder
    pub(crate) folder: PathBuf,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "The recording is checked and aligned, cut into segments of steady speed and \
force, and fitted by AR models on a grid of speed and force; friction and taps are measured. \
Vertices, order and smoothing are those that predict held-out segments best. What was not recorded \
is completed by the learned model, and the report says so. docs/recording.md explains every step.

Examples:
  asperity import recording oak/ -o oak.asp
  asperity import recording oak/ -o oak.asp --plot oak.png --report oak.json
  asperity import recording oak/ -o oak.asp --fidelity full --emit-model oak-model.json"
)]
pub(crate) struct ImportRecording {
    /// The folder
    pub(crate) folder: PathBuf,
    /// The asset to write; `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// How much of the models is kept: all, the least within 0.5 dB, or an AR order
    #[arg(long, default_value = "auto", value_name = "full|auto|ORDER")]
    pub(crate) fidelity: Fidelity,
    /// Rate of the AR models, Hz: that of the servo loop [default: 1000]
    #[arg(long, value_name = "HZ")]
    pub(crate) rate: Option<f64>,
    /// Import in spite of faults that the check found
    #[arg(long)]
    pub(crate) force: bool,
    /// A model folder that `asperity-train fit` wrote, instead of the embedded one
    #[arg(long, value_name = "DIR")]
    pub(crate) model: Option<PathBuf>,
    /// Draw no preview
    #[arg(long)]
    pub(crate) no_preview: bool,
    /// Draw all steps on one sheet
    #[arg(long, value_name = "FILE.png")]
    pub(crate) plot: Option<PathBuf>,
    /// Write the report of all steps as JSON
    #[arg(long, value_name = "FILE.json")]
    pub(crate) report: Option<PathBuf>,
    /// Write the texture before its reduction as JSON, for `asperity import model`
    #[arg(long, value_name = "FILE.json")]
    pub(crate) emit_model: Option<PathBuf>,
    /// Print the report as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Print on standard error how long each step took
    #[arg(long)]
    pub(crate) timings: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Prints one line of figures a material: the RMS distance of its log \
spectra from the source over 10–450 Hz, level included, and its size. In full, every vertex \
and triangle is kept; `auto` keeps the smallest order and numerator, the fewest vertices and \
the shortest taps within 0.5 dB at 95 % of the grid and 1 dB at worst. HaTT holds no tapping traces: they are synthesised, or decoded by the \
learned model from the AR grid with --complete-taps, and marked so.

Examples:
  asperity import hatt Models_Cork.xml -o cork.asp
  asperity import hatt Models_Cork.xml -o cork.asp --complete-taps
  asperity import hatt hatt/models -o assets
  asperity import hatt hatt/models -o hatt.aspl --fidelity auto"
)]
pub(crate) struct ImportHatt {
    /// One `Models_<name>.xml`, or a folder of them
    pub(crate) input: PathBuf,
    /// One asset (.asp), a folder for one asset a material, or a library (.aspl); `-` is standard
    /// output, for an asset of a file or a library of a folder
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// How much of the source is kept: all, the least within 0.5 dB, or an AR order
    #[arg(long, default_value = "full", value_name = "full|auto|ORDER")]
    pub(crate) fidelity: Fidelity,
    /// Let the learned model decode taps from the AR grid
    #[arg(long)]
    pub(crate) complete_taps: bool,
    /// A model folder that `asperity-train fit` wrote, instead of the embedded one
    #[arg(long, value_name = "DIR", requires = "complete_taps")]
    pub(crate) model: Option<PathBuf>,
    /// Write the texture before its reduction as JSON; takes a single material
    #[arg(long, value_name = "FILE.json")]
    pub(crate) emit_model: Option<PathBuf>,
    /// Print on standard error how long each pass took
    #[arg(long)]
    pub(crate) timings: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "The file states AR or ARMA models over speed and force, and may state taps, \
wall, gains and where they come from; docs/model.md lists every key. It goes the way of every \
other texture: reduced, verified by the runtime itself and written. Prints the distance of the \
log spectra from the file over 10–450 Hz, level included, and the size.

Examples:
  asperity import model bench.json -o bench.asp
  asperity import model bench.json -o bench.asp --fidelity auto --json
  asperity builtin -o grit.asp --emit-model grit.json
  asperity import model grit.json -o again.asp --no-preview"
)]
pub(crate) struct ImportModel {
    /// The model (.json)
    pub(crate) input: PathBuf,
    /// The asset to write; `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// How much of the model is kept: all, the least within 0.5 dB, or an AR order
    #[arg(long, default_value = "full", value_name = "full|auto|ORDER")]
    pub(crate) fidelity: Fidelity,
    /// Rate of the AR models, Hz: that of the servo loop [default: the file's]
    #[arg(long, value_name = "HZ")]
    pub(crate) rate: Option<f64>,
    /// Draw no preview
    #[arg(long)]
    pub(crate) no_preview: bool,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Print on standard error how long each pass took
    #[arg(long)]
    pub(crate) timings: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  asperity builtin -o grit.asp
  asperity builtin -o grit.asp --emit-model grit.json")]
pub(crate) struct Builtin {
    /// The asset to write; `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// Write the texture before its reduction as JSON, for `asperity import model`
    #[arg(long, value_name = "FILE.json")]
    pub(crate) emit_model: Option<PathBuf>,
    /// Print on standard error how long each pass took
    #[arg(long)]
    pub(crate) timings: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Every checksum is verified, of a library those of all textures. With \
--json, an asset is one object; a library is {format_version, textures: [object, …]} in order \
of name.

Examples:
  asperity inspect grit.asp
  asperity inspect grit.asp --json
  asperity inspect hatt.aspl
  asperity inspect hatt.aspl --texture Cork --json"
)]
pub(crate) struct Inspect {
    /// An asset (.asp) or a library (.aspl); `-` is standard input
    pub(crate) file: PathBuf,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// One texture of a library, by name or index from 0; the others are not read
    #[arg(long, value_name = "NAME|INDEX")]
    pub(crate) texture: Option<String>,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  asperity plot grit.asp -o grit.png
  asperity plot hatt.aspl --texture Cork -o cork.png
  asperity builtin -o - | asperity plot - -o grit.png")]
pub(crate) struct Plot {
    /// An asset (.asp) or a library (.aspl); `-` is standard input
    pub(crate) file: PathBuf,
    /// The PNG to write; `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// One texture of a library, by name or index from 0
    #[arg(long, value_name = "NAME|INDEX")]
    pub(crate) texture: Option<String>,
}

#[derive(Debug, Args)]
#[command(
    after_help = "The trajectory has the header t_s,x_mm,y_mm,z_mm and one row a tick at \
the texture's rate. The surface is the infinite plane z = 0, contact where z < 0; a library \
with a scene is rendered on the scene's surfaces, and a last column says which one is touched. \
The same file, trajectory and seed give the same bytes.

Examples:
  asperity render grit.asp --trajectory stroke.csv -o felt.csv --seed 1
  asperity render hatt.aspl --texture Cork --trajectory stroke.csv -o felt.csv
  asperity render desk.aspl --trajectory stroke.csv -o felt.csv"
)]
pub(crate) struct Render {
    /// An asset (.asp) or a library (.aspl); `-` is standard input
    pub(crate) file: PathBuf,
    /// The trajectory, CSV
    #[arg(long, value_name = "IN.csv")]
    pub(crate) trajectory: PathBuf,
    /// The result, CSV; `-` is standard output
    #[arg(short, long, value_name = "OUT.csv")]
    pub(crate) output: PathBuf,
    /// Seed of the excitation
    #[arg(long, default_value_t = 0)]
    pub(crate) seed: u64,
    /// Rate of the servo loop, 1 to 20 times that of the texture [default: the texture's]
    #[arg(long, value_name = "HZ")]
    pub(crate) rate: Option<f32>,
    /// One texture of a library, by name or index from 0
    #[arg(long, value_name = "NAME|INDEX")]
    pub(crate) texture: Option<String>,
}

//! The command line: commands, arguments, help.

mod diffusion;
mod groups;
mod interchange;
mod library;
mod mixing;

pub(crate) use diffusion::Diffusion;
pub(crate) use groups::{PreviewOptions, ReportOptions};
pub(crate) use interchange::{Export, ImportEffects};
pub(crate) use library::{Build, Diff, Extract, List, Merge, Rename, Split};
pub(crate) use mixing::{Blend, Compose, Edit, Encode, Mixed};

use asperity::{inference::BackendName, preview, reduce::Fidelity, text::TextEncoderChoice};
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
  asperity build library.toml -o library.aspl
  asperity edit sandpaper.asp --rougher 20 -o rougher.asp
  asperity record-check oak/
  asperity import recording oak/ -o oak.asp --plot oak.png
  asperity export grit.asp --to ahap -o grit.ahap
  asperity build desk.toml -o desk.aspl --target cortex-m4f@16MHz

A file that is written to `-` goes to standard output, and the report then to standard error. An
output that is also an input, or another output, is refused.

Exit status: 0 success, 1 failure, 2 wrong usage."
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Show no progress and no report of what was written; what was asked for, --json and warnings
    /// are printed all the same
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Compile a prompt into a texture
    Compile(Compile),
    /// Build a library from a manifest, or pack what a scene touches, within a budget
    Build(Build),
    /// Join libraries, such as the parts that several machines built
    Merge(Merge),
    /// List the textures of a library
    List(List),
    /// Take one texture out of a library
    Extract(Extract),
    /// Give a texture of a library another name
    Rename(Rename),
    /// Write every texture of a library to a file of its own
    Split(Split),
    /// Show what changed between two libraries, or two assets
    Diff(Diff),
    /// Make a texture between two others
    Blend(Blend),
    /// Make a texture that taps like one, slides like another and is as slippery as a third
    Compose(Compose),
    /// Make a texture rougher, sharper, harder or more slippery
    Edit(Edit),
    /// Compile the latent of a recording into a texture, so that it can be mixed and edited
    Encode(Encode),
    /// Write a texture or a library in another tool's format, and say what that loses
    Export(Export),
    /// Import recorded textures, other tools' effects, and models of one's own
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
    /// Show what a texture looks like: its picture, height map and normal map
    Preview(Preview),
    /// Hear strokes and taps as the runtime renders them
    Listen(Listen),
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
#[command(mut_arg("no_preview", |no_preview| no_preview.conflicts_with("diffusion")))]
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
    #[command(flatten)]
    pub(crate) preview: PreviewOptions,
    #[command(flatten)]
    pub(crate) diffusion: Diffusion,
    /// Draw the texture on one sheet, as `asperity plot` does
    #[arg(long, value_name = "FILE.png")]
    pub(crate) plot: Option<PathBuf>,
    /// Write the texture before its reduction as JSON, for `asperity import model`
    #[arg(long, value_name = "FILE.json")]
    pub(crate) emit_model: Option<PathBuf>,
    /// Explain what every word was taken for, and which words moved which attribute
    #[arg(long)]
    pub(crate) explain: bool,
    /// Report attributes in their units, gains, and what the passes did as well
    #[arg(long)]
    pub(crate) details: bool,
    #[command(flatten)]
    pub(crate) reporting: ReportOptions,
}

fn pixels(text: &str) -> Result<u32, String> {
    let sizes = preview::SIZES;
    match text.parse() {
        Ok(pixels) if sizes.contains(&pixels) => Ok(pixels),
        _ => Err(format!("{} to {} pixels", sizes.start(), sizes.end())),
    }
}

/// A number between two, for options that state a quantity.
fn within(text: &str, low: f32, high: f32) -> Result<f32, String> {
    match text.parse() {
        Ok(value) if (low..=high).contains(&value) => Ok(value),
        _ => Err(format!("{low} to {high}")),
    }
}

/// Where networks come from and where they run.
#[derive(Debug, Clone, Args)]
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
    /// Compile a recording into a texture: acceleration, force and motion of a tool on a surface
    Recording(ImportRecording),
    /// Compile a NiceVibrations `.haptic` file into a texture
    Haptic(ImportEffects),
    /// Compile an Apple Haptic and Audio Pattern into a texture
    Ahap(ImportEffects),
    /// Compile an HJIF file (MPEG haptics) into a texture
    Hjif(ImportEffects),
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
    #[command(flatten)]
    pub(crate) preview: PreviewOptions,
    /// Draw all steps on one sheet
    #[arg(long, value_name = "FILE.png")]
    pub(crate) plot: Option<PathBuf>,
    /// Write the report of all steps as JSON
    #[arg(long, value_name = "FILE.json")]
    pub(crate) report: Option<PathBuf>,
    /// Write the texture before its reduction as JSON, for `asperity import model`
    #[arg(long, value_name = "FILE.json")]
    pub(crate) emit_model: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) reporting: ReportOptions,
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
    #[command(flatten)]
    pub(crate) preview: PreviewOptions,
    #[command(flatten)]
    pub(crate) reporting: ReportOptions,
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

#[derive(Debug, Args)]
#[command(
    after_help = "Without an option, the picture that the asset holds is written as it is. With \
--redraw, --size, --height or --normal, or where the asset holds none, pictures are drawn anew in \
all their colours from what the asset says: prompt or name, seed, nearest materials, and how the \
texture feels. All of them repeat in both directions. Heights have 16 bits and are linear. Normals \
are in tangent space with green up, as glTF and OpenGL have them.

With --diffusion, Stable Diffusion makes the picture from the texture's prompt, or else its name, \
at its own size or at --size. The folder is the user's own; docs/preview.md says how to export it. \
ONNX Runtime must be installed: `asperity doctor` says how.

Examples:
  asperity preview grit.asp -o grit.png
  asperity preview hatt.aspl --texture Cork -o cork.png
  asperity preview grit.asp -o grit.png --size 1024 --height grit-height.png --normal grit-normal.png
  asperity preview oak.asp -o oak.png --diffusion ./sd2-base --steps 30 --tile"
)]
pub(crate) struct Preview {
    /// An asset (.asp) or a library (.aspl); `-` is standard input
    pub(crate) file: PathBuf,
    /// The picture to write, PNG; `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// Width and height, pixels: 64 to 1024
    #[arg(long, value_name = "PX", value_parser = pixels)]
    pub(crate) size: Option<u32>,
    /// Draw the picture anew, even if the asset holds one
    #[arg(long, conflicts_with = "diffusion")]
    pub(crate) redraw: bool,
    /// Write the heights as well
    #[arg(long, value_name = "FILE.png", conflicts_with = "diffusion")]
    pub(crate) height: Option<PathBuf>,
    /// Write the normals as well
    #[arg(long, value_name = "FILE.png", conflicts_with = "diffusion")]
    pub(crate) normal: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) diffusion: Diffusion,
    /// What the picture shows, as it is [default: the texture's prompt, as a texture from above]
    #[arg(long, value_name = "TEXT", requires = "diffusion")]
    pub(crate) prompt: Option<String>,
    /// Seed of the noise [default: the texture's]
    #[arg(long, value_name = "N", requires = "diffusion")]
    pub(crate) seed: Option<u64>,
    /// One texture of a library, by name or index from 0
    #[arg(long, visible_alias = "name", value_name = "NAME|INDEX")]
    pub(crate) texture: Option<String>,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Six strokes, at two forces and three speeds, and three taps, unless options ask \
for others. They are the accelerations that the runtime renders at the rate of a servo loop, \
before device gain, resampled to 44.1 kHz. Strokes share one gain and taps another, each such \
that the loudest sample is 1 dB below full scale; the report states both. The same file, options \
and seed give the same bytes.

Examples:
  asperity listen grit.asp -o grit.wav
  asperity listen grit.asp -o fast.wav --speed 200 --force 1.5
  asperity listen hatt.aspl --texture Cork -o taps.wav --taps"
)]
pub(crate) struct Listen {
    /// An asset (.asp) or a library (.aspl); `-` is standard input
    pub(crate) file: PathBuf,
    /// The sound to write, WAV of 16 bits at 44.1 kHz; `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// One stroke at this speed, mm/s: 1 to 1000 [with --force alone: 100]
    #[arg(long, value_name = "MM_S", value_parser = |text: &str| within(text, 1.0, 1000.0))]
    pub(crate) speed: Option<f32>,
    /// One stroke at this normal force, N: 0.05 to 20 [with --speed alone: 1]
    #[arg(long, value_name = "N", value_parser = |text: &str| within(text, 0.05, 20.0))]
    pub(crate) force: Option<f32>,
    /// Taps, and no stroke unless one is asked for
    #[arg(long)]
    pub(crate) taps: bool,
    /// Seed of the excitation
    #[arg(long, default_value_t = 0)]
    pub(crate) seed: u64,
    /// Rate of the servo loop, 1 to 20 times that of the texture [default: the texture's]
    #[arg(long, value_name = "HZ")]
    pub(crate) rate: Option<f32>,
    /// One texture of a library, by name or index from 0
    #[arg(long, visible_alias = "name", value_name = "NAME|INDEX")]
    pub(crate) texture: Option<String>,
}

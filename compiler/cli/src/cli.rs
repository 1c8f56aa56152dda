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

use asperity::{
    inference::BackendName, interchange::ranges, library::check_name, preview, reduce::Fidelity,
    text::TextEncoderChoice,
};
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
    /// Show which encoders, models and back ends are available, and how to get the others
    Doctor(Doctor),
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
#[command(mut_arg("no_preview", |no_preview| no_preview.conflicts_with("diffusion")))]
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
    /// How much to keep: everything, as little as stays within 0.5 dB, or this AR order
    #[arg(long, default_value = "auto", value_name = "full|auto|ORDER")]
    pub(crate) fidelity: Fidelity,
    /// Sample rate of the AR models, Hz; use the rate of your servo loop
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
    /// Also write the unreduced texture as JSON, which `asperity import model` reads
    #[arg(long, value_name = "FILE.json")]
    pub(crate) emit_model: Option<PathBuf>,
    /// Explain how each word was read, and how far it moved each attribute
    #[arg(long)]
    pub(crate) explain: bool,
    /// Also report attributes in physical units, gains, and what each pass did
    #[arg(long)]
    pub(crate) details: bool,
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

#[derive(Debug, Subcommand)]
pub(crate) enum Import {
    /// Import materials of the Penn Haptic Texture Toolkit
    Hatt(ImportHatt),
    /// Import an AR model in JSON: your own, or one that --emit-model wrote
    Model(ImportModel),
    /// Compile a recording of a tool on a surface: its acceleration, force and motion
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
impossible values, clock drift, delays, hum and wrong units. If recording.toml is missing, a draft \
of it is printed, based on the headers of the files; --init writes it instead. The exit status is 1 if there is a fault.

Examples:
  asperity record-check oak/
  asperity record-check oak/ --init
  asperity record-check oak/ --json"
)]
pub(crate) struct RecordCheck {
    /// Folder of the recording
    pub(crate) folder: PathBuf,
    /// Write the draft of recording.toml into the folder; it must not exist yet
    #[arg(long)]
    pub(crate) init: bool,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "The recording is checked and aligned, cut into segments of steady speed and \
force, and fitted by AR models on a grid of speed and force; friction and taps are measured. \
Vertices, order and smoothing are those that predict held-out segments best. The learned model \
fills in what was not recorded, as the report then states. docs/recording.md explains every step.

Examples:
  asperity import recording oak/ -o oak.asp
  asperity import recording oak/ -o oak.asp --plot oak.png --report oak.json
  asperity import recording oak/ -o oak.asp --fidelity full --emit-model oak-model.json"
)]
pub(crate) struct ImportRecording {
    /// Folder of the recording
    pub(crate) folder: PathBuf,
    /// The asset to write; `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// How much to keep: everything, as little as stays within 0.5 dB, or this AR order
    #[arg(long, default_value = "auto", value_name = "full|auto|ORDER")]
    pub(crate) fidelity: Fidelity,
    /// Sample rate of the AR models, Hz; use the rate of your servo loop [default: 1000]
    #[arg(long, value_name = "HZ")]
    pub(crate) rate: Option<f64>,
    /// Import even if the check found faults
    #[arg(long)]
    pub(crate) force: bool,
    /// Model folder written by `asperity-train fit` [default: the embedded model]
    #[arg(long, value_name = "DIR")]
    pub(crate) model: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) preview: PreviewOptions,
    /// Plot every step of the import on one sheet
    #[arg(long, value_name = "FILE.png")]
    pub(crate) plot: Option<PathBuf>,
    /// Write the report of every step as JSON
    #[arg(long, value_name = "FILE.json")]
    pub(crate) report: Option<PathBuf>,
    /// Also write the unreduced texture as JSON, which `asperity import model` reads
    #[arg(long, value_name = "FILE.json")]
    pub(crate) emit_model: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) reporting: ReportOptions,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Prints one line per material: the RMS distance of its log spectra from \
the source over 10–450 Hz, level included, and its size. `full` keeps every vertex and triangle; \
`auto` keeps the smallest order and numerator, the fewest vertices and the shortest taps within \
0.5 dB at 95 % of the grid and 1 dB at worst. HaTT has no recordings of taps, so they are \
synthesised or, with --complete-taps, decoded by the learned model from the AR grid. Either way \
the asset marks them as synthetic.

Examples:
  asperity import hatt Models_Cork.xml -o cork.asp
  asperity import hatt Models_Cork.xml -o cork.asp --complete-taps
  asperity import hatt hatt/models -o assets
  asperity import hatt hatt/models -o hatt.aspl --fidelity auto"
)]
pub(crate) struct ImportHatt {
    /// One `Models_<name>.xml`, or a folder of them
    pub(crate) input: PathBuf,
    /// One asset (.asp), a folder for one asset per material, or a library (.aspl); `-` is standard
    /// output: a file is then written as an asset, a folder as a library
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// How much to keep: everything, as little as stays within 0.5 dB, or this AR order
    #[arg(long, default_value = "full", value_name = "full|auto|ORDER")]
    pub(crate) fidelity: Fidelity,
    /// Decode taps from the AR grid with the learned model instead of synthesising them
    #[arg(long)]
    pub(crate) complete_taps: bool,
    /// Model folder written by `asperity-train fit` [default: the embedded model]
    #[arg(long, value_name = "DIR", requires = "complete_taps")]
    pub(crate) model: Option<PathBuf>,
    /// Also write the unreduced texture as JSON; only for a single material
    #[arg(long, value_name = "FILE.json")]
    pub(crate) emit_model: Option<PathBuf>,
    /// Print how long each pass took, on standard error
    #[arg(long)]
    pub(crate) timings: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "The file gives AR or ARMA models over speed and force, and optionally taps, \
wall, gains and provenance; docs/model.md lists every key. As with any other source, the texture \
is reduced, verified with the runtime itself, and written. Prints how far the log spectra are from \
those of the file over 10–450 Hz, level included, and the size.

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
    /// How much to keep: everything, as little as stays within 0.5 dB, or this AR order
    #[arg(long, default_value = "full", value_name = "full|auto|ORDER")]
    pub(crate) fidelity: Fidelity,
    /// Sample rate of the AR models, Hz; use the rate of your servo loop [default: the file's]
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
    /// Also write the unreduced texture as JSON, which `asperity import model` reads
    #[arg(long, value_name = "FILE.json")]
    pub(crate) emit_model: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) reporting: ReportOptions,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Verifies every checksum; for a library, those of all its textures. With \
--json, an asset is one object, and a library is {format_version, textures: [object, …]}, sorted \
by name.

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
    /// Read only this texture of a library, by name or index from 0
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
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "The trajectory has the header t_s,x_mm,y_mm,z_mm and one row per tick, at \
--rate. The surface is the infinite plane z = 0, with contact where z < 0. A library with a scene \
is rendered on the surfaces of the scene, and a last column names the surface in contact. The same \
file, trajectory and seed give the same bytes.

Examples:
  asperity render grit.asp --trajectory stroke.csv -o felt.csv --seed 1
  asperity render hatt.aspl --texture Cork --trajectory stroke.csv -o felt.csv
  asperity render desk.aspl --trajectory stroke.csv -o felt.csv"
)]
pub(crate) struct Render {
    /// An asset (.asp) or a library (.aspl); `-` is standard input
    pub(crate) file: PathBuf,
    /// Trajectory to follow, CSV
    #[arg(long, value_name = "IN.csv")]
    pub(crate) trajectory: PathBuf,
    /// Table to write, CSV; `-` is standard output
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
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "By default, the picture stored in the asset is written unchanged. With --redraw, \
--size, --height or --normal, or if the asset has no picture, a new one is drawn in full colour \
from the prompt or name, the seed, the nearest materials and the feel of the texture. All pictures \
tile in both directions. Height maps are linear, with 16 bits. Normal maps are in tangent space \
with green up, as in glTF and OpenGL.

With --diffusion, Stable Diffusion draws the picture from the texture's prompt, or from its name if \
it has none, at --size or the size of the model. You provide the model folder; docs/preview.md \
explains how to export it. ONNX Runtime must be installed, and `asperity doctor` explains how.

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
    /// Draw a new picture even if the asset has one
    #[arg(long, conflicts_with = "diffusion")]
    pub(crate) redraw: bool,
    /// Also write a height map
    #[arg(long, value_name = "FILE.png", conflicts_with = "diffusion")]
    pub(crate) height: Option<PathBuf>,
    /// Also write a normal map
    #[arg(long, value_name = "FILE.png", conflicts_with = "diffusion")]
    pub(crate) normal: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) diffusion: Diffusion,
    /// Prompt for the picture, used as given [default: the texture's, as a texture seen from above]
    #[arg(long, value_name = "TEXT", requires = "diffusion")]
    pub(crate) prompt: Option<String>,
    /// Seed of the noise [default: the texture's]
    #[arg(long, value_name = "N", requires = "diffusion")]
    pub(crate) seed: Option<u64>,
    /// One texture of a library, by name or index from 0
    #[arg(long, visible_alias = "name", value_name = "NAME|INDEX")]
    pub(crate) texture: Option<String>,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "By default, the file has six strokes, at two forces and three speeds, and three \
taps. They are the accelerations that the runtime renders at the servo rate, before device gain, \
resampled to 44.1 kHz. All strokes share one gain, and all taps another, chosen so that the loudest \
sample of each is 1 dB below full scale; the report gives both. The same file, options and seed \
give the same bytes.

Examples:
  asperity listen grit.asp -o grit.wav
  asperity listen grit.asp -o fast.wav --speed 200 --force 1.5
  asperity listen hatt.aspl --texture Cork -o taps.wav --taps"
)]
pub(crate) struct Listen {
    /// An asset (.asp) or a library (.aspl); `-` is standard input
    pub(crate) file: PathBuf,
    /// The sound to write, a 16-bit WAV at 44.1 kHz; `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// One stroke at this speed, mm/s: 1 to 1000 [with --force alone: 100]
    #[arg(long, value_name = "MM_S", value_parser = |text: &str| within(text, &ranges::SPEED_MM_S))]
    pub(crate) speed: Option<f32>,
    /// One stroke at this normal force, N: 0.05 to 20 [with --speed alone: 1]
    #[arg(long, value_name = "N", value_parser = |text: &str| within(text, &ranges::FORCE_N))]
    pub(crate) force: Option<f32>,
    /// Render taps, and no stroke unless --speed or --force is given
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
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

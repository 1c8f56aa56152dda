//! Arguments of the commands that check and import what others measured or modelled.

use super::{ImportEffects, Inference, PreviewOptions, ReportOptions};
use asperity::{
    passes::reduce::Fidelity,
    sources::surface::{Convention, Tip},
};
use clap::{Args, Subcommand};
use std::path::PathBuf;

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

#[derive(Debug, Subcommand)]
pub(crate) enum Import {
    /// Import materials of the Penn Haptic Texture Toolkit
    Hatt(ImportHatt),
    /// Import an AR model in JSON: your own, or one that --emit-model wrote
    Model(ImportModel),
    /// Compile a recording of a tool on a surface: its acceleration, force and motion
    Recording(ImportRecording),
    /// Compile a height map, a normal map or a PBR material into a texture
    Surface(ImportSurface),
    /// Compile a NiceVibrations `.haptic` file into a texture
    Haptic(ImportEffects),
    /// Compile an Apple Haptic and Audio Pattern into a texture
    Ahap(ImportEffects),
    /// Compile an HJIF file (MPEG haptics) into a texture
    Hjif(ImportEffects),
}

/// Options of what is measured and becomes one texture.
#[derive(Debug, Args)]
pub(crate) struct MeasuredTexture {
    /// Model detail to keep: everything, as little as stays within 0.5 dB, or this AR order
    #[arg(long, default_value = "auto", value_name = "full|auto|ORDER")]
    pub(crate) fidelity: Fidelity,
    /// Sample rate of the AR models, Hz; use the rate of your servo loop [default: 1000]
    #[arg(long, value_name = "HZ")]
    pub(crate) rate: Option<f64>,
    #[command(flatten)]
    pub(crate) preview: PreviewOptions,
    /// Plot what was found on one sheet
    #[arg(long, value_name = "FILE.png")]
    pub(crate) plot: Option<PathBuf>,
    /// Write the whole report as JSON
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
    after_help = "The recording is checked and aligned, cut into segments by speed and \
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
    /// Import even if the check found faults
    #[arg(long)]
    pub(crate) force: bool,
    /// Model folder written by `asperity-train fit` [default: the embedded model]
    #[arg(long, value_name = "DIR")]
    pub(crate) model: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) texture: MeasuredTexture,
}

#[derive(Debug, Args)]
#[command(
    after_help = "The tip rolls over the heights, and its contact averages them; what tool and hand \
make of that at many speeds and forces becomes the texture, with the axis of ribs or a grain. \
Heights are greyscale, white high; 16 bits keep fine relief. Of a folder, heights, normals and the \
base colour, which becomes the preview, are recognised by their usual names; long waves follow the \
heights, short ones the normals. What a map cannot say, \
hardness, taps and friction, comes from --like, or else from materials that vibrate alike. A picture has \
16 to 8192 pixels a side; of more than 2048 points, the middle is stroked. \
docs/surfaces.md explains the method and its limits.

Examples:
  asperity import surface oak.png -o oak.asp --width-mm 100 --depth-mm 0.4 --like 'planed oak'
  asperity import surface scan.tif -o scan.asp --width-mm 12.5 --depth-mm 0.08 --json
  asperity import surface Wood049_2K-PNG/ -o wood.asp --width-mm 300 --like wood
  asperity import surface materials/ -o materials.aspl --width-mm 300
  asperity import surface cracks.png -o cracks.asp --width-mm 50 --depth-mm -0.3"
)]
pub(crate) struct ImportSurface {
    /// A height map or a normal map (.png, .tif, .jpg), a folder with the pictures of a material, or a profile (.csv)
    pub(crate) path: PathBuf,
    /// The asset to write; `-` is standard output. A library (.aspl), or a folder, takes every map and material of a folder
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// Width of the surface that the map shows, mm; only a profile with positions says it
    #[arg(long, value_name = "W", allow_hyphen_values = true)]
    pub(crate) width_mm: Option<f64>,
    /// Height of white above black, mm, or of the highest point above the lowest in floating point; negative where white
    /// is low [default: as strong as --like]
    #[arg(long, value_name = "D", allow_hyphen_values = true)]
    pub(crate) depth_mm: Option<f64>,
    /// Where green points to in normals: up, as OpenGL has it, or down, as DirectX does [default: what fits a surface]
    #[arg(long, value_name = "gl|dx")]
    pub(crate) normal: Option<Convention>,
    /// Words for the material: its hardness, taps and friction
    #[arg(long, value_name = "PROMPT")]
    pub(crate) like: Option<String>,
    /// The tip that strokes it
    #[arg(long, default_value = "stylus", value_name = "stylus|fingertip|needle")]
    pub(crate) tip: Tip,
    /// Name of the texture [default: that of the file]
    #[arg(long)]
    pub(crate) name: Option<String>,
    #[command(flatten)]
    pub(crate) inference: Inference,
    #[command(flatten)]
    pub(crate) texture: MeasuredTexture,
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
    /// A `Models_<name>.xml` file, or a folder of them
    pub(crate) input: PathBuf,
    /// An asset (.asp), a folder for one asset per material, or a library (.aspl); `-` is standard output: a file is
    /// then written as an asset, a folder as a library
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// Model detail to keep: everything, as little as stays within 0.5 dB, or this AR order
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
    /// Model detail to keep: everything, as little as stays within 0.5 dB, or this AR order
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

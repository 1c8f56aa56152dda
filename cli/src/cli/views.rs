//! Arguments of the commands that show a texture: as text, picture, sound or forces.

use super::{pixels, within};
use asperity::{interchange::ranges, learned::inference::BackendName, views::diffusion::Method};
use clap::{Args, value_parser};
use std::path::PathBuf;

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
    /// Texture of a library, by name or zero-based index
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
    /// Texture of a library, by name or zero-based index
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
    /// Draw the picture with Stable Diffusion, from this ONNX folder (see docs/preview.md)
    #[arg(long, value_name = "DIR")]
    pub(crate) diffusion: Option<PathBuf>,
    /// Denoising steps, 1 to 1000
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = value_parser!(u16).range(1..=1000), requires = "diffusion")]
    pub(crate) steps: u16,
    /// Guidance scale, 1 to 30: how closely to follow the prompt; 1 ignores the negative prompt
    #[arg(long, value_name = "SCALE", default_value_t = 7.5, value_parser = |text: &str| within(text, &(1.0..=30.0)), requires = "diffusion")]
    pub(crate) guidance: f32,
    /// Scheduler of the denoising steps
    #[arg(
        long,
        value_name = "ddim|euler",
        default_value_t,
        requires = "diffusion"
    )]
    pub(crate) scheduler: Method,
    /// Negative prompt: what the picture must not show
    #[arg(
        long,
        value_name = "TEXT",
        default_value = "",
        hide_default_value = true,
        requires = "diffusion"
    )]
    pub(crate) negative: String,
    /// Draw a picture that tiles seamlessly; decoding takes four times as long
    #[arg(long, requires = "diffusion")]
    pub(crate) tile: bool,
    /// Back end of the diffusion networks; `portable` is only fast enough for tiny ones, as in tests
    #[arg(long, value_name = "onnxruntime|portable", default_value_t = BackendName::OnnxRuntime, requires = "diffusion")]
    pub(crate) diffusion_backend: BackendName,
    /// Prompt for the picture, used as given [default: the texture's, as a texture seen from above]
    #[arg(long, value_name = "TEXT", requires = "diffusion")]
    pub(crate) prompt: Option<String>,
    /// Seed of the noise [default: the texture's]
    #[arg(long, value_name = "N", requires = "diffusion")]
    pub(crate) seed: Option<u64>,
    /// Texture of a library, by name or zero-based index
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
    /// Speed of a single stroke, mm/s: 1 to 1000 [with --force alone: 100]
    #[arg(long, value_name = "MM_S", value_parser = |text: &str| within(text, &ranges::SPEED_MM_S))]
    pub(crate) speed: Option<f32>,
    /// Normal force of a single stroke, N: 0.05 to 20 [with --speed alone: 1]
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
    /// Texture of a library, by name or zero-based index
    #[arg(long, visible_alias = "name", value_name = "NAME|INDEX")]
    pub(crate) texture: Option<String>,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

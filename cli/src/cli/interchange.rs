//! Arguments of the commands that speak other tools' formats.

use super::{PreviewOptions, ReportOptions};
use super::{name, pixels, within};
use asperity::{
    interchange::{Format, parse_symbol, ranges},
    passes::reduce::Fidelity,
    views::preview,
};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(
    after_help = "Formats: c-array and rust embed the asset, or a whole library, as an aligned \
constant array without its previews; `-o NAME.c` also writes NAME.h. hjif and hmpg (MPEG haptics), \
ahap (Apple), haptic (NiceVibrations), wav and csv contain strokes and taps as the runtime renders \
them, by default one stroke and three taps. gltf contains a material with the MPEG_haptic_material extension. A library \
is exported to a folder, with one file per texture. The report gives the loss of each stroke and \
tap in dB over third octaves; docs/export.md explains how it is measured.

Examples:
  asperity export grit.asp --to c-array -o grit.c
  asperity export grit.asp --to ahap -o grit.ahap
  asperity export grit.asp --to hjif -o fast.hjif --speed 200 --force 1.5 --time 2
  asperity export hatt.aspl --to haptic -o haptics --full-scale 10
  asperity export hatt.aspl --texture Cork --to wav -o cork.wav --taps --json"
)]
pub(crate) struct Export {
    /// An asset (.asp) or a library (.aspl); `-` is standard input
    pub(crate) file: PathBuf,
    /// Format to export to
    #[arg(long, value_name = "c-array|rust|hjif|hmpg|ahap|haptic|gltf|wav|csv")]
    pub(crate) to: Format,
    /// The file to write, or a folder for a library; `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// Speed of the stroke, mm/s: 1 to 1000 [default: 100]
    #[arg(long, value_name = "MM_S", value_parser = |text: &str| within(text, &ranges::SPEED_MM_S))]
    pub(crate) speed: Option<f32>,
    /// Normal force of the stroke, N: 0.05 to 20 [default: 1]
    #[arg(long, value_name = "N", value_parser = |text: &str| within(text, &ranges::FORCE_N))]
    pub(crate) force: Option<f32>,
    /// Duration of the stroke, s: 0.3 to 60 [default: 1]
    #[arg(long, value_name = "S", value_parser = |text: &str| within(text, &ranges::TIME_S))]
    pub(crate) time: Option<f32>,
    /// Render taps, and no stroke unless --speed or --force is given
    #[arg(long)]
    pub(crate) taps: bool,
    /// Acceleration at full scale in strokes, m/s² [default: the largest in the clip]
    #[arg(long, value_name = "M_S2", value_parser = |text: &str| within(text, &ranges::FULL_SCALE_M_S2))]
    pub(crate) full_scale: Option<f32>,
    /// Acceleration at full scale in taps, m/s² [default: the largest in the clip]
    #[arg(long, value_name = "M_S2", value_parser = |text: &str| within(text, &ranges::FULL_SCALE_M_S2))]
    pub(crate) tap_full_scale: Option<f32>,
    /// Seed of the excitation
    #[arg(long, default_value_t = 0)]
    pub(crate) seed: u64,
    /// Rate of the servo loop, 1 to 20 times that of the texture [default: the texture's]
    #[arg(long, value_name = "HZ")]
    pub(crate) rate: Option<f32>,
    /// Width and height of the pictures in a gltf export, in pixels, 64 to 1024
    #[arg(long, value_name = "PX", default_value_t = preview::SIZE, value_parser = pixels)]
    pub(crate) size: u32,
    /// Texture of a library, by name or zero-based index
    #[arg(long, visible_alias = "name", value_name = "NAME|INDEX")]
    pub(crate) texture: Option<String>,
    /// Symbol of the array in c-array and rust [default: asperity_image_ and the name]
    #[arg(long, value_name = "IDENTIFIER", value_parser = parse_symbol)]
    pub(crate) symbol: Option<String>,
    /// Keep preview pictures in c-array and rust, although a runtime does not read them
    #[arg(long)]
    pub(crate) keep_preview: bool,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Effect files give no speed, force or acceleration, so the options supply them. \
The continuous effects become one stroke at --speed and --force: an AR model with their level and \
spectrum. The transients become taps: the loudest at --tap-speed, quieter ones at lower speeds. \
docs/export.md explains how each format is read.

Examples:
  asperity import haptic gravel.haptic -o gravel.asp
  asperity import ahap gravel.ahap -o gravel.asp --speed 150 --force 0.8 --full-scale 8
  asperity import hjif gravel.hjif -o gravel.asp --mu 0.7 --json"
)]
pub(crate) struct ImportEffects {
    /// Effect file to import
    pub(crate) input: PathBuf,
    /// The asset to write; `-` is standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// Name of the texture, 1 to 64 bytes [default: the name of the file]
    #[arg(long, value_parser = name)]
    pub(crate) name: Option<String>,
    /// Speed of the stroke, mm/s: 1 to 1000
    #[arg(long, value_name = "MM_S", default_value_t = 100.0, value_parser = |text: &str| within(text, &ranges::SPEED_MM_S))]
    pub(crate) speed: f32,
    /// Normal force of the stroke, N: 0.05 to 20
    #[arg(long, value_name = "N", default_value_t = 1.0, value_parser = |text: &str| within(text, &ranges::FORCE_N))]
    pub(crate) force: f32,
    /// Acceleration at full scale in strokes, m/s²
    #[arg(long, value_name = "M_S2", default_value_t = 5.0, value_parser = |text: &str| within(text, &ranges::FULL_SCALE_M_S2))]
    pub(crate) full_scale: f32,
    /// Acceleration at full scale in taps, m/s²
    #[arg(long, value_name = "M_S2", default_value_t = 50.0, value_parser = |text: &str| within(text, &ranges::FULL_SCALE_M_S2))]
    pub(crate) tap_full_scale: f32,
    /// Impact speed of the loudest tap, m/s
    #[arg(long, value_name = "M_S", default_value_t = 0.3, value_parser = |text: &str| within(text, &ranges::TAP_SPEED_M_S))]
    pub(crate) tap_speed: f32,
    /// Coefficient of friction
    #[arg(long, default_value_t = 0.5, value_parser = |text: &str| within(text, &ranges::MU))]
    pub(crate) mu: f32,
    /// Model detail to keep: everything, as little as stays within 0.5 dB, or this AR order
    #[arg(long, default_value = "auto", value_name = "full|auto|ORDER")]
    pub(crate) fidelity: Fidelity,
    /// Sample rate of the AR models, Hz; use the rate of your servo loop [default: 1000]
    #[arg(long, value_name = "HZ")]
    pub(crate) rate: Option<f64>,
    #[command(flatten)]
    pub(crate) preview: PreviewOptions,
    #[command(flatten)]
    pub(crate) reporting: ReportOptions,
}

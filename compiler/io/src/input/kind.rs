//! Kinds of input, and the maximum size of each.

use super::format::Format;
use std::fmt;

const KIB: u64 = 1024;
const MIB: u64 = 1024 * KIB;

/// The role that a file plays as an input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum InputKind {
    /// An asset (.asp), or a library (.aspl) that is held in memory as a whole.
    Asset,
    /// A material of the HaTT, XML.
    Hatt,
    /// An intermediate model, JSON.
    Model,
    /// A map of heights, a picture.
    HeightMap,
    /// Effects of another tool, JSON.
    Effects,
    /// A scene or a manifest, TOML.
    Scene,
    /// A manifest, CSV or JSON lines.
    Manifest,
    /// A device, a grip or other settings, TOML.
    Settings,
    /// A file of the training corpus, TOML.
    Corpus,
    /// A trajectory, CSV; read row by row.
    Trajectory,
    /// An interval log of `asperity-lab jitter`.
    Log,
    /// Counted instructions, CSV.
    Counts,
    /// `model.json` of a model folder.
    Description,
    /// A network of a model folder, ONNX.
    Network,
    /// A text encoder, ONNX.
    TextEncoder,
    /// A tokenizer's vocabulary.
    Vocabulary,
    /// A configuration in a diffusion folder, JSON.
    DiffusionConfig,
    /// A network in a diffusion folder, ONNX, that the portable engine reads.
    DiffusionNetwork,
    /// The studio's compiler, WebAssembly.
    StudioModule,
}

impl InputKind {
    /// All kinds.
    pub const ALL: [Self; 19] = [
        Self::Asset,
        Self::Hatt,
        Self::Model,
        Self::HeightMap,
        Self::Effects,
        Self::Scene,
        Self::Manifest,
        Self::Settings,
        Self::Corpus,
        Self::Trajectory,
        Self::Log,
        Self::Counts,
        Self::Description,
        Self::Network,
        Self::TextEncoder,
        Self::Vocabulary,
        Self::DiffusionConfig,
        Self::DiffusionNetwork,
        Self::StudioModule,
    ];

    /// The most bytes that are read.
    #[must_use]
    pub const fn max_bytes(self) -> u64 {
        match self {
            Self::Asset | Self::Network | Self::DiffusionNetwork => 64 * MIB,
            Self::Hatt
            | Self::Model
            | Self::Effects
            | Self::Manifest
            | Self::Description
            | Self::Vocabulary => 16 * MIB,
            // 8192 × 8192 pixels of floating point.
            Self::HeightMap => 512 * MIB,
            Self::Scene | Self::Settings | Self::Counts | Self::DiffusionConfig => MIB,
            Self::Corpus => 4 * MIB,
            Self::StudioModule => 128 * MIB,
            // A log of a day takes half of it.
            Self::Trajectory | Self::Log => 1024 * MIB,
            // The text tower of CLIP ViT-L/14 takes 472 MiB.
            Self::TextEncoder => 480 * MIB,
        }
    }

    /// Returns true if a file of this kind may have a format.
    pub(super) fn takes(self, format: Format) -> bool {
        match self {
            Self::Asset => matches!(format, Format::Asset | Format::Library),
            // The reader of a HaTT material names the root that it found.
            Self::Hatt => matches!(format, Format::Hatt | Format::Xml),
            Self::Model => format == Format::Model,
            Self::HeightMap => matches!(format, Format::Png | Format::Tiff | Format::Jpeg),
            // Each import names the one format that it reads.
            Self::Effects => true,
            _ => false,
        }
    }

    /// The format of the bytes of a file that is meant to be of this kind. The keys of its own JSON may be
    /// anything where they are words or settings.
    pub(super) fn format(self, bytes: &[u8]) -> Option<Format> {
        match self {
            Self::Description | Self::Vocabulary | Self::DiffusionConfig => Format::of_magic(bytes),
            // HMPG has no magic number.
            Self::Network | Self::TextEncoder | Self::DiffusionNetwork => {
                Format::of_magic(bytes).filter(|format| *format != Format::Hmpg)
            }
            _ => Format::of(bytes),
        }
    }

    /// Returns the remedy for a file that is too large: which file to give instead.
    #[must_use]
    pub const fn remedy(self) -> &'static str {
        match self {
            Self::Asset => "give an asset or a library that `asperity` wrote",
            Self::Hatt => {
                "give a model file of the Penn Haptic Texture Toolkit, `Models_<name>.xml`"
            }
            Self::Model => "give a model as docs/model.md describes it",
            Self::HeightMap => "crop the map, and state the width of what is left",
            Self::Effects => "cut the file into shorter effects",
            Self::Scene => "give a scene as docs/scenes.md describes it",
            Self::Manifest => "split the manifest, and include its parts",
            Self::Settings => "compare with device-sim/devices/touch.toml or a file of grips/",
            Self::Corpus => "split the file: every .toml file of the folder is read",
            Self::Trajectory => "cut the trajectory into several files",
            Self::Log => "give a run.hlog that `asperity-lab jitter -o` wrote",
            Self::Counts => "give a table as `cortex-m designs` prints it",
            Self::Description | Self::Network => "give a folder that `asperity-train fit` wrote",
            Self::TextEncoder => "export the text tower alone, in half precision if need be",
            Self::Vocabulary => "give the vocabulary that belongs to the text encoder",
            Self::DiffusionConfig => "give a folder that `optimum-cli export onnx` wrote",
            Self::DiffusionNetwork => "leave --diffusion-backend out, for ONNX Runtime",
            Self::StudioModule => "give the file that `studio/build-module` wrote",
        }
    }
}

impl fmt::Display for InputKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Asset => "an asset",
            Self::Hatt => "a HaTT material",
            Self::Model => "a model file",
            Self::HeightMap => "a map of heights or normals (PNG, TIFF or JPEG)",
            Self::Effects => "a file of effects",
            Self::Scene => "a scene",
            Self::Manifest => "a manifest",
            Self::Settings => "a file of settings",
            Self::Corpus => "a file of the corpus",
            Self::Trajectory => "a trajectory",
            Self::Log => "an interval log",
            Self::Counts => "a table of counts",
            Self::Description => "a model's description",
            Self::Network => "a model's network",
            Self::TextEncoder => "a text encoder",
            Self::Vocabulary => "a vocabulary",
            Self::DiffusionConfig => "a configuration of a diffusion folder",
            Self::DiffusionNetwork => "a diffusion network on the portable engine",
            Self::StudioModule => "the studio's compiler",
        })
    }
}

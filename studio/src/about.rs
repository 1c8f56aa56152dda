//! The page's first request: the server's version and capabilities.

use crate::{
    VERSION,
    device::{Description, LiveDevice},
    library_store::LibraryHandle,
    project::Project,
    prompts::Prompts,
};
use asperity::{
    interchange::{Format, Language},
    sources::{
        latents::{AXES, Axis, Scale},
        prompt::suggestions,
    },
};
use serde::Serialize;

/// Files of a texture that a page of static files offers for download.
pub(crate) const OFFERED: [&str; 3] = ["asp", "png", "normal.png"];
/// The file of the compiler beside such a page.
pub(crate) const MODULE: &str = "compiler.wasm";

/// The answer of the interface.
#[derive(Serialize)]
struct About<'a> {
    version: &'a str,
    /// True if the page is static files, without a server.
    exported: bool,
    /// True if files can be opened and libraries packed.
    opens: bool,
    /// True if prompts can be compiled and textures edited.
    prompts: bool,
    library: Option<Library<'a>>,
    folder: Option<String>,
    words: Vec<&'static str>,
    sliders: Vec<Slider>,
    exports: Vec<Export>,
    /// Endings of the files that are there of each texture, where they are static.
    files: Option<&'a [&'a str]>,
    compiler: Option<Compiler>,
    device: Option<Description<'a>>,
    /// The name of the project that keeps what is made.
    project: Option<String>,
}

/// A library, as the page knows it.
#[derive(Serialize)]
pub(crate) struct Library<'a> {
    id: &'a str,
    name: &'a str,
    textures: usize,
}

impl<'a> Library<'a> {
    pub(crate) fn of(handle: &'a LibraryHandle) -> Self {
        Self {
            id: &handle.id,
            name: handle.library.name(),
            textures: handle.library.textures(),
        }
    }
}

/// A slider of the page, from 0 to 100.
#[derive(Serialize)]
struct Slider {
    axis: Axis,
    unit: &'static str,
    /// The attribute that it moves, as named in reports.
    attribute: &'static str,
    /// The attribute at 0.
    low: f64,
    /// The attribute at 100.
    high: f64,
    /// Towards 100, in a word.
    up: &'static str,
    /// Towards 0.
    down: &'static str,
}

/// A file of `asperity export`, as `api/texture` gives it.
#[derive(Serialize)]
struct Export {
    ending: String,
    format: &'static str,
    file_ending: &'static str,
}

/// From where the page comes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Served {
    /// From a server that answers.
    Live,
    /// From static files.
    Files,
    /// From static files, with a module of so many bytes that answers as the server does.
    FilesAndModule(usize),
}

/// The compiler's module beside static files.
#[derive(Serialize)]
struct Compiler {
    file: &'static str,
    bytes: usize,
}

/// Returns the server's version and capabilities, JSON. Waits for the networks where there are any.
pub(crate) fn about(
    prompts: &Prompts,
    start: Option<&LibraryHandle>,
    device: Option<&LiveDevice>,
    project: Option<&Project>,
    served: Served,
) -> Vec<u8> {
    let about = About {
        version: VERSION,
        exported: served != Served::Live,
        opens: served != Served::Files,
        prompts: prompts.exist(),
        library: start.map(Library::of),
        folder: start
            .and_then(|handle| handle.library.folder())
            .map(|folder| folder.display().to_string()),
        words: if prompts.exist() {
            suggestions()
        } else {
            Vec::new()
        },
        // Those of a compiler that cannot be loaded are missed by nobody.
        sliders: prompts
            .get()
            .map(|loaded| AXES.map(|axis| slider(axis, &loaded.scale)).into())
            .unwrap_or_default(),
        exports: exports(),
        files: (served != Served::Live).then_some(&OFFERED),
        compiler: match served {
            Served::FilesAndModule(bytes) => Some(Compiler {
                file: MODULE,
                bytes,
            }),
            Served::Live | Served::Files => None,
        },
        device: device.map(LiveDevice::description),
        project: project.map(Project::name),
    };
    // Plain structures of numbers and strings always serialise.
    serde_json::to_vec(&about).unwrap_or_default()
}

fn slider(axis: Axis, scale: &Scale) -> Slider {
    let (unit, attribute, up, down) = match axis {
        Axis::Rough => ("dB", "rough_db", "rougher", "smoother"),
        Axis::Sharp => ("Hz", "sharp_hz", "sharper", "duller"),
        Axis::Hard => ("Hz", "hard_hz", "harder", "softer"),
        Axis::Slippery => ("", "mu", "slipperier", "stickier"),
    };
    let (low, high) = match (axis, scale.range(axis)) {
        // Slipperiness is −μ.
        (Axis::Slippery, (low, high)) => (-low, -high),
        (_, range) => range,
    };
    Slider {
        axis,
        unit,
        attribute,
        low,
        high,
        up,
        down,
    }
}

fn exports() -> Vec<Export> {
    let export = |format: Format, file_ending: &'static str| Export {
        ending: format!("export.{file_ending}"),
        format: format.name(),
        file_ending,
    };
    Format::ALL
        .into_iter()
        .flat_map(|format| {
            let header = (format == Format::Source(Language::C)).then(|| export(format, "h"));
            std::iter::once(export(format, format.extension())).chain(header)
        })
        .collect()
}

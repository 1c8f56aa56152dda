//! Files of other tools; the kind is detected from the file.

use super::{
    ManifestSource,
    effects::{self, Effects},
    hatt::Hatt,
    kind::{Operand, SourceEntry, SourceKind},
    model_file::ModelFile,
};
use crate::{passes::reduce::Fidelity, pipeline::Request, views::preview};
use asperity_io::{
    diagnostic::{Failure, Fault},
    input::{self, Format, InputError, InputProblem},
};
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

/// `import` of a manifest.
pub const KIND: SourceKind = SourceKind {
    key: "import",
    operand: Operand::File,
    open,
    options: &[],
    refuses: &["texture", "seed", "edit"],
    fidelity: Fidelity::Full,
    preview: false,
};

/// Formats that can be imported.
const WANTED: &str = "a HaTT material, a model, AHAP, .haptic or HJIF";

/// Importer of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Imported {
    /// A material of the Penn Haptic Texture Toolkit.
    Hatt,
    /// A model of one's own.
    Model,
    /// Effects of another tool.
    Effects(effects::EffectsKind),
}

impl Imported {
    /// Returns the importer for a file of this format and name; `None` if there is none. A damaged file is identified
    /// by its name: the reader of that format gives the best reason for the refusal.
    #[must_use]
    pub fn of(file: &Path, found: Option<Format>) -> Option<Self> {
        let extension = file.extension().unwrap_or_default();
        let ends_in = |wanted: &str| extension.eq_ignore_ascii_case(wanted);
        match found {
            Some(Format::Hatt) => return Some(Self::Hatt),
            Some(Format::Model) => return Some(Self::Model),
            _ => {}
        }
        if let Some(kind) = found.and_then(effects::EffectsKind::of_format) {
            Some(Self::Effects(kind))
        } else if ends_in("xml") {
            Some(Self::Hatt)
        } else if ends_in("json") {
            Some(Self::Model)
        } else {
            effects::EffectsKind::of_name(file).map(Self::Effects)
        }
    }

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hatt => "hatt",
            Self::Model => "model",
            Self::Effects(kind) => kind.name(),
        }
    }

    /// The source that a file is.
    #[must_use]
    pub fn source(self, file: PathBuf) -> Arc<dyn ManifestSource> {
        match self {
            Self::Hatt => Arc::new(Hatt::new(file)),
            Self::Model => Arc::new(ModelFile { file }),
            Self::Effects(kind) => Arc::new(Effects {
                file,
                kind,
                options: effects::Options::default(),
            }),
        }
    }

    /// Returns the default request of `asperity import` for such a file.
    #[must_use]
    pub fn request(self) -> Request {
        Request {
            fidelity: match self {
                Self::Hatt | Self::Model => Fidelity::Full,
                Self::Effects(_) => Fidelity::Auto,
            },
            preview_px: (self != Self::Hatt).then_some(preview::SIZE),
            ..Request::default()
        }
    }
}

fn open(entry: &SourceEntry<'_>) -> Result<Arc<dyn ManifestSource>, Failure> {
    let file = entry.path.to_owned();
    let found = input::format_of(&file).map_err(|problem| InputError {
        file: file.clone(),
        problem,
    })?;
    match (Imported::of(&file, found), found) {
        (Some(imported), _) => Ok(imported.source(file)),
        (None, Some(format)) => {
            let wanted = WANTED.into();
            let problem = InputProblem::OtherFormat { format, wanted };
            Err(InputError { file, problem }.into())
        }
        (None, None) => {
            let what = format!("unknown format; must be {WANTED}");
            let remedy = "correct the path, or convert the file to one of these";
            Err(Fault::new(what, remedy).at(file).into())
        }
    }
}

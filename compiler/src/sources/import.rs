//! Files of other tools, whose kind is told from the file.

use super::{
    Source,
    effects::{self, Effects},
    hatt::Hatt,
    model_file::ModelFile,
    registry::{Kind, Operand, Stated},
};
use crate::{driver::Failure, passes::reduce::Fidelity};
use asperity_io::{
    diagnostic::Diagnostic,
    input::{self, Format, InputProblem},
};
use std::{path::PathBuf, sync::Arc};
use thiserror::Error;

/// `import` of a manifest.
pub const KIND: Kind = Kind {
    key: "import",
    operand: Operand::File,
    open,
    refuses: &["texture", "seed", "edit"],
    fidelity: Fidelity::Full,
    preview: false,
};

/// What can be imported.
const WANTED: &str = "a HaTT material, a model, AHAP, .haptic or HJIF";

/// A file that cannot be imported.
#[derive(Debug, Error)]
#[error("{file}: {what}, {WANTED} is wanted", file = file.display())]
struct Unknown {
    file: PathBuf,
    what: String,
}

impl Diagnostic for Unknown {
    fn remedy(&self) -> String {
        "correct the value".into()
    }
}

/// A file that cannot be read.
#[derive(Debug, Error)]
#[error("{file}: {problem}", file = file.display())]
struct Unreadable {
    file: PathBuf,
    problem: InputProblem,
}

impl Diagnostic for Unreadable {
    fn remedy(&self) -> String {
        self.problem.remedy()
    }
}

fn open(stated: &Stated<'_>) -> Result<Arc<dyn Source>, Failure> {
    let file = stated.path.to_owned();
    let extension = file.extension().unwrap_or_default();
    let ends_in = |wanted: &str| extension.eq_ignore_ascii_case(wanted);
    let found = input::format_of(&file).map_err(|problem| Unreadable {
        file: file.clone(),
        problem,
    })?;
    let effects = |file: PathBuf, kind| -> Arc<dyn Source> {
        Arc::new(Effects {
            file,
            kind,
            options: effects::Options::default(),
        })
    };
    Ok(match found {
        Some(Format::Hatt) => Arc::new(Hatt::new(file)),
        Some(Format::Model) => Arc::new(ModelFile { file }),
        Some(Format::Ahap) => effects(file, effects::Kind::Ahap),
        Some(Format::Haptic) => effects(file, effects::Kind::Haptic),
        Some(Format::Hjif) => effects(file, effects::Kind::Hjif),
        // What is damaged is refused by the reader of what it is called, which knows best.
        _ if ends_in("xml") => Arc::new(Hatt::new(file)),
        _ if ends_in("json") => Arc::new(ModelFile { file }),
        _ if ends_in("ahap") => effects(file, effects::Kind::Ahap),
        _ if ends_in("haptic") => effects(file, effects::Kind::Haptic),
        _ if ends_in("hjif") => effects(file, effects::Kind::Hjif),
        Some(format) => {
            let what = format!("it is {}", format.name());
            return Err(Unknown { file, what }.into());
        }
        None => {
            let what = "it is of no known format".into();
            return Err(Unknown { file, what }.into());
        }
    })
}

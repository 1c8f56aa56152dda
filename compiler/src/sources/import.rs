//! Files of other tools; the kind is detected from the file.

use super::{
    Source,
    effects::{self, Effects},
    hatt::Hatt,
    kind::{Kind, Operand, Stated},
    model_file::ModelFile,
};
use crate::passes::reduce::Fidelity;
use asperity_io::{
    diagnostic::{Diagnostic, Failure},
    input::{self, Format, InputError, InputProblem},
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

/// A file of no format that is known.
#[derive(Debug, Error)]
#[error("{}: unknown format; must be {WANTED}", .0.display())]
struct Unknown(PathBuf);

impl Diagnostic for Unknown {
    fn remedy(&self) -> String {
        "correct the path, or convert the file to one of these".into()
    }
}

fn open(stated: &Stated<'_>) -> Result<Arc<dyn Source>, Failure> {
    let file = stated.path.to_owned();
    let extension = file.extension().unwrap_or_default();
    let ends_in = |wanted: &str| extension.eq_ignore_ascii_case(wanted);
    let found = input::format_of(&file).map_err(|problem| InputError {
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
    let by_format = found.and_then(effects::Kind::of_format);
    let by_name = effects::Kind::of_name(&file);
    Ok(match (found, by_format, by_name) {
        (Some(Format::Hatt), ..) => Arc::new(Hatt::new(file)),
        (Some(Format::Model), ..) => Arc::new(ModelFile { file }),
        (_, Some(kind), _) => effects(file, kind),
        // What is damaged is refused by the reader of what it is called, which knows best.
        _ if ends_in("xml") => Arc::new(Hatt::new(file)),
        _ if ends_in("json") => Arc::new(ModelFile { file }),
        (.., Some(kind)) => effects(file, kind),
        (Some(format), ..) => {
            let wanted = WANTED.into();
            let problem = InputProblem::OtherFormat { format, wanted };
            return Err(InputError { file, problem }.into());
        }
        (None, ..) => return Err(Unknown(file).into()),
    })
}

//! `asperity record-check`.

use crate::cli::RecordCheck;
use asperity::sources::recording;
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Diagnostic, Failures, one},
    output::{Outputs, display},
    shown::counted,
};
use asperity_recording::{
    Problem, RecordingError,
    check::{Checked, Severity},
    description::{FILE_NAME, is_absent, propose},
};
use serde_json::json;
use std::path::PathBuf;
use thiserror::Error;

/// The check found faults; its report has them.
#[derive(Debug, Error)]
#[error("{}: {}", folder.display(), counted(*count, "fault", "faults"))]
struct Faulty {
    folder: PathBuf,
    count: usize,
}

impl Diagnostic for Faulty {
    fn remedy(&self) -> String {
        "the report gives a remedy after each arrow; docs/recording-faults.md explains each fault"
            .into()
    }
}

/// There is no draft to write.
#[derive(Debug, Error)]
enum NoDraft {
    #[error("{}: already exists", _0.display())]
    Exists(PathBuf),
    #[error("{}: cannot be read as a folder: {_1}", _0.display())]
    Folder(PathBuf, std::io::Error),
    #[error("{}: the folder holds no .csv, .tsv, .txt, .wav or .npy file", _0.display())]
    NoFiles(PathBuf),
}

impl Diagnostic for NoDraft {
    fn remedy(&self) -> String {
        match self {
            Self::Exists(_) => {
                "edit it, or remove it to have a new draft written; without --init it is checked"
                    .into()
            }
            Self::Folder(..) => "give the folder that holds the sensor files".into(),
            Self::NoFiles(_) => "copy the sensor files into the folder first".into(),
        }
    }
}

/// Writes the draft of a description.
fn init(args: &RecordCheck, console: Console) -> Result<(), Failures> {
    std::fs::read_dir(&args.folder)
        .map_err(|error| one(NoDraft::Folder(args.folder.clone(), error)))?;
    let path = args.folder.join(FILE_NAME);
    if !is_absent(&args.folder) {
        return Err(one(NoDraft::Exists(path)));
    }
    let draft = propose(&args.folder).map_err(one)?;
    let draft = draft.ok_or_else(|| one(NoDraft::NoFiles(args.folder.clone())))?;
    if draft.files == 0 {
        let proposal = Some(draft);
        let problem = Problem::NoDescription { proposal };
        return Err(one(RecordingError::of(&args.folder, problem)));
    }
    let draft = draft.text;
    let mut outputs = Outputs::beside([&args.folder]);
    let file = outputs.open(&path).map_err(one)?;
    outputs.fill(file, draft.as_bytes()).map_err(one)?;
    outputs.commit().map_err(one)?;
    let open: Vec<&str> = draft.lines().filter(|line| line.contains('#')).collect();
    if args.json {
        let report = json!({ "output": display(&path).to_string(), "open": open });
        return console.json(&report).map_err(one);
    }
    let mut text = format!("{}: written; look at\n", display(&path));
    for line in open {
        text += &format!("  {}\n", line.trim());
    }
    console.report(&text).map_err(one)
}

pub(crate) fn run(args: &RecordCheck, console: Console) -> Result<(), Failures> {
    if args.init {
        return init(args, console);
    }
    let checked = match recording::check(&args.folder) {
        Ok((_, checked, _)) => checked,
        Err(error) => {
            if let Problem::NoDescription {
                proposal: Some(proposal),
            } = &error.problem
                && proposal.files > 0
                && !args.json
            {
                console.text(&proposal.text).map_err(one)?;
            }
            return Err(one(error));
        }
    };
    let printed = if args.json {
        let json = serde_json::to_value(&checked).unwrap_or_default();
        console.json(&json)
    } else {
        console.text(&checked.to_string())
    };
    printed.map_err(one)?;
    let count = faults(&checked);
    if count > 0 {
        let folder = args.folder.clone();
        return Err(one(Faulty { folder, count }));
    }
    Ok(())
}

fn faults(checked: &Checked) -> usize {
    checked.at_least(Severity::Fault).count()
}

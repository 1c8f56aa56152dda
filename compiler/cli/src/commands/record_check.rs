//! `asperity record-check`.

use crate::cli::RecordCheck;
use asperity::recording;
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Diagnostic, Failures, one},
    shown::counted,
};
use asperity_recording::{
    Problem,
    check::{Checked, Severity},
};
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

pub(crate) fn run(args: &RecordCheck, console: Console) -> Result<(), Failures> {
    let checked = match recording::check(&args.folder) {
        Ok((_, checked, _)) => checked,
        Err(error) => {
            if let Problem::NoDescription {
                proposal: Some(proposal),
            } = &error.problem
                && !args.json
            {
                console.text(proposal).map_err(one)?;
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

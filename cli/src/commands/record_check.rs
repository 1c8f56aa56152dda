//! `asperity record-check`.

use crate::cli::RecordCheck;
use asperity::sources::recording;
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Failures, Fault, one},
    output::{Outputs, display},
    shown::counted,
};
use asperity_recording::{
    check::{Checked, Severity},
    description::{FILE_NAME, is_absent, no_description, propose},
};
use serde_json::json;

/// Writes the draft of a description.
fn init(args: &RecordCheck, console: Console) -> Result<(), Failures> {
    let refused = |what: &str, remedy: &str| one(Fault::new(what, remedy).at(&args.folder));
    std::fs::read_dir(&args.folder).map_err(|error| {
        let what = format!("cannot be read as a folder: {error}");
        refused(&what, "give the folder that holds the sensor files")
    })?;
    let path = args.folder.join(FILE_NAME);
    if !is_absent(&args.folder) {
        let remedy =
            "edit it, or remove it to have a new draft written; without --init it is checked";
        return Err(one(Fault::new("already exists", remedy).at(path)));
    }
    let draft = propose(&args.folder).map_err(one)?;
    let draft = draft.ok_or_else(|| {
        let what = "the folder holds no .csv, .tsv, .txt, .wav or .npy file";
        refused(what, "copy the sensor files into the folder first")
    })?;
    if draft.files == 0 {
        return Err(one(no_description(&args.folder, Some(&draft))));
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
            if !args.json
                && is_absent(&args.folder)
                && let Ok(Some(proposal)) = propose(&args.folder)
                && proposal.files > 0
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
        let remedy = "the report gives a remedy after each arrow; docs/recording-faults.md explains each fault";
        let fault = Fault::new(counted(count, "fault", "faults"), remedy);
        return Err(one(fault.at(&args.folder)));
    }
    Ok(())
}

fn faults(checked: &Checked) -> usize {
    checked.at_least(Severity::Fault).count()
}

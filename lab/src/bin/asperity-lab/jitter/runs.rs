//! Runs that were measured: merged, compared, and drawn over each other.

use super::{Foreign, measure::LOG_OF_A_RUN};
use crate::error::Plain;
use asperity_console::Console;
use asperity_host::latency::{self, Run, is_log, read_log, write_log};
use asperity_io::{
    diagnostic::{Diagnostic as _, Failures, one},
    input::{self, InputError, InputKind},
    output::{Outputs, display},
};
use asperity_lab::jitter::{
    draw_overlay, encode_runs, encode_shifts, read_foreign, shifts, side_by_side,
};
use std::path::{Path, PathBuf};

/// The file of a run: its interval log, where the folder of `jitter --output` is given.
fn file_of(path: &Path) -> PathBuf {
    if path.is_dir() {
        path.join(LOG_OF_A_RUN)
    } else {
        path.to_owned()
    }
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, Failures> {
    input::read(path, InputKind::Log).map_err(|problem| {
        let file = path.to_owned();
        one(InputError { file, problem })
    })
}

/// Reads an interval log of ours, or latencies that another tool counted.
fn read(path: &Path, foreign: &Foreign, console: Console) -> Result<Run, Failures> {
    let path = &file_of(path);
    let bytes = bytes_of(path)?;
    if is_log(&bytes) {
        return log_of(path, &bytes);
    }
    let text = input::text(&bytes).map_err(|problem| {
        let file = path.to_owned();
        one(InputError { file, problem })
    })?;
    let column = foreign.column.as_deref();
    let read = read_foreign(text, foreign.stage.into(), column, foreign.unit)
        .map_err(|error| Plain::failure(format!("{}: {error}", path.display()), error.remedy()))?;
    for note in &read.notes {
        console.warn(&format!("{}: {note}", path.display()));
    }
    Ok(read.run)
}

fn log_of(path: &Path, bytes: &[u8]) -> Result<Run, Failures> {
    read_log(bytes).map_err(|error| {
        Plain::failure(
            format!("{}: {error}", path.display()),
            "give a run.hlog that `asperity-lab jitter -o` wrote",
        )
    })
}

pub(super) fn compare(
    [a, b]: [&Path; 2],
    seed: u64,
    foreign: &Foreign,
    json: bool,
    console: Console,
) -> Result<(), Failures> {
    let shifted = latency::compare(
        &read(a, foreign, console)?,
        &read(b, foreign, console)?,
        seed,
    );
    if json {
        console.json(&encode_shifts(&shifted)).map_err(one)
    } else {
        console.text(&shifts(&shifted)).map_err(one)
    }
}

pub(super) fn overlay(
    files: &[PathBuf],
    output: &Path,
    foreign: &Foreign,
    json: bool,
    console: Console,
) -> Result<(), Failures> {
    let stage = foreign.stage.into();
    let mut outputs = Outputs::beside(files);
    let picture = outputs.open(output).map_err(one)?;
    let console = console.beside(&outputs);
    let mut runs = Vec::new();
    for file in files {
        let run = read(file, foreign, console)?;
        if run.raw(stage).is_empty() {
            return Err(Plain::failure(
                format!("{}: it has no times of that stage", file.display()),
                "choose another: --stage NAME",
            ));
        }
        runs.push((file.display().to_string(), run));
    }
    let drawn = draw_overlay(&runs, stage);
    let drawn = drawn.map_err(|error| Plain::failure(error, "report this as a bug"))?;
    outputs.fill(picture, &drawn).map_err(one)?;
    outputs.commit().map_err(one)?;
    if json {
        console.json(&encode_runs(&runs, stage)).map_err(one)
    } else {
        console
            .result_of(true, &side_by_side(&runs, stage))
            .map_err(one)
    }
}

pub(super) fn merge(logs: &[PathBuf], output: &Path, console: Console) -> Result<(), Failures> {
    let mut outputs = Outputs::beside(logs);
    let file = outputs.open(output).map_err(one)?;
    let console = console.beside(&outputs);
    let mut runs = logs.iter().map(|path| {
        let path = file_of(path);
        log_of(&path, &bytes_of(&path)?)
    });
    let Some(first) = runs.next() else {
        return Ok(());
    };
    let mut merged = first?;
    for (run, path) in runs.zip(&logs[1..]) {
        let run = run?;
        if run.facts.period_ns != merged.facts.period_ns {
            return Err(Plain::failure(
                format!(
                    "{}: the period is {} µs, but {} µs in the first log",
                    path.display(),
                    run.facts.period_ns as f64 / 1e3,
                    merged.facts.period_ns as f64 / 1e3
                ),
                "merge runs of the same rate; use `asperity-lab jitter compare` for different rates",
            ));
        }
        merged.merge(run);
    }
    let bytes =
        write_log(&merged).map_err(|error| Plain::failure(error, "report this as a bug"))?;
    outputs.fill(file, &bytes).map_err(one)?;
    outputs.commit().map_err(one)?;
    let ticks = merged.facts.ticks;
    console
        .report(&format!(
            "{}: merged {} runs, {ticks} ticks\n",
            display(output),
            logs.len()
        ))
        .map_err(one)
}

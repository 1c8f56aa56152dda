//! Compares percentiles over all materials of the reference corpus with those of a
//! user's own copy of HaTT, as a Markdown table.
//!
//! `cargo run --release -p asperity-corpus --example calibration -- HATT_FOLDER`
//!
//! It prints only aggregates over 20 materials or more, and nothing of a single HaTT material.

use asperity_corpus::{
    reference::{self, ReferenceOptions},
    statistics::{self, NAMES, Statistics},
};
use std::{path::PathBuf, process::ExitCode};

const SHARES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];
const LEAST_MATERIALS: usize = 20;

fn main() -> ExitCode {
    let Some(folder) = std::env::args_os().nth(1).map(PathBuf::from) else {
        eprintln!("usage: calibration HATT_FOLDER");
        return ExitCode::from(2);
    };
    match tables(&folder) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn tables(folder: &std::path::Path) -> Result<(), String> {
    let options = ReferenceOptions {
        instances: 0,
        ..ReferenceOptions::default()
    };
    let (corpus, _) = reference::load(&options).map_err(|error| error.to_string())?;
    let ours: Vec<Statistics> = corpus
        .materials
        .iter()
        .filter_map(|m| statistics::of_grid(&statistics::grid_of(&m.prototype, &corpus), m.mu))
        .collect();
    let files = asperity::hatt::files(folder).map_err(|error| error.to_string())?;
    let theirs: Vec<Statistics> = files
        .iter()
        .map(|file| {
            let bytes = std::fs::read(file).map_err(|error| error.to_string())?;
            let material =
                asperity::hatt::parse(file, &bytes).map_err(|error| error.to_string())?;
            let texture = asperity::hatt::to_model(&material, "", 0);
            Ok(statistics::of_grid(&texture.grid, texture.friction.mu))
        })
        .collect::<Result<Vec<_>, String>>()?
        .into_iter()
        .flatten()
        .collect();
    if theirs.len() < LEAST_MATERIALS {
        return Err(format!(
            "{} materials with enough models, at least {LEAST_MATERIALS} are aggregated",
            theirs.len()
        ));
    }
    println!(
        "| percentile over materials | corpus | 5 % | 25 % | 50 % | 75 % | 95 % |\n|---|---|---|---|---|---|---|"
    );
    for (index, name) in NAMES.iter().enumerate() {
        for (label, all) in [("HaTT", &theirs), ("reference", &ours)] {
            let mut values: Vec<f64> = all.iter().map(|s| s.values[index]).collect();
            let cells: Vec<String> = SHARES
                .iter()
                .map(|&share| format!("{:.2}", statistics::percentile(&mut values, share)))
                .collect();
            println!(
                "| {name} | {label} ({}) | {} |",
                all.len(),
                cells.join(" | ")
            );
        }
    }
    Ok(())
}

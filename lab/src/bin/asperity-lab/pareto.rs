//! `asperity-lab pareto`: cost and error of every way to render.

use std::path::{Path, PathBuf};

use asperity::sources::hatt;
use asperity_console::Console;
use asperity_experiments::pareto::cortex_m::{self, CortexM};
use asperity_experiments::pareto::measure::{Options, Results, measure, steps};
use asperity_experiments::pareto::{chart, json, markdown, material};
use asperity_io::diagnostic::{Failures, one};
use asperity_io::input::{self, InputError, InputKind};
use asperity_io::output;

use crate::error::{Plain, all};

/// Measure the trade-off between speed and accuracy over many materials
///
/// Every design factor of the tick is varied from its default, alone and in some combinations.
/// Errors are relative to the f64 oracle, at rest and in motion. The same seed gives the same
/// tables.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab pareto -o charts                      the reference corpus
  asperity-lab pareto --hatt hatt/models -o charts   your own copy of the HaTT
  asperity-lab pareto --quick --json                    a few materials, no counting

Writes tables.md, and charts as .png. If valgrind is installed, it counts the instructions per
tick, at the most common orders of the materials. --cortex-m adds the counts of a firmware
bench (factor,name,instructions).")]
pub(crate) struct Arguments {
    /// Folder of HaTT models [default: the reference corpus]
    #[arg(long, value_name = "DIR")]
    hatt: Option<PathBuf>,
    /// Folder to write tables and charts to; created if its parent exists
    #[arg(short = 'o', long = "output", alias = "out", value_name = "DIR")]
    out: Option<PathBuf>,
    /// Quick run of less than a minute: six materials, half a second of motion, no counting
    #[arg(long)]
    quick: bool,
    /// Instructions per tick on a Cortex-M4F, CSV: factor,name,instructions
    #[arg(long, value_name = "FILE.csv")]
    cortex_m: Option<PathBuf>,
    /// Seed of motions and excitations
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Materials of a quick run.
const QUICK: usize = 6;

pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    let cortex_m = match &arguments.cortex_m {
        None => CortexM::new(),
        Some(path) => read_counts(path)?,
    };
    let mut textures = match &arguments.hatt {
        Some(folder) => material::hatt(folder).map_err(one)?,
        None => material::corpus().map_err(one)?,
    };
    if arguments.quick {
        // Spread over the list, so that families differ.
        let step = textures.len().div_ceil(QUICK);
        textures = textures.into_iter().step_by(step).collect();
    }
    let options = Options {
        seed: arguments.seed,
        seconds: if arguments.quick { 0.5 } else { 4.0 },
        instructions: !arguments.quick,
    };
    let bar = console.bar(steps(textures.len()), "measuring");
    let results = measure(&textures, &options, || bar.inc(1)).map_err(one)?;
    bar.finish_and_clear();
    let written = match &arguments.out {
        Some(folder) => {
            inputs(arguments).and_then(|inputs| write(folder, &inputs, &results, &cortex_m))
        }
        None => Ok(()),
    };
    if let Some(reason) = &results.not_counted {
        console.warn(&format!(
            "instructions were not counted: {reason}; install valgrind"
        ));
    }
    let printed = if arguments.json {
        console.json(&json::encode(&results))
    } else {
        let wrote = arguments.out.is_some() && written.is_ok();
        console.result_of(wrote, &report(&results))
    };
    all([written, printed.map_err(one)])
}

/// The files that are read, which no table or chart may replace.
fn inputs(arguments: &Arguments) -> Result<Vec<PathBuf>, Failures> {
    let mut inputs: Vec<PathBuf> = arguments.cortex_m.iter().cloned().collect();
    if let Some(folder) = &arguments.hatt {
        inputs.extend(hatt::files(folder).map_err(one)?);
    }
    Ok(inputs)
}

fn read_counts(path: &Path) -> Result<CortexM, Failures> {
    let fail = |error: &dyn std::fmt::Display| {
        Plain::failure(
            format!("{}: {error}", path.display()),
            "give a CSV with the columns factor,name,instructions",
        )
    };
    let bytes = input::read(path, InputKind::Counts).map_err(|problem| {
        let file = path.to_owned();
        one(InputError { file, problem })
    })?;
    cortex_m::read(&bytes).map_err(|error| fail(&error))
}

fn write(
    folder: &Path,
    inputs: &[PathBuf],
    results: &Results,
    cortex_m: &CortexM,
) -> Result<(), Failures> {
    let mut files = vec![(
        "tables.md",
        markdown::tables(results, cortex_m).into_bytes(),
    )];
    files.extend(chart::all(results).map_err(|e| Plain::failure(e, "report this"))?);
    let named: Vec<(String, &[u8])> = files
        .iter()
        .map(|(name, bytes)| ((*name).to_owned(), bytes.as_slice()))
        .collect();
    output::write_folder_beside(inputs, folder, &named).map_err(one)
}

/// A short report for a person.
fn report(results: &Results) -> String {
    use std::fmt::Write as _;
    let mut text = format!(
        "{} materials; {:<24} {:<30} {:>9} {:>7} {:>23} {:>9}\n",
        results.materials.len(),
        "factor",
        "design",
        "instr.",
        "bytes",
        "dB: median, p95, max",
        "unstable"
    );
    for summary in &results.summaries {
        let number = |value: Option<f64>| value.map_or("–".into(), |v| format!("{v:.0}"));
        let errors = summary.distortion_db.map_or("–".into(), |d| {
            format!("{:.3} {:.3} {:.3}", d.median, d.p95, d.max)
        });
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:<24} {:<30} {:>9} {:>7} {errors:>23} {:>8.3}%",
            summary.variant.factor.name(),
            summary.variant.name,
            number(summary.instructions),
            number(summary.bytes.map(|b| b as f64)),
            100.0 * summary.unstable
        );
    }
    let within = results.kept.iter().filter(|k| k.is_within_budget()).count();
    let halved = results
        .kept
        .iter()
        .filter(|k| k.ratio().is_some_and(|r| r <= 0.5))
        .count();
    let counted = results.kept.iter().filter(|k| k.ratio().is_some()).count();
    let _ = writeln!(
        text,
        "fidelity auto: {within} of {} within the budget; instructions halved for {halved} of {counted}",
        results.kept.len()
    );
    text
}

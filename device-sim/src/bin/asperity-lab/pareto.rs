//! `asperity-lab pareto`: cost and error of every way to render.

use std::path::{Path, PathBuf};

use asperity::input::{self, InputError, Kind};
use asperity::output;
use asperity::progress;
use asperity_sim::labs::cortex_m::{self, CortexM};
use asperity_sim::labs::held_out::summaries;
use asperity_sim::labs::pareto::{Options, Results, measure, steps};
use asperity_sim::labs::{chart, json, markdown, material, table};

use crate::error::{Failure, Plain, boxed, print};

/// Measure speed against accuracy over many materials
///
/// Every factor of the tick is varied alone from the default, and some together. Errors are
/// against the f64 oracle, at rest and moving; measured models are predicted from their
/// neighbours. The same seed gives the same tables.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab pareto --out charts                      the reference corpus
  asperity-lab pareto --hatt hatt/models --out charts   your own copy of the HaTT
  asperity-lab pareto --quick --json                    a few materials, no counting

Writes summary.csv, designs.csv, held-out.csv, fidelity.csv, their tables.md, and charts as
.svg and .png. Instructions a tick are counted by valgrind where it is installed, at the
orders that most of the materials have. A firmware bench's counts (factor,name,instructions)
are added by --cortex-m.")]
pub(crate) struct Arguments {
    /// Folder of HaTT models; the reference corpus without it
    #[arg(long, value_name = "DIR")]
    hatt: Option<PathBuf>,
    /// Folder for tables and charts; made if its parent exists
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Six materials, half a second of motion, nothing counted: below a minute
    #[arg(long)]
    quick: bool,
    /// Time every kernel beside the default: depends on the machine
    #[arg(long)]
    time: bool,
    /// Instructions a tick on a Cortex-M4F, CSV: factor,name,instructions
    #[arg(long, value_name = "FILE.csv")]
    cortex_m: Option<PathBuf>,
    /// Seed of motions and excitations
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// No progress on the terminal
    #[arg(long, short)]
    quiet: bool,
}

/// Materials of a quick run.
const QUICK: usize = 6;

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let cortex_m = match &arguments.cortex_m {
        None => CortexM::new(),
        Some(path) => read_counts(path)?,
    };
    let mut textures = match &arguments.hatt {
        Some(folder) => material::hatt(folder).map_err(boxed)?,
        None => material::corpus().map_err(boxed)?,
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
        time: arguments.time,
    };
    let bar = progress::bar(arguments.quiet, steps(textures.len()), "measuring");
    let results = measure(&textures, &options, || bar.inc(1));
    bar.finish_and_clear();
    if let Some(folder) = &arguments.out {
        write(folder, &results, &cortex_m)?;
    }
    if let Some(reason) = &results.not_counted {
        eprintln!("warning: no instructions counted: {reason}; install valgrind");
    }
    if arguments.json {
        return print(&format!("{:#}\n", json::encode(&results)));
    }
    print(&report(&results))
}

fn read_counts(path: &Path) -> Result<CortexM, Failure> {
    let fail = |error: &dyn std::fmt::Display| {
        Plain::boxed(
            format!("{}: {error}", path.display()),
            "give a CSV with the columns factor,name,instructions",
        )
    };
    let bytes = input::read(path, Kind::Counts).map_err(|problem| {
        let file = path.to_owned();
        boxed(InputError { file, problem })
    })?;
    cortex_m::read(&bytes).map_err(|error| fail(&error))
}

fn write(folder: &Path, results: &Results, cortex_m: &CortexM) -> Result<(), Failure> {
    let held_out = summaries(&results.held_out);
    let encode = |result: Result<Vec<u8>, csv::Error>| {
        result.map_err(|error| Plain::boxed(error, "report this"))
    };
    let mut files = vec![
        (
            "summary.csv".to_owned(),
            encode(table::summary(results, cortex_m))?,
        ),
        ("designs.csv".to_owned(), encode(table::designs(results))?),
        (
            "held-out.csv".to_owned(),
            encode(table::held_out(&held_out))?,
        ),
        ("fidelity.csv".to_owned(), encode(table::fidelity(results))?),
        (
            "tables.md".to_owned(),
            markdown::tables(results, &held_out, cortex_m).into_bytes(),
        ),
    ];
    for (name, picture) in
        chart::all(results, &held_out).map_err(|e| Plain::boxed(e, "report this"))?
    {
        files.push((format!("{name}.svg"), picture.svg.into_bytes()));
        files.push((format!("{name}.png"), picture.png));
    }
    let named: Vec<(String, &[u8])> = files
        .iter()
        .map(|(name, bytes)| (name.clone(), bytes.as_slice()))
        .collect();
    output::write_folder(folder, &named).map_err(boxed)
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

//! `asperity-lab jitter`: latency and jitter of a servo loop.

mod measure;
mod runs;

use std::path::PathBuf;

use asperity_console::Console;
use asperity_host::device::Uri;
use asperity_host::latency::Injection;
use asperity_host::servo::Stage;
use asperity_io::diagnostic::Failures;
use asperity_lab::jitter::Unit;

use crate::loop_options::{LoopOptions, within};

/// Inputs accepted by `compare` and `overlay`.
const FILES: &str =
    "A run is a folder that `asperity-lab jitter -o` wrote or the run.hlog in it, a percentile
distribution (.hgrm, or the report of wrk2), what `cyclictest -h 1000` writes with or without --json, the table of
`rtla timerlat hist`, or CSV with a latency in each line.";

/// Measure the latency and jitter of a servo loop
///
/// The times to wake up, read, compute and write are collected for every tick in HdrHistograms, both
/// as recorded and corrected for coordinated omission. The report lists the ten worst ticks with the
/// stage that took longest.
#[derive(Debug, clap::Args)]
#[command(args_conflicts_with_subcommands = true)]
#[command(after_help = "Examples:
  asperity-lab jitter                                  10 s at 1 kHz without a device
  asperity-lab jitter --seconds 100 --rate 10000 --cpu 1 --cyclictest -o run
  asperity-lab jitter brick.asp --device sim: --json
  asperity-lab jitter --inject compute:300:1000        does the report find a delay of 300 µs?
  asperity-lab jitter --seconds 60 --max-us 500 --max-missed 0 --series ticks.csv
  asperity-lab jitter merge monday.hlog tuesday.hlog -o both.hlog
  asperity-lab jitter compare calm loaded
  asperity-lab jitter overlay calm loaded cyclictest.json -o overlay.png

With --output: run.json, percentiles.csv, jitter.png, run.hlog (an interval log), and a percentile
distribution (.hgrm) of every stage, raw and corrected, as HdrHistogram's own tools read them.")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    options: LoopOptions,
    /// Device to read and drive; the default is no device, resting 1 mm deep in the texture
    #[arg(long, value_name = "URI", default_value = "null:?z_mm=-1")]
    device: Uri,
    /// Duration of the measurement, s (0.1 to 86400)
    #[arg(long, value_name = "S", value_parser = within(0.1..=86_400.0, " s"), default_value = "10")]
    seconds: f64,
    /// Inject a delay into one tick in EVERY, to test the measurement: STAGE:MICROSECONDS:EVERY
    #[arg(long, value_name = "DELAY")]
    inject: Option<Injection>,
    /// Also run cyclictest (from rt-tests) at the same time, for comparison
    #[arg(long)]
    cyclictest: bool,
    /// Exit with status 1 if a force is written more than this many µs after its tick is due
    #[arg(long, value_name = "US", value_parser = microseconds)]
    max_us: Option<f64>,
    /// Exit with status 1 if more than this many periods are missed
    #[arg(long, value_name = "N")]
    max_missed: Option<u64>,
    /// Write every tick as a line of CSV: period, time, missed periods, and each stage in ns
    #[arg(long, value_name = "FILE.csv")]
    series: Option<PathBuf>,
    /// Folder to write all files to; created if its parent exists
    #[arg(short = 'o', long = "output", alias = "out", value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace a run that the folder of --output holds
    #[arg(long, requires = "out")]
    force: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
    /// Merge the interval logs of several runs into one
    Merge {
        /// Runs to merge: folders of --output, or the run.hlog in them
        #[arg(required = true, num_args = 2..)]
        logs: Vec<PathBuf>,
        /// The merged log; `-` is standard output
        #[arg(long, short, value_name = "OUT.hlog")]
        output: PathBuf,
    },
    /// Compare two runs: the shift of every percentile, with its confidence interval
    #[command(after_help = FILES)]
    Compare {
        /// First run
        a: PathBuf,
        /// Second run
        b: PathBuf,
        /// Seed of the bootstrap
        #[arg(long, default_value_t = 1)]
        seed: u64,
        #[command(flatten)]
        foreign: Foreign,
        /// Print JSON
        #[arg(long)]
        json: bool,
    },
    /// Draw the percentiles of any number of runs over each other
    #[command(after_help = FILES)]
    Overlay {
        /// Runs
        #[arg(required = true)]
        runs: Vec<PathBuf>,
        /// The picture, PNG; `-` is standard output
        #[arg(long, short, value_name = "OUT.png")]
        output: PathBuf,
        #[command(flatten)]
        foreign: Foreign,
        /// Print JSON
        #[arg(long)]
        json: bool,
    },
}

/// Options for files written by other tools.
#[derive(Debug, clap::Args)]
struct Foreign {
    /// Stage that is drawn, and that files of other tools measured
    #[arg(long, value_enum, default_value = "wakeup")]
    stage: StageName,
    /// Column of CSV files [default: that of the stage, or the only one]
    #[arg(long, value_name = "NAME")]
    column: Option<String>,
    /// Unit of files that do not state theirs: ns, us, ms or s [default: us]
    #[arg(long)]
    unit: Option<Unit>,
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum StageName {
    /// From due to running
    Wakeup,
    /// Reading the device
    Read,
    /// The runtime's tick
    Compute,
    /// Writing the force
    Write,
    /// From due to written
    Total,
    /// From one wake-up to the next
    Interval,
}

impl From<StageName> for Stage {
    fn from(name: StageName) -> Self {
        match name {
            StageName::Wakeup => Self::WakeUp,
            StageName::Read => Self::Read,
            StageName::Compute => Self::Compute,
            StageName::Write => Self::Write,
            StageName::Total => Self::Total,
            StageName::Interval => Self::Interval,
        }
    }
}

fn microseconds(text: &str) -> Result<f64, String> {
    let us: f64 = text.parse().map_err(|_| "a number of µs".to_owned())?;
    if us > 0.0 && us.is_finite() {
        Ok(us)
    } else {
        Err("a number of µs above 0".into())
    }
}

pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    match &arguments.command {
        None => measure::measure(arguments, console),
        Some(Command::Merge { logs, output }) => runs::merge(logs, output, console),
        Some(Command::Compare {
            a,
            b,
            seed,
            foreign,
            json,
        }) => runs::compare([a, b], *seed, foreign, *json, console),
        Some(Command::Overlay {
            runs,
            output,
            foreign,
            json,
        }) => runs::overlay(runs, output, foreign, *json, console),
    }
}

//! `asperity-lab jitter`: how punctual a servo loop is.

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering::Relaxed;
use std::thread::sleep;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use asperity_console::Console;
use asperity_host::device::Uri;
use asperity_host::latency::{
    Collector, Conditions, Cyclictest, CyclictestError, Injection, Load, Loading, Machine, Run,
    Wakeups, compare, percentile_distribution, read_log, write_log,
};
use asperity_host::servo::{Clock as _, Event, Inlet, SECOND_NS, Settings, Stage, queues};
use asperity_io::diagnostic::{Failures, one};
use asperity_io::input::{self, InputError, Kind};
use asperity_io::output::{self, Outputs, display};
use asperity_io::system;
use asperity_lab::jitter::{draw, encode, encode_shifts, percentiles, report, shifts};
use asperity_lab::servo_session::{Setup, run as run_loop};

use crate::error::Plain;
use crate::loop_options::{self, LoopOptions, refusals, stop_on_interrupt};

/// Measure the latency and jitter of a servo loop
///
/// The times to wake up, read, compute and write are collected for every tick in HdrHistograms, both
/// as recorded and corrected for coordinated omission. The report lists the ten worst ticks with the
/// stage that took longest.
#[derive(Debug, clap::Args)]
#[command(args_conflicts_with_subcommands = true)]
#[command(after_help = "Examples:
  asperity-lab jitter                                  10 s at 1 kHz without a device
  asperity-lab jitter --seconds 100 --rate 10000 --cpu 1 --cyclictest --out run
  asperity-lab jitter brick.asp --device sim: --load memory --json
  asperity-lab jitter --inject compute:300:1000        does the report find a delay of 300 µs?
  asperity-lab jitter merge monday.hlog tuesday.hlog -o both.hlog
  asperity-lab jitter compare calm/run.hlog loaded/run.hlog

With --out: run.json, percentiles.csv, jitter.png, run.hlog (an interval log), and a percentile
distribution (.hgrm) of every stage, raw and corrected, as HdrHistogram's own tools read them.")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    options: LoopOptions,
    /// Device to read and drive; the default is no device, resting 1 mm deep in the texture
    #[arg(long, value_name = "URI", value_parser = loop_options::device, default_value = "null:?z_mm=-1")]
    device: Uri,
    /// Duration of the measurement, s (0.1 to 86400)
    #[arg(long, value_name = "S", value_parser = loop_options::seconds, default_value = "10")]
    seconds: f64,
    /// Load to put on the machine during the measurement
    #[arg(long, value_enum, default_value = "none")]
    load: LoadName,
    /// Inject a delay into one tick in EVERY, to test the measurement: STAGE:MICROSECONDS:EVERY
    #[arg(long, value_name = "DELAY")]
    inject: Option<Injection>,
    /// Also run cyclictest (from rt-tests) at the same time, for comparison
    #[arg(long)]
    cyclictest: bool,
    /// Folder to write all files to; created if its parent exists
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
    /// Merge the interval logs of several runs into one
    Merge {
        /// Interval logs (run.hlog) to merge
        #[arg(required = true, num_args = 2..)]
        logs: Vec<PathBuf>,
        /// The merged log; `-` is standard output
        #[arg(long, short, value_name = "OUT.hlog")]
        output: PathBuf,
    },
    /// Compare two runs: the shift of every percentile, with its confidence interval
    Compare {
        /// Log of the first run
        a: PathBuf,
        /// Log of the second run
        b: PathBuf,
        /// Seed of the bootstrap
        #[arg(long, default_value_t = 1)]
        seed: u64,
        /// Print JSON
        #[arg(long)]
        json: bool,
    },
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum LoadName {
    /// No load
    None,
    /// One busy thread per processor
    Cpu,
    /// One thread per processor that streams through 32 MiB
    Memory,
    /// Repeated writes of 16 MiB that wait for the disk
    Disk,
    /// 32 threads with timers of 200 µs
    Timers,
}

impl From<LoadName> for Load {
    fn from(name: LoadName) -> Self {
        match name {
            LoadName::None => Self::None,
            LoadName::Cpu => Self::Cpu,
            LoadName::Memory => Self::Memory,
            LoadName::Disk => Self::Disk,
            LoadName::Timers => Self::Timers,
        }
    }
}

/// Time between two looks at the queues.
const LOOK: Duration = Duration::from_millis(20);
/// Records that fit into the queue: four seconds.
const QUEUE_S: usize = 4;
/// Intervals of a run, each at least a tenth and at most one second long.
const INTERVALS: f64 = 100.0;

pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    match &arguments.command {
        None => measure(arguments, console),
        Some(Command::Merge { logs, output }) => merge(logs, output, console),
        Some(Command::Compare { a, b, seed, json }) => {
            let shifted = compare(&read(a)?, &read(b)?, *seed);
            if *json {
                console.json(&encode_shifts(&shifted)).map_err(one)
            } else {
                console.text(&shifts(&shifted)).map_err(one)
            }
        }
    }
}

fn measure(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    let interrupt = stop_on_interrupt()?;
    let stop = &*interrupt.stop;
    let options = &arguments.options;
    let surface = options.surface()?;
    let (mut opened, rate_hz) = options.open_device(&arguments.device, &surface)?;
    let mut settings = options.settings(&opened, rate_hz, Some(arguments.seconds));
    if let Some(folder) = &arguments.out {
        check_folder(folder)?;
    }
    let folder = tempfile::tempdir().map_err(|error| {
        Plain::failure(
            format!("cannot create a temporary folder: {error}"),
            system::remedy(&error).unwrap_or("set TMPDIR to a folder that can be written"),
        )
    })?;
    let load = Load::from(arguments.load);
    let loading = Loading::start(load, folder.path()).map_err(|error| {
        Plain::failure(
            format!("cannot start the load: {error}"),
            system::remedy(&error).unwrap_or("set TMPDIR to a folder that can be written"),
        )
    })?;
    let conditions = Conditions {
        machine: Machine::now(options.cpu),
        rate_hz,
        overrun: settings.overrun.name().into(),
        spin_us: options.spin,
        granted: Vec::new(),
        refused: Vec::new(),
        device: format!("{}, {}", opened.device.description().name, arguments.device),
        texture: surface.name.clone(),
        load: load.name().into(),
        injected: arguments.inject.map(|injection| injection.to_string()),
        version: env!("CARGO_PKG_VERSION").into(),
    };

    let json = folder.path().join("cyclictest.json");
    let mut other = None;
    if arguments.cyclictest {
        let ticks = settings.periods.unwrap_or(0);
        let started = Cyclictest::start(rate_hz, ticks, options.policy, options.cpu, &json);
        other = started.map_err(|error| warn_of(&error, console)).ok();
        let now_ns = options.clock().now_ns();
        let second_ns = (now_ns / SECOND_NS + 2) * SECOND_NS;
        settings.start_ns = Some(second_ns + Cyclictest::offset_ns(rate_hz));
    }
    let setup = Setup {
        config: opened.config(rate_hz),
        settings: settings.clone(),
        clock: options.clock(),
        wanted: options.wanted(),
        injection: arguments.inject,
        seed: options.seed(&opened),
        stop,
    };
    let mut measured = None;
    let (outlet, inlet) = queues(QUEUE_S * rate_hz as usize);
    let bar = console.activity();
    bar.set_message(format!("measuring for {} s", arguments.seconds));
    run_loop(setup, &surface, &mut *opened.device, outlet, |attended| {
        for refusal in refusals(attended.grants) {
            console.warn(&refusal);
        }
        let conditions = conditions.with_grants(attended.grants);
        let collector = collector(&settings, conditions, arguments.seconds);
        let over = || attended.servo.is_finished();
        measured = Some(collect(collector, inlet, over, console));
    })
    .map_err(one)?;
    drop((opened, loading));
    interrupt.released.store(true, Relaxed);
    bar.set_message("waiting for cyclictest");
    let wakeups = other.and_then(|cyclictest| {
        let finished = if stop.load(Relaxed) {
            drop(cyclictest);
            return None;
        } else {
            cyclictest.finish(&json)
        };
        finished.map_err(|error| warn_of(&error, console)).ok()
    });
    bar.finish_and_clear();
    let Some(run) = measured else { return Ok(()) };
    tell(arguments, &run, wakeups.as_ref(), console)
}

/// Whether a folder is there or can be made, before anything is measured.
fn check_folder(folder: &Path) -> Result<(), Failures> {
    let parent = match folder.parent() {
        Some(parent) if parent.as_os_str().is_empty() => Path::new("."),
        Some(parent) => parent,
        None => folder,
    };
    if folder.is_dir() || (!folder.exists() && parent.is_dir()) {
        return Ok(());
    }
    Err(Plain::failure(
        format!(
            "{}: not a folder, and it cannot be created there",
            folder.display()
        ),
        "give a folder whose parent exists",
    ))
}

fn warn_of(error: &CyclictestError, console: Console) {
    console.warn(&format!("{error}; the measurement continues without it"));
}

fn collector(settings: &Settings, conditions: Conditions, seconds: f64) -> Collector {
    let began = SystemTime::now().duration_since(UNIX_EPOCH);
    let began_s = began.map_or(0.0, |time| time.as_secs_f64());
    let interval_s = (seconds / INTERVALS).clamp(0.1, 1.0);
    Collector::new(settings, conditions, began_s, (1e9 * interval_s) as u64)
}

/// Takes the records of a loop until it ends.
fn collect(
    mut collector: Collector,
    mut inlet: Inlet,
    over: impl Fn() -> bool,
    console: Console,
) -> Run {
    loop {
        let last = over();
        while let Some(record) = inlet.record() {
            collector.record(&record);
        }
        while let Some(event) = inlet.event() {
            match event {
                Event::Failed { period, fault } => {
                    console.warn(&format!("period {period}: {fault}"));
                }
                other => console.warn(&format!("{other:?}")),
            }
        }
        if last {
            return collector.finish(inlet.lost());
        }
        sleep(LOOK);
    }
}

fn tell(
    arguments: &Arguments,
    run: &Run,
    wakeups: Option<&Wakeups>,
    console: Console,
) -> Result<(), Failures> {
    let json = encode(run, wakeups);
    if let Some(folder) = &arguments.out {
        let mut files = vec![
            ("run.json".to_owned(), format!("{json:#}\n").into_bytes()),
            (
                "percentiles.csv".to_owned(),
                percentiles(run, wakeups).into_bytes(),
            ),
            ("jitter.png".to_owned(), draw(run, wakeups).map_err(bug)?),
            ("run.hlog".to_owned(), write_log(run).map_err(bug)?),
        ];
        for stage in Stage::ALL {
            let kinds = [("", run.raw(stage)), ("-corrected", run.corrected(stage))];
            for (kind, histogram) in kinds {
                let name = format!("{}{kind}.hgrm", stage.name());
                let text = percentile_distribution(&histogram);
                files.push((name, text.into_bytes()));
            }
        }
        let named: Vec<(String, &[u8])> = files
            .iter()
            .map(|(name, bytes)| (name.clone(), bytes.as_slice()))
            .collect();
        output::write_folder_beside(arguments.options.file.as_slice(), folder, &named)
            .map_err(one)?;
    }
    if arguments.json {
        console.json(&json).map_err(one)
    } else {
        let wrote = arguments.out.is_some();
        console.result_of(wrote, &report(run, wakeups)).map_err(one)
    }
}

fn bug(error: impl std::fmt::Display) -> Failures {
    Plain::failure(error, "report this as a bug")
}

/// Reads an interval log.
fn read(path: &Path) -> Result<Run, Failures> {
    let bytes = input::read(path, Kind::Log).map_err(|problem| {
        let file = path.to_owned();
        one(InputError { file, problem })
    })?;
    read_log(&bytes).map_err(|error| {
        Plain::failure(
            format!("{}: {error}", path.display()),
            "give a run.hlog that `asperity-lab jitter --out` wrote",
        )
    })
}

fn merge(logs: &[PathBuf], output: &Path, console: Console) -> Result<(), Failures> {
    let mut outputs = Outputs::beside(logs);
    let file = outputs.open(output).map_err(one)?;
    let console = console.beside(&outputs);
    let mut runs = logs.iter().map(|path| read(path));
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
    let bytes = write_log(&merged).map_err(bug)?;
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

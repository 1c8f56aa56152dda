//! `asperity-lab jitter`: a run is measured, written and reported.

use super::Arguments;
use std::io::{self, BufWriter};
use std::path::Path;
use std::sync::atomic::Ordering::Relaxed;
use std::thread::sleep;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use asperity_console::Console;
use asperity_host::latency::{
    Collector, Conditions, Cyclictest, CyclictestError, Limits, Machine, Run, Series, Verdict,
    Wakeups, percentile_distribution, write_log,
};
use asperity_host::servo::{Clock as _, Event, RecordReader, SECOND_NS, Settings, Stage, queues};
use asperity_io::diagnostic::{Failures, one};
use asperity_io::output::{self, AtomicFile, Outputs};
use asperity_io::{realtime, system};
use asperity_lab::jitter::{draw, encode, percentiles, report};
use asperity_lab::servo_session::{Setup, run as run_loop};
use serde_json::{Value, json};

use crate::error::{Plain, all};
use crate::loop_options::{refusals, stop_on_interrupt};

/// Time between two looks at the queues.
const LOOK: Duration = Duration::from_millis(20);
/// Records that fit into the queue: four seconds.
const QUEUE_S: usize = 4;
/// Intervals of a run, each at least a tenth and at most one second long.
const INTERVALS: f64 = 100.0;

pub(super) fn measure(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    let interrupt = stop_on_interrupt()?;
    let stop = &*interrupt.stop;
    let options = &arguments.options;
    let surface = options.surface()?;
    let (mut opened, rate_hz) = options.open_device(&arguments.device, &surface)?;
    let mut settings = options.settings(&opened, rate_hz, Some(arguments.seconds));
    if let Some(folder) = &arguments.out {
        check_folder(folder, arguments.force)?;
    }
    let mut outputs = Outputs::beside(options.file.as_slice());
    let series = outputs.open_if(arguments.series.as_deref()).map_err(one)?;
    let console = console.beside(&outputs);
    let folder = tempfile::tempdir().map_err(|error| {
        Plain::failure(
            format!("cannot create a temporary folder: {error}"),
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
        privileges: options.privileges(),
        injection: arguments.inject,
        seed: options.seed(&opened),
        stop,
    };
    let mut measured = None;
    let (record_writer, record_reader) = queues(QUEUE_S * rate_hz as usize);
    let bar = console.activity();
    bar.set_message(format!("measuring for {} s", arguments.seconds));
    run_loop(
        setup,
        &surface,
        &mut *opened.device,
        record_writer,
        |attended| {
            for refusal in refusals(attended.grants) {
                console.warn(&refusal);
            }
            let conditions = conditions.with_grants(attended.grants);
            let collector = collector(&settings, conditions, arguments.seconds);
            let over = || attended.servo.is_finished();
            let series = series.map(|id| outputs.file(id));
            measured = Some(collect(collector, record_reader, series, over, console));
        },
    )
    .map_err(one)?;
    drop(opened);
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
    let Some((run, written)) = measured else {
        return Ok(());
    };
    let series = match written.err().zip(series) {
        Some((error, id)) => Err(one(outputs.file(id).error("write", error))),
        None => outputs.commit().map_err(one),
    };
    all([tell(arguments, &run, wakeups.as_ref(), console), series])
}

/// The interval log of a run, in its folder.
pub(super) const LOG_OF_A_RUN: &str = "run.hlog";
/// The files by which a folder holds a run.
const OF_A_RUN: [&str; 2] = ["run.json", LOG_OF_A_RUN];

/// Checks before measuring that the folder exists or can be created, and that no run in it would be overwritten.
fn check_folder(folder: &Path, force: bool) -> Result<(), Failures> {
    let held = OF_A_RUN.into_iter().find(|name| folder.join(name).exists());
    if let Some(name) = held.filter(|_| !force) {
        return Err(Plain::failure(
            format!("{}: it holds a run already ({name})", folder.display()),
            "give another folder, or --force to replace the run",
        ));
    }
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

/// Takes the records of a loop until it ends, and writes them to a series where one is wanted. A
/// series that cannot be written does not end the measurement.
fn collect(
    mut collector: Collector,
    mut record_reader: RecordReader,
    series: Option<&mut AtomicFile>,
    over: impl Fn() -> bool,
    console: Console,
) -> (Run, io::Result<()>) {
    let mut written = Ok(());
    let opened = series
        .map(|file| Series::new(BufWriter::new(file)))
        .transpose();
    let mut series = opened.unwrap_or_else(|error| {
        written = Err(error);
        None
    });
    loop {
        let last = over();
        while let Some(record) = record_reader.record() {
            collector.record(&record);
            if let Some(Err(error)) = series.as_mut().map(|series| series.record(&record)) {
                written = Err(error);
                series = None;
            }
        }
        while let Some(event) = record_reader.event() {
            match event {
                Event::Failed { period, fault } => {
                    console.warn(&format!("period {period}: {fault}"));
                }
                other => console.warn(&format!("{other:?}")),
            }
        }
        if last {
            if let Some(Err(error)) = series.map(|series| series.finish().map(drop)) {
                written = Err(error);
            }
            return (collector.finish(record_reader.lost()), written);
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
    let limits = Limits {
        max_us: arguments.max_us,
        max_missed: arguments.max_missed,
    };
    let verdict = Verdict::on(run, &limits);
    let settings = realtime::settings(arguments.options.cpu);
    let mut json = encode(run, &verdict, wakeups);
    json["settings"] = json!(settings);
    let written = match &arguments.out {
        Some(folder) => write(arguments, folder, run, wakeups, &json),
        None => Ok(()),
    };
    let printed = if arguments.json {
        console.json(&json)
    } else {
        let wrote = arguments.out.is_some() && written.is_ok();
        let report = report(run, &verdict, wakeups);
        let settings = realtime::table(&settings);
        let text = format!("{report}\nthis machine, and how to change it\n{settings}");
        console.result_of(wrote, &text)
    };
    let within = if verdict.exceeded.is_empty() {
        Ok(())
    } else {
        Err(Plain::failure(
            verdict.exceeded.join("; "),
            "quiet the machine (docs/servo.md), or allow more",
        ))
    };
    all([written, printed.map_err(one), within])
}

/// Writes the folder of a run.
fn write(
    arguments: &Arguments,
    folder: &Path,
    run: &Run,
    wakeups: Option<&Wakeups>,
    json: &Value,
) -> Result<(), Failures> {
    let mut files = vec![
        ("run.json".to_owned(), format!("{json:#}\n").into_bytes()),
        (
            "percentiles.csv".to_owned(),
            percentiles(run, wakeups).into_bytes(),
        ),
        ("jitter.png".to_owned(), draw(run, wakeups).map_err(bug)?),
        (LOG_OF_A_RUN.to_owned(), write_log(run).map_err(bug)?),
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
    output::write_folder_beside(arguments.options.file.as_slice(), folder, &named).map_err(one)
}

fn bug(error: impl std::fmt::Display) -> Failures {
    Plain::failure(error, "report this as a bug")
}

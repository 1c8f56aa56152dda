//! `asperity-lab record`: a recording of a surface, from a device and an accelerometer.

mod screen;
mod session_monitor;
mod summary;

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::mpsc::sync_channel;
use std::thread::sleep;
use std::time::Duration;

use asperity_console::Console;
use asperity_formats::Asset;
use asperity_host::device::{Scheme, Uri};
use asperity_host::servo::{Pace, queues};
use asperity_io::diagnostic::{Failures, one};
use asperity_io::output::{NewFolder, OutputError, OutputId, Outputs};
use asperity_lab::capture::{
    self, About, Coverage, FILES, Plan, Reader, Sensor, SensorKind, Simulated, Take,
};
use asperity_lab::servo_session::{OpenDevice, Setup, Surface, run as run_loop, run_passive};
use asperity_recording::description::Quantity;

use crate::error::{Plain, all};
use crate::loop_options::{Interrupt, LoopOptions, stop_on_interrupt, within};
use session_monitor::{End, SessionMonitor};
use summary::Summary;

/// Record a surface: a device gives the position of the tool, an accelerometer its vibration
///
/// Prompts on the screen guide you through rest in the air, taps, and strokes at all speeds and
/// forces, and a grid shows what is covered so far. The recording ends when the grid is full, after
/// --seconds, at Ctrl-C, when device or sensor disappears, or after as much as an import keeps. It is
/// kept in each case, if device and sensor overlap for a second and the disk has room. `asperity
/// import recording DIR` compiles it into a texture.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab record oak --device 'sim:?grip=firm&hand=record' --accel sim: --seconds 60
  asperity-lab record oak --device falcon: --accel 'serial:/dev/ttyACM0?baud=921600'
  arecord -D hw:1 -f S24_3LE -r 8000 -c 3 oak.wav &
  asperity-lab record oak --device openhaptics: --accel 'wav:oak.wav?columns=ax,ay,fz&g=16&n=20'
  asperity-lab record played oak.asp --device dhd: --accel serial:/dev/ttyACM0

Devices are those of `asperity-lab servo`. Without FILE, the device applies no force and the tool
touches a real surface, so the sensor must measure the force as well. With FILE, the device renders
that texture, which is then recorded. Without FILE, sim: and replay: render the built-in texture.

Sensors:
  serial:PORT[?baud=115200&columns=t_us,ax_g,ay_g,az_g,fz_N]   lines of numbers, or a pipe of them;
                             a header line `#t_us,ax_g,ay_g,az_g` says the same as columns=
  wav:FILE?g=16[&columns=ax,ay,az,fz&n=20]   a WAV that another program is writing, with the g and
                             the newtons of full scale
  sim:[?seed=N]              an accelerometer on the tool of sim: or replay:
  serial: and wav: also take delay_ms=N, the known latency of the sensor

Limits: serial: on Linux and macOS alone, 16 columns, 1 KiB a line, 64 damaged lines in a row; wav: of
10 to 200,000 Hz, integers of 8 to 32 bits or floats of 32 or 64, one or three channels without
columns=. A sensor has 5 s for its first sample and must then send one a second. An import keeps
64 million values.

docs/recording.md describes the lines and the folder. No real sensor has been tested yet.")]
pub(crate) struct Arguments {
    /// Folder of the recording; created, and must not exist yet
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    #[command(flatten)]
    options: LoopOptions,
    /// Device that holds the tool, such as falcon:
    #[arg(long, value_name = "URI")]
    device: Uri,
    /// Accelerometer, such as serial:/dev/ttyACM0
    #[arg(long, value_name = "SENSOR")]
    accel: Sensor,
    /// Name of the material, 1 to 64 bytes [default: the name of the folder]
    #[arg(long, value_parser = name)]
    name: Option<String>,
    /// Description of the tool, such as "steel ball, 3 mm"
    #[arg(long, value_parser = name)]
    tool: Option<String>,
    /// Moving mass of the tool without the hand, kg
    #[arg(long, value_name = "KG", value_parser = mass_kg)]
    tool_mass: Option<f64>,
    /// Edges of the speed bands, mm/s
    #[arg(
        long,
        value_name = "MM_S,…",
        value_delimiter = ',',
        default_value = "20,40,80,160,300"
    )]
    speeds: Vec<f64>,
    /// Edges of the force bands, N
    #[arg(
        long,
        value_name = "N,…",
        value_delimiter = ',',
        default_value = "0.2,0.5,1,2"
    )]
    forces: Vec<f64>,
    /// Seconds of steady strokes required in each cell of the grid (0.1 to 60)
    #[arg(long, value_name = "S", default_value_t = 2.0, value_parser = within(0.1..=60.0, " s"))]
    cell_seconds: f64,
    /// Taps required in each of four bands of impact speed
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(0..=100))]
    taps: u32,
    /// Stop after this many seconds (0.1 to 86400)
    #[arg(long, value_name = "S", default_value = "900", value_parser = within(0.1..=86_400.0, " s"))]
    seconds: f64,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

/// Records that fit into the queue: four seconds.
const QUEUE_S: usize = 4;
/// Pieces of lines that wait for the thread of a simulated sensor.
const PIECES: usize = 4096;
/// Time in the air that is asked for, s.
const AIR_S: f64 = 2.0;
/// Mass that taps move where no texture says one, kg.
const MASS_KG: f64 = 0.05;

fn name(text: &str) -> Result<String, String> {
    let is_name = (1..=64).contains(&text.len()) && !text.trim().is_empty();
    if is_name && !text.chars().any(char::is_control) {
        Ok(text.to_owned())
    } else {
        Err("must have 1 to 64 bytes, and no control characters".into())
    }
}

fn mass_kg(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if value > 0.0 && value < 10.0 => Ok(value),
        _ => Err("must be above 0 and below 10 kg".into()),
    }
}

pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    let interrupt = stop_on_interrupt()?;
    let scheme = arguments.device.scheme;
    let is_simulated = matches!(scheme, Scheme::Sim | Scheme::Replay);
    if arguments.accel.kind == SensorKind::Simulated && !is_simulated {
        return Err(Plain::usage(
            "--accel sim: needs a simulated device, but --device is a real one",
            "give the accelerometer, such as --accel serial:/dev/ttyACM0, or use --device sim:",
        ));
    }
    let is_played = is_simulated || arguments.options.file.is_some();
    let coverage = Coverage::new(&arguments.speeds, &arguments.forces, arguments.cell_seconds);
    let coverage = coverage.map_err(|error| {
        let remedy = "give two or more ascending numbers with commas between them";
        Plain::usage(format!("--{error}"), remedy)
    })?;
    let material = material(arguments)?;
    let surface = is_played.then(|| arguments.options.surface()).transpose()?;
    // Dropped after the files in it.
    let folder = NewFolder::make(&arguments.folder).map_err(one)?;
    let (outputs, files) = outputs(arguments)?;

    let (to_sensor, lines) = sync_channel(PIECES);
    let reader = arguments.accel.open(lines).map_err(one)?;
    let reader = match arguments.accel.kind {
        SensorKind::Simulated => reader,
        _ => wait_for_sensor(reader, &interrupt)?,
    };
    let measures_load = reader
        .description()
        .is_some_and(|description| description.layout.load().is_some());
    if !is_played && !measures_load {
        let has_force = reader
            .description()
            .is_some_and(|description| description.layout.has(Quantity::Force));
        let what = if has_force {
            "the sensor measures a force, but not the one along z"
        } else {
            "nothing measures the force on the surface"
        };
        let remedy = "let the sensor also send fz_N, or give FILE for the device to render";
        return Err(Plain::failure(what, remedy));
    }

    let (mut opened, rate_hz) = match &surface {
        Some(surface) => arguments.options.open_device(&arguments.device, surface)?,
        None => arguments.options.open_unfelt(&arguments.device)?,
    };
    for unconfirmed in &opened.device.description().unconfirmed {
        console.warn(unconfirmed);
    }
    let simulated = (arguments.accel.kind == SensorKind::Simulated).then(|| {
        let mass_kg = surface.as_ref().map_or(MASS_KG, effective_mass_kg);
        (
            Simulated::new(f64::from(rate_hz), mass_kg, arguments.accel.seed),
            to_sensor,
        )
    });
    let known_s = simulated
        .as_ref()
        .map_or(0.0, |(simulated, _)| simulated.delay_s());
    let plan = Plan {
        coverage,
        taps: arguments.taps,
        air_s: AIR_S,
        is_sensor: measures_load,
    };
    let is_stepped = opened.pace != Pace::Clock;
    let late_s = arguments.accel.delay_s + known_s;
    let take = Take::new(plan, f64::from(rate_hz), is_stepped, late_s);
    let mut monitor = SessionMonitor::new(console, take, reader, simulated);
    run_on(
        arguments,
        &mut opened,
        rate_hz,
        surface.as_ref(),
        &mut monitor,
        &interrupt,
    )?;
    let device = opened.device.description().name.clone();
    // The device is released before anything else can fail or wait.
    drop(opened);
    interrupt.released.store(true, Relaxed);

    let recorded = monitor.finish();
    let Some(part) = capture::part(&recorded.take) else {
        let mut failures = recorded.failures;
        failures.extend(Plain::failure(
            "device and sensor overlap for less than one second, so nothing was kept",
            "record for longer",
        ));
        return Err(failures);
    };
    let about = About {
        name: material,
        device: format!("{device}, {}", arguments.accel.name),
        tool: arguments.tool.clone(),
        mass_kg: arguments.tool_mass,
        full_acceleration: arguments.accel.full_acceleration,
        full_force: arguments.accel.full_force,
    };
    let written = write(outputs, &files, &about, &recorded.take, &part).map_err(one);
    let is_kept = written.is_ok();
    if is_kept {
        folder.keep();
    }
    let summary = Summary {
        folder: &arguments.folder,
        device: &device,
        sensor: &arguments.accel.name,
        recorded: &recorded,
        part: &part,
        is_kept,
    };
    summary.warn(console);
    let printed = if arguments.json {
        console.json(&summary.json())
    } else {
        console.report(&summary.text())
    };
    let lost = match recorded.end {
        End::Lost => Err(recorded.failures),
        _ => Ok(()),
    };
    all([written, printed.map_err(one), lost])
}

/// Name of the material.
fn material(arguments: &Arguments) -> Result<String, Failures> {
    if let Some(name) = &arguments.name {
        return Ok(name.clone());
    }
    let folder = arguments.folder.file_name().unwrap_or_default();
    name(&folder.to_string_lossy()).map_err(|why| {
        Plain::usage(
            format!(
                "{}: the name of the folder cannot name the material: it {why}",
                arguments.folder.display()
            ),
            "give the name of the material with --name",
        )
    })
}

/// The files, which get their names together.
fn outputs(arguments: &Arguments) -> Result<(Outputs, Vec<OutputId>), Failures> {
    let file = arguments.options.file.clone();
    let mut outputs = Outputs::beside(file);
    let files = FILES.map(|name| outputs.open(&arguments.folder.join(name)));
    let files = files.into_iter().collect::<Result<_, _>>().map_err(one)?;
    Ok((outputs, files))
}

/// Waits for the first sample of a sensor.
fn wait_for_sensor(reader: Reader, interrupt: &Interrupt) -> Result<Reader, Failures> {
    loop {
        if reader.description().is_some() {
            return Ok(reader);
        }
        if interrupt.stop.load(Relaxed) {
            let what = "interrupted before the sensor sent anything, so nothing was kept";
            return Err(Plain::failure(what, "start the sensor before you record"));
        }
        if reader.is_over() {
            let (_, ended) = reader.end();
            return Err(match ended {
                Err(error) => one(error),
                Ok(()) => {
                    Plain::failure("the thread of the sensor panicked", "report this as a bug")
                }
            });
        }
        sleep(Duration::from_millis(5));
    }
}

fn effective_mass_kg(surface: &Surface) -> f64 {
    let asset = Asset::parse(&surface.bytes).ok();
    asset.map_or(MASS_KG, |asset| {
        f64::from(asset.coupling().effective_mass_kg)
    })
}

/// Runs the loop until the recording ends.
fn run_on(
    arguments: &Arguments,
    opened: &mut OpenDevice,
    rate_hz: u32,
    surface: Option<&Surface>,
    monitor: &mut SessionMonitor,
    interrupt: &Interrupt,
) -> Result<(), Failures> {
    let options = &arguments.options;
    let end_of_run = AtomicBool::new(false);
    let setup = Setup {
        config: opened.config(rate_hz),
        settings: options.settings(opened, rate_hz, Some(arguments.seconds)),
        clock: options.clock(),
        privileges: options.privileges(),
        injection: None,
        seed: options.seed(opened),
        stop: &end_of_run,
    };
    let (record_writer, record_reader) = queues(QUEUE_S * rate_hz as usize);
    let device = &mut *opened.device;
    let report = match surface {
        Some(surface) => run_loop(setup, surface, device, record_writer, |attended| {
            monitor.attend(attended, record_reader, &interrupt.stop, &end_of_run);
        }),
        None => run_passive(setup, device, record_writer, |attended| {
            monitor.attend(attended, record_reader, &interrupt.stop, &end_of_run);
        }),
    };
    monitor.report = Some(report.map_err(one)?);
    Ok(())
}

fn write(
    mut outputs: Outputs,
    files: &[OutputId],
    about: &About,
    take: &Take,
    part: &capture::Part,
) -> Result<(), OutputError> {
    for (which, id) in files.iter().enumerate() {
        let file = outputs.file(*id);
        capture::write(which, about, take, part, file).map_err(|source| OutputError {
            path: file.target().to_owned(),
            doing: "cannot write it, so the recording was not kept",
            source,
        })?;
    }
    outputs.commit()
}

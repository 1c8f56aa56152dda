//! `asperity-lab servo`: feel a texture or a scene, live.

mod live;
mod session_monitor;
mod summary;

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::time::Instant;

use asperity_console::Console;
use asperity_host::device::{Scheme, Uri};
use asperity_host::servo::{End, Report, queues};
use asperity_host::session_log::{Conditions, TextureInfo};
use asperity_io::diagnostic::{Failures, one};
use asperity_io::output::Outputs;
use asperity_io::shown::counted;
use asperity_lab::servo_session::{Form, OpenDevice, Recorder, Setup, Surface, run as run_loop};
use asperity_runtime::Counters;
use asperity_studio::{Collection, LiveDevice, Site, Studio};

use crate::error::Plain;
use crate::loop_options::{LoopOptions, stop_on_interrupt, within};
use live::Live;
use session_monitor::SessionMonitor;
use summary::ServoSummary;

/// Render a texture or a scene on a device in real time
///
/// The servo loop reads the device, renders, and writes the force until Ctrl-C or --seconds. At the
/// end, the force goes to zero at the slew limit, and the device is released.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab servo brick.asp --device sim:
  asperity-lab servo brick.asp --device sim: --watch      compile in one window, feel in the other
  asperity-lab servo all.aspl --texture Cork --device sim: --studio     see it, and swap textures at a click
  asperity-lab servo brick.asp --device sim: --seconds 30 -o brick.aspr
  asperity-lab servo brick.asp --device replay:brick.aspr     are the forces bit-identical? (else exit 1)
  asperity-lab servo desk.aspl --device sim:?grip=firm --seconds 30 -o ticks.csv
  asperity-lab servo all.aspl --texture Cork --device null: --rate 2000 --policy deadline

Devices:
  sim:[FILE.toml][?grip=light|firm|FILE.toml&hand=explore|record&seed=N&time=real|stepped]
                                 a simulated Touch and hand
  null:[?z_mm=Z]                 no device: rests at one height and accepts any force
  replay:FILE.aspr[?end=loop]    a recorded session, under its original conditions
  falcon:, openhaptics:, dhd:    real devices; `asperity-lab device list` shows them, and
                                 `asperity-lab device probe URI` tells what one needs
  touch:                         can only be identified; use openhaptics: to drive it

If the system refuses a request (policy, locked memory, …), a warning names the command that grants
it, and the loop runs without it.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    options: LoopOptions,
    /// Device to render on, such as sim:
    #[arg(long, value_name = "URI")]
    device: Uri,
    /// Reload the file whenever it changes
    #[arg(long, requires = "file")]
    watch: bool,
    /// Serve the studio's page beside the loop: the hand, the force and the wake-up latency live, and other textures at
    /// a click
    #[arg(long, conflicts_with = "watch")]
    studio: bool,
    /// Port of the studio [default: a free one]
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        hide_default_value = true,
        requires = "studio"
    )]
    port: u16,
    /// Only print the studio's address, and open no browser
    #[arg(long, requires = "studio")]
    no_open: bool,
    /// Record every tick: OUT.aspr for replay, OUT.csv for a table; `-` is a table on standard output
    #[arg(short = 'o', long = "output", alias = "record", value_name = "OUT")]
    record: Option<PathBuf>,
    /// Replay only to look: exit with 0 although forces differ from the recording
    #[arg(long)]
    look: bool,
    /// Stop after this many seconds (0.1 to 86400)
    #[arg(long, value_name = "S", value_parser = within(0.1..=86_400.0, " s"))]
    seconds: Option<f64>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

/// The page beside a loop: its name, and what the server shows, once the device is there.
pub(crate) type Page = (
    &'static str,
    Box<dyn FnOnce(LiveDevice) -> Result<Site, Failures>>,
);

impl Arguments {
    /// A loop that plays what a page wants.
    pub(crate) fn beside_a_page(
        options: LoopOptions,
        device: Uri,
        port: u16,
        no_open: bool,
    ) -> Self {
        Self {
            options,
            device,
            watch: false,
            studio: true,
            port,
            no_open,
            record: None,
            look: false,
            seconds: None,
            json: false,
        }
    }
}

/// Records that fit into the queue: four seconds.
const QUEUE_S: usize = 4;

pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    // The gallery is the library that the loop's texture is of.
    let library = arguments.options.file.clone();
    let library = library.filter(|_| arguments.options.texture.is_some());
    let studio = move |device| {
        let collection = library.as_deref().map(Collection::open).transpose()?;
        Ok(Site::from(
            Studio::new(collection, None).with_device(device),
        ))
    };
    run_beside(arguments, ("studio", Box::new(studio)), console)
}

/// The loop, beside a page where one is wanted.
///
/// # Errors
/// As the command.
pub(crate) fn run_beside(
    arguments: &Arguments,
    page: Page,
    console: Console,
) -> Result<(), Failures> {
    let interrupt = stop_on_interrupt()?;
    let options = &arguments.options;
    let is_replay = arguments.device.scheme == Scheme::Replay;
    if arguments.watch && is_replay {
        return Err(Plain::usage(
            "--watch cannot be used with replay:, which renders the recorded session only",
            "leave out --watch",
        ));
    }
    if arguments.studio && is_replay {
        return Err(Plain::usage(
            "--studio cannot be used with replay:, which renders the recorded session only",
            "leave out --studio",
        ));
    }
    if arguments.look && !is_replay {
        return Err(Plain::usage(
            "--look is for replay:, whose forces are compared with the recording",
            "leave out --look",
        ));
    }
    let mut outputs = Outputs::beside(inputs(arguments));
    let form = arguments.record.as_deref().map(Form::of);
    let form = form.transpose().map_err(one)?;
    let output = outputs.open_if(arguments.record.as_deref()).map_err(one)?;
    let console = console.beside(&outputs);
    let mut surface = options.surface()?;
    let (mut opened, rate_hz) = options.open_device(&arguments.device, &surface)?;
    for unconfirmed in &opened.device.description().unconfirmed {
        console.warn(unconfirmed);
    }
    for otherwise in differences(&opened, &surface, options) {
        console.warn(&otherwise);
    }
    let config = opened.config(rate_hz);
    let seed = options.seed(&opened);
    let recorder = match (arguments.record.as_deref(), form, output) {
        (Some(path), Some(form), Some(output)) => {
            let played = TextureInfo::of(surface.name.clone(), &surface.bytes);
            let (texture, scene) = match surface.is_scene {
                false => (Some(played), None),
                true => (None, Some(played)),
            };
            let conditions = Conditions {
                program: concat!("asperity-lab ", env!("CARGO_PKG_VERSION")).into(),
                device: arguments.device.to_string(),
                texture,
                scene,
                seed,
                config: config.clone(),
            };
            let started = Recorder::start(path, form, outputs, output, conditions);
            Some(started.map_err(one)?)
        }
        _ => None,
    };
    let device_name = opened.device.description().name.clone();
    let live = arguments
        .studio
        .then(|| Live::start(arguments, page, &surface, &device_name, rate_hz, console));
    let live = live.transpose()?;
    let mut monitor = SessionMonitor::new(arguments, console, recorder, live, rate_hz);
    let began = Instant::now();
    let mut sum: Option<Report> = None;
    loop {
        let left = arguments.seconds.map(|s| s - began.elapsed().as_secs_f64());
        let end_of_run = AtomicBool::new(false);
        let setup = Setup {
            config: config.clone(),
            settings: options.settings(&opened, rate_hz, left.map(|left| left.max(0.0))),
            clock: options.clock(),
            privileges: options.privileges(),
            injection: None,
            seed,
            stop: &end_of_run,
        };
        let (record_writer, record_reader) = queues(QUEUE_S * rate_hz as usize);
        let mut next = None;
        let report = run_loop(
            setup,
            &surface,
            &mut *opened.device,
            record_writer,
            |attended| {
                next = monitor.attend(
                    attended,
                    record_reader,
                    &surface,
                    &interrupt.stop,
                    &end_of_run,
                );
            },
        );
        let report = report.map_err(one)?;
        sum = Some(match sum {
            None => report,
            Some(before) => add(before, report),
        });
        // A scene that has changed is begun anew; anything else ends here.
        match next {
            Some(changed) if report.end == End::Asked => surface = changed,
            _ => break,
        }
    }
    // The device is released before anything else can fail or wait.
    let replayed = opened.replayed.take();
    drop(opened);
    interrupt.released.store(true, Relaxed);
    let Some(report) = sum else { return Ok(()) };
    let repeated = replayed.map(|replayed| replayed.repeated.counts());
    monitor.finish(&ServoSummary {
        report,
        surface: &surface,
        device: &device_name,
        rate_hz,
        repeated,
    })?;
    match repeated {
        Some((forces, different)) if different > 0 && !arguments.look => Err(Plain::failure(
            format!("{different} of {forces} forces differ from the recording"),
            "replay the recorded texture and seed, or give --look if the difference is meant",
        )),
        _ => Ok(()),
    }
}

/// The files that are read.
fn inputs(arguments: &Arguments) -> Vec<PathBuf> {
    let replayed =
        (arguments.device.scheme == Scheme::Replay).then(|| PathBuf::from(&arguments.device.which));
    let file = arguments.options.file.clone();
    file.into_iter().chain(replayed).collect()
}

/// Why the forces of a replay cannot be those of its recording.
fn differences(opened: &OpenDevice, surface: &Surface, options: &LoopOptions) -> Vec<String> {
    let Some(replayed) = &opened.replayed else {
        return Vec::new();
    };
    let conditions = &replayed.conditions;
    let mut told = Vec::new();
    match (&conditions.texture, &conditions.scene) {
        (Some(texture), _) if surface.is_scene || !texture.is(&surface.bytes) => told.push(format!(
            "the recording is of texture \"{}\" (CRC-32 {:08x}), but {} is a different one, so the forces will differ",
            texture.name, texture.crc32, surface.origin
        )),
        (None, Some(scene)) if !surface.is_scene || !scene.is(&surface.bytes) => told.push(format!(
            "the recording is of {} (CRC-32 {:08x}), but {} is a different one: give its file, or the forces \
             will differ",
            scene.name, scene.crc32, surface.origin
        )),
        (None, None) if !surface.is_scene => {
            told.push("the recording is of a scene: give its file, or the forces will differ".into());
        }
        (None, None) => told.push(format!(
            "the recording does not name its scene: the forces will differ unless it is {}",
            surface.origin
        )),
        _ => {}
    }
    if options.seed.is_some_and(|seed| seed != conditions.seed) {
        told.push(format!(
            "the recording was made with seed {}, so the forces will differ",
            conditions.seed
        ));
    }
    if replayed.exchanges > 0 {
        told.push(format!(
            "the texture was changed {} during the recording: the forces will differ from then on",
            counted(replayed.exchanges, "time", "times")
        ));
    }
    if replayed.lost > 0 {
        told.push(format!(
            "{} not recorded: the forces will differ after the first gap",
            counted(replayed.lost, "tick was", "ticks were")
        ));
    }
    told
}

/// Both reports as one.
fn add(a: Report, b: Report) -> Report {
    let counters = Counters {
        ticks: a.counters.ticks.saturating_add(b.counters.ticks),
        bad_samples: (a.counters.bad_samples).saturating_add(b.counters.bad_samples),
        missed_ticks: (a.counters.missed_ticks).saturating_add(b.counters.missed_ticks),
        faults: a.counters.faults.saturating_add(b.counters.faults),
        taps: a.counters.taps.saturating_add(b.counters.taps),
        peak_limited: (a.counters.peak_limited).saturating_add(b.counters.peak_limited),
        slew_limited: (a.counters.slew_limited).saturating_add(b.counters.slew_limited),
    };
    Report {
        ticks: a.ticks + b.ticks,
        missed: a.missed + b.missed,
        caught_up: a.caught_up + b.caught_up,
        paused: a.paused + b.paused,
        stale: a.stale + b.stale,
        read_faults: a.read_faults + b.read_faults,
        write_faults: a.write_faults + b.write_faults,
        recoveries: a.recoveries + b.recoveries,
        recovered: a.recovered + b.recovered,
        episodes: a.episodes + b.episodes,
        eased: a.eased + b.eased,
        longest_gap_ns: a.longest_gap_ns.max(b.longest_gap_ns),
        counters,
        ..b
    }
}

//! `asperity-lab servo`: feel a texture or a scene, live.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::thread::sleep;
use std::time::{Duration, Instant, SystemTime};

use asperity::console::Console;
use asperity::diagnostic::{Failures, one, report as told};
use asperity::output::{OutputId, Outputs, display};
use asperity_formats::Asset;
use asperity_host::device::Uri;
use asperity_host::servo::{End, Event, Inlet, Record, Report, queues};
use asperity_runtime::{Counters, Flags, PrepareError};
use asperity_sim::desk::{Attended, Setup, Surface, Trace, run as run_loop};
use indicatif::ProgressBar;

use crate::error::Plain;
use crate::loop_options::{self, LoopOptions, refusals, stop_on_interrupt};

/// Feel a texture or a scene, live
///
/// A servo loop reads the device, renders, and writes the force, until Ctrl-C or for some
/// seconds. At the end the force goes to zero at the slew limit, and the device is released.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab servo brick.asp --device sim:
  asperity-lab servo brick.asp --device sim: --watch      compile in one window, feel in the other
  asperity-lab servo desk.aspl --device sim:?grip=firm --seconds 30 --record ticks.csv
  asperity-lab servo all.aspl --texture Cork --device null: --rate 2000 --policy deadline

Devices: sim:[FILE.toml][?grip=light|firm|FILE.toml&seed=N&time=real|stepped] is a simulated
Touch in a simulated hand, null:[?z_mm=Z] rests somewhere and takes any force.

What the system does not permit (policy, locked memory, …) is told with the command that
grants it, and the loop runs without.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    options: LoopOptions,
    /// Device, such as sim:
    #[arg(long, value_name = "URI", value_parser = loop_options::device)]
    device: Uri,
    /// Load the file anew when it changes
    #[arg(long, requires = "file")]
    watch: bool,
    /// Write every tick to a CSV file; `-` is standard output
    #[arg(long, value_name = "OUT.csv")]
    record: Option<PathBuf>,
    /// End after so many seconds (0.1 to 86400)
    #[arg(long, value_name = "S", value_parser = loop_options::seconds)]
    seconds: Option<f64>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

/// Time between two looks at the queues.
const LOOK: Duration = Duration::from_millis(20);
/// Time between two looks at the file, and between two status lines.
const SELDOM: Duration = Duration::from_millis(250);
/// Records that fit into the queue: four seconds.
const QUEUE_S: usize = 4;

pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    let stop = stop_on_interrupt()?;
    let mut outputs = Outputs::beside(&arguments.options.file);
    let record = outputs.open_if(arguments.record.as_deref()).map_err(one)?;
    let console = console.beside(&outputs);
    let mut surface = arguments.options.surface()?;
    let rate_hz = arguments.options.rate_hz(&surface);
    let mut desk = arguments.options.desk(&arguments.device, rate_hz)?;
    for unconfirmed in &desk.device.description().unconfirmed {
        console.warn(unconfirmed);
    }
    let config = desk.config(rate_hz);
    let mut attendant = Attendant::new(arguments, console, record, outputs, rate_hz)?;
    let began = Instant::now();
    let mut sum: Option<Report> = None;
    loop {
        let left = arguments.seconds.map(|s| s - began.elapsed().as_secs_f64());
        let end_of_run = AtomicBool::new(false);
        let setup = Setup {
            config: config.clone(),
            settings: (arguments.options).settings(rate_hz, left.map(|left| left.max(0.0))),
            clock: arguments.options.clock(),
            wanted: arguments.options.wanted(),
            injection: None,
            seed: arguments.options.seed,
            stop: &end_of_run,
        };
        let (outlet, inlet) = queues(QUEUE_S * rate_hz as usize);
        let mut next = None;
        let report = run_loop(setup, &surface, &mut *desk.device, outlet, |attended| {
            next = attendant.attend(attended, inlet, &surface, &stop, &end_of_run);
        });
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
    // The device is released before anything else can fail.
    let device = desk.device.description().name.clone();
    drop(desk);
    let Some(report) = sum else { return Ok(()) };
    attendant.finish(&report, &surface, &device, rate_hz)
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
        longest_gap_ns: a.longest_gap_ns.max(b.longest_gap_ns),
        counters,
        ..b
    }
}

/// Looks after a loop from another thread.
struct Attendant<'c> {
    console: Console,
    /// The file that may change, and what it is read with.
    watched: Option<(&'c Path, &'c LoopOptions)>,
    seen: Option<(SystemTime, u64)>,
    outputs: Outputs,
    record: Option<(OutputId, Trace)>,
    /// Why recording failed, if it did.
    broken: Option<std::io::Error>,
    status: ProgressBar,
    json: bool,
    lost: u64,
    reloads: u64,
    last: Option<Record>,
    missed: u64,
    told: bool,
    rate_hz: f32,
    record_path: Option<&'c Path>,
}

impl<'c> Attendant<'c> {
    fn new(
        arguments: &'c Arguments,
        console: Console,
        record: Option<OutputId>,
        mut outputs: Outputs,
        rate_hz: u32,
    ) -> Result<Self, Failures> {
        let file = arguments.options.file.as_deref();
        let watched = file
            .filter(|_| arguments.watch)
            .map(|path| (path, &arguments.options));
        let record = match record {
            None => None,
            Some(id) => {
                let trace = Trace::begin(outputs.file(id));
                let trace = trace.map_err(|error| Plain::failure(error, "free some space"))?;
                Some((id, trace))
            }
        };
        Ok(Self {
            console,
            watched,
            seen: watched.and_then(|(path, _)| stamp(path)),
            outputs,
            record,
            broken: None,
            status: console.activity(),
            json: arguments.json,
            lost: 0,
            reloads: 0,
            last: None,
            missed: 0,
            told: false,
            rate_hz: rate_hz as f32,
            record_path: arguments.record.as_deref(),
        })
    }

    /// Attends to a loop until it ends. Gives a scene that is to be begun anew.
    fn attend(
        &mut self,
        mut attended: Attended<'_, '_, '_, '_>,
        mut inlet: Inlet,
        surface: &Surface,
        stop: &AtomicBool,
        end_of_run: &AtomicBool,
    ) -> Option<Surface> {
        if !self.told {
            self.told = true;
            for refusal in refusals(attended.grants) {
                self.console.warn(&refusal);
            }
        }
        let mut next = None;
        let mut ticks = 0;
        let mut seldom = Instant::now();
        // A texture that waits for a spare slot.
        let mut waiting: Option<Surface> = None;
        loop {
            let over = attended.servo.is_finished();
            ticks += self.drain(&mut inlet);
            if over {
                break;
            }
            if stop.load(Relaxed) {
                end_of_run.store(true, Relaxed);
            }
            if seldom.elapsed() >= SELDOM {
                self.show(ticks, seldom.elapsed());
                (ticks, seldom) = (0, Instant::now());
                if let Some(changed) = self.changed() {
                    if changed.is_scene || surface.is_scene {
                        next = Some(changed);
                        end_of_run.store(true, Relaxed);
                    } else {
                        waiting = Some(changed);
                    }
                }
                if let (Some(texture), Some(preparer)) = (&waiting, &mut attended.preparer)
                    && self.hand_over(texture, preparer)
                {
                    waiting = None;
                }
            }
            sleep(LOOK);
        }
        self.lost += inlet.lost();
        if stop.load(Relaxed) { None } else { next }
    }

    /// Hands a texture over to the loop; `false` while no slot is spare.
    fn hand_over(
        &mut self,
        texture: &Surface,
        preparer: &mut asperity_runtime::Preparer<'_, '_>,
    ) -> bool {
        let rate_hz = self.rate_hz;
        let prepared = match Asset::parse(&texture.bytes) {
            Ok(asset) => preparer.prepare(&asset, rate_hz),
            Err(cause) => Err(PrepareError::Load(cause.into())),
        };
        match prepared {
            Ok(()) => {
                self.reloads += 1;
                self.say(&format!(
                    "{}: loaded anew, {}",
                    texture.origin, texture.name
                ));
                true
            }
            Err(PrepareError::NoneSpare) => false,
            Err(error) => {
                self.say(&format!("{}: {error}; the old one stays", texture.origin));
                true
            }
        }
    }

    /// Takes what the loop has sent, and counts the ticks.
    fn drain(&mut self, inlet: &mut Inlet) -> u64 {
        let mut ticks = 0;
        let mut rows = Vec::new();
        while let Some(record) = inlet.record() {
            ticks += 1;
            self.missed += record.missed;
            if let Some((_, trace)) = &mut self.record {
                // Writing to memory does not fail.
                let _ = trace.row(&record, &mut rows);
            }
            self.last = Some(record);
        }
        if let Some((id, _)) = &self.record
            && self.broken.is_none()
        {
            self.broken = self.outputs.file(*id).write_all(&rows).err();
        }
        while let Some(event) = inlet.event() {
            let told = match event {
                Event::Failed { period, fault } => {
                    format!("period {period}: {fault}; the force goes to zero")
                }
                Event::Back {
                    period,
                    faulty_ticks,
                } => format!("period {period}: the device is back after {faulty_ticks} ticks"),
                Event::NotRecovered { period, fault } => {
                    format!("period {period}: not recovered: {fault}")
                }
                other => format!("{other:?}"),
            };
            self.say(&told);
        }
        ticks
    }

    /// A line for the user, beside the status line.
    fn say(&self, text: &str) {
        self.status
            .suspend(|| self.console.aside(&format!("{text}\n")));
    }

    /// The status line: rate, missed periods, force, contact, safe state.
    fn show(&self, ticks: u64, time: Duration) {
        let Some(record) = self.last else { return };
        let [x, y, z] = record.output.force_n;
        let force_n = (x * x + y * y + z * z).sqrt();
        let flags = record.output.flags;
        let state = if flags.contains(Flags::SAFE_STATE) {
            "SAFE STATE"
        } else if flags.contains(Flags::RAMPING) {
            "ramping"
        } else if flags.contains(Flags::CONTACT) {
            "contact"
        } else {
            "free"
        };
        self.status.set_message(format!(
            "{:.0} Hz, {} missed, {force_n:.2} N, {:.2} mm deep, {:.0} mm/s, {state}",
            ticks as f64 / time.as_secs_f64(),
            self.missed,
            1e3 * record.output.depth_m,
            record.output.speed_mm_s,
        ));
    }

    /// What the file holds now, if it has changed and can be read. A file that is just being
    /// written is looked at again.
    fn changed(&mut self) -> Option<Surface> {
        let (path, options) = self.watched?;
        let now = stamp(path)?;
        if self.seen == Some(now) {
            return None;
        }
        self.seen = Some(now);
        match options.read() {
            Ok(surface) => Some(surface),
            Err(error) => {
                self.say(&format!("{}\n  the old one stays", told(&error)));
                None
            }
        }
    }

    /// Writes what is left, and says what the loop did.
    fn finish(
        mut self,
        report: &Report,
        surface: &Surface,
        device: &str,
        rate_hz: u32,
    ) -> Result<(), Failures> {
        self.status.finish_and_clear();
        if let Some(error) = self.broken.take() {
            return Err(Plain::failure(
                format!("the record could not be written: {error}"),
                "free some space, or record fewer seconds",
            ));
        }
        let rows = self.record.as_ref().map(|(id, trace)| (*id, trace.rows()));
        let console = self.console;
        self.outputs.commit().map_err(one)?;
        if self.lost > 0 {
            console.warn(&format!(
                "{} records were lost because this program read them too slowly; no tick was",
                self.lost
            ));
        }
        let end = match report.end {
            End::Asked => "asked to",
            End::Over => "time is over",
            End::Overrun => "a period was missed",
        };
        if self.json {
            let json = serde_json::json!({
                "texture": surface.name, "origin": surface.origin, "device": device,
                "rate_hz": rate_hz, "end": end, "ticks": report.ticks, "missed": report.missed,
                "caught_up": report.caught_up, "paused": report.paused, "stale": report.stale,
                "read_faults": report.read_faults, "write_faults": report.write_faults,
                "recoveries": report.recoveries, "longest_gap_ns": report.longest_gap_ns,
                "ended_without_force": report.ended_without_force,
                "safe_states": report.counters.faults, "taps": report.counters.taps,
                "peak_limited": report.counters.peak_limited,
                "slew_limited": report.counters.slew_limited,
                "lost_records": self.lost, "reloads": self.reloads,
            });
            return console.json(&json).map_err(one);
        }
        let mut text = format!(
            "surface    {}, {}\ndevice     {device}\nloop       {rate_hz} Hz, {} ticks, {} missed, longest gap {:.3} ms\n",
            surface.name,
            surface.origin,
            report.ticks,
            report.missed,
            1e-6 * report.longest_gap_ns as f64,
        );
        text += &format!(
            "device     {} stale, {} readings and {} forces failed, {} recoveries tried\n",
            report.stale, report.read_faults, report.write_faults, report.recoveries
        );
        text += &format!(
            "runtime    {} taps, {} safe states, {} ticks at the peak, {} at the slew limit\n",
            report.counters.taps,
            report.counters.faults,
            report.counters.peak_limited,
            report.counters.slew_limited
        );
        let zero = if report.ended_without_force {
            "the force is zero"
        } else {
            "THE DEVICE DID NOT TAKE THE LAST FORCE OF ZERO"
        };
        text += &format!("end        {end}; {zero}\n");
        if let (Some((_, rows)), Some(path)) = (rows, self.record_path) {
            text += &format!("record     {}, {rows} rows\n", display(path));
        }
        console.text(&text).map_err(one)
    }
}

/// When a file was changed, and its length.
fn stamp(path: &Path) -> Option<(SystemTime, u64)> {
    let metadata = fs::metadata(path).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

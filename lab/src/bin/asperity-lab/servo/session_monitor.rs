//! Looks after a loop from another thread: records, changed files, events, the status line.

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::thread::sleep;
use std::time::{Duration, Instant, SystemTime};

use asperity_console::Console;
use asperity_formats::Asset;
use asperity_host::servo::{Event, Record, RecordReader};
use asperity_host::session_log::TextureInfo;
use asperity_io::diagnostic::{Failures, one, report as told};
use asperity_io::shown::counted;
use asperity_lab::servo_session::{Attended, Recorder, Surface};
use asperity_runtime::{Flags, PrepareError, Preparer};
use indicatif::ProgressBar;

use super::Arguments;
use super::live::Live;
use super::summary::{self, ServoSummary, SessionOutcome};
use crate::loop_options::{LoopOptions, refusals};

/// Time between two looks at the queues.
const LOOK: Duration = Duration::from_millis(20);
/// Time between two looks at the file, and between two status lines.
const SELDOM: Duration = Duration::from_millis(250);

/// Looks after a loop from another thread.
pub(super) struct SessionMonitor<'c> {
    console: Console,
    /// The file that may change, and what it is read with.
    watched: Option<(&'c Path, &'c LoopOptions)>,
    options: &'c LoopOptions,
    seen: Option<(SystemTime, u64)>,
    recorder: Option<Recorder>,
    live: Option<Live>,
    /// True once the user has been warned that recording has stopped.
    told_of_recorder: bool,
    status: ProgressBar,
    json: bool,
    lost: u64,
    reloads: u64,
    /// Textures that were handed over, in order; the loop counts those it has begun to play.
    handed_over: Vec<(String, String)>,
    last: Option<Record>,
    missed: u64,
    told_refusals: bool,
    rate_hz: f32,
}

impl<'c> SessionMonitor<'c> {
    pub(super) fn new(
        arguments: &'c Arguments,
        console: Console,
        recorder: Option<Recorder>,
        live: Option<Live>,
        rate_hz: u32,
    ) -> Self {
        let file = arguments.options.file.as_deref();
        let watched = file
            .filter(|_| arguments.watch)
            .map(|path| (path, &arguments.options));
        Self {
            console,
            watched,
            options: &arguments.options,
            seen: watched.and_then(|(path, _)| stamp(path)),
            recorder,
            live,
            told_of_recorder: false,
            status: console.activity(),
            json: arguments.json,
            lost: 0,
            reloads: 0,
            handed_over: Vec::new(),
            last: None,
            missed: 0,
            told_refusals: false,
            rate_hz: rate_hz as f32,
        }
    }

    /// Attends to a loop until it ends. Gives a scene that is to be begun anew.
    pub(super) fn attend(
        &mut self,
        mut attended: Attended<'_, '_, '_, '_>,
        mut record_reader: RecordReader,
        surface: &Surface,
        stop: &AtomicBool,
        end_of_run: &AtomicBool,
    ) -> Option<Surface> {
        if !self.told_refusals {
            self.told_refusals = true;
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
            ticks += self.drain(&mut record_reader);
            if over {
                break;
            }
            if stop.load(Relaxed) {
                end_of_run.store(true, Relaxed);
            }
            if seldom.elapsed() >= SELDOM {
                self.show(ticks, seldom.elapsed());
                self.summarise(surface);
                (ticks, seldom) = (0, Instant::now());
                if let Some(changed) = self.changed() {
                    if changed.is_scene || surface.is_scene {
                        next = Some(changed);
                        end_of_run.store(true, Relaxed);
                    } else {
                        waiting = Some(changed);
                    }
                }
            }
            waiting = self.wanted().or(waiting);
            if let (Some(texture), Some(preparer)) = (&waiting, &mut attended.preparer)
                && self.exchange(texture, preparer)
            {
                waiting = None;
            }
            sleep(LOOK);
        }
        self.lost += record_reader.lost();
        let next = next.filter(|_| !stop.load(Relaxed));
        if next.is_some() && self.recorder.as_mut().is_some_and(Recorder::begin_anew) {
            self.told_of_recorder = true;
            self.console
                .warn("the recording ends here, because the changed scene starts afresh");
        }
        next
    }

    /// Hands a texture over to the loop; `false` while no slot is spare.
    fn exchange(&mut self, texture: &Surface, preparer: &mut Preparer<'_, '_>) -> bool {
        let rate_hz = self.rate_hz;
        let prepared = match Asset::parse(&texture.bytes) {
            Ok(asset) => preparer.prepare(&asset, rate_hz),
            Err(cause) => Err(PrepareError::Load(cause.into())),
        };
        match prepared {
            Ok(()) => {
                self.reloads += 1;
                let played = (texture.name.clone(), texture.origin.clone());
                self.handed_over.push(played);
                if let Some(recorder) = &mut self.recorder {
                    // Records of it are still in the queue at best.
                    recorder.announce(TextureInfo::of(texture.name.clone(), &texture.bytes));
                }
                self.say(&format!("{}: reloaded, {}", texture.origin, texture.name));
                true
            }
            Err(PrepareError::NoneSpare) => false,
            Err(error) => {
                self.say(&format!(
                    "{}: {error}; the previous version stays in use",
                    texture.origin
                ));
                true
            }
        }
    }

    /// Takes what the loop has sent, and counts the ticks.
    fn drain(&mut self, record_reader: &mut RecordReader) -> u64 {
        let mut ticks = 0;
        while let Some(record) = record_reader.record() {
            ticks += 1;
            self.missed += record.missed;
            if let Some(recorder) = &mut self.recorder {
                recorder.take(&record);
            }
            if let Some(live) = &mut self.live {
                live.take(&record);
            }
            self.last = Some(record);
        }
        if let Some(recorder) = &mut self.recorder {
            recorder.hand_over();
        }
        if let Some(live) = &mut self.live {
            live.hand_over();
        }
        self.tell_of_recorder();
        while let Some(event) = record_reader.event() {
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

    /// Says at once that nothing is recorded any more.
    fn tell_of_recorder(&mut self) {
        let failed = self.recorder.as_ref().and_then(Recorder::failure);
        if let Some(why) = failed.filter(|_| !self.told_of_recorder) {
            self.say(&format!(
                "the recording cannot be written: {why}; the loop continues without it"
            ));
            self.told_of_recorder = true;
        }
    }

    /// A line for the user, beside the status line and on the studio's page.
    fn say(&self, text: &str) {
        self.status
            .suspend(|| self.console.aside(&format!("{text}\n")));
        if let Some(live) = &self.live {
            live.say(text);
        }
    }

    /// The texture that the studio's page wants played, in the voice of the device.
    fn wanted(&self) -> Option<Surface> {
        let wanted = self.live.as_ref()?.wanted()?;
        let origin = format!("the studio's {:?}", wanted.name);
        let surface = Surface::of_texture(wanted.asset.to_vec(), origin.clone());
        match surface.and_then(|surface| self.options.compensated(surface)) {
            Ok(surface) => Some(surface),
            Err(error) => {
                self.say(&format!(
                    "{origin}: {}\n  the previous texture stays in use",
                    told(&error)
                ));
                None
            }
        }
    }

    /// The texture that plays, where it is not the first one: its name and where it came from.
    fn playing(&self) -> Option<&(String, String)> {
        let exchanges = self.last.map_or(0, |record| record.exchanges as usize);
        self.handed_over.get(exchanges.checked_sub(1)?)
    }

    /// Tells the studio of the loop as a whole.
    fn summarise(&mut self, surface: &Surface) {
        let first = &surface.name;
        let name = self.playing().map_or(first, |(name, _)| name).clone();
        if let Some(live) = &mut self.live {
            live.summarise(&name);
        }
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

    /// Returns the file's surface if it has changed and is readable. A file still being written is retried later.
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
                self.say(&format!(
                    "{}\n  the previous version stays in use",
                    told(&error)
                ));
                None
            }
        }
    }

    /// Writes what is left, and says what the loop did.
    pub(super) fn finish(mut self, session: &ServoSummary<'_>) -> Result<(), Failures> {
        self.status.finish_and_clear();
        if let Some(live) = &mut self.live {
            live.end();
        }
        let mut outcome = SessionOutcome {
            lost: self.lost,
            reloads: self.reloads,
            playing: self.playing().cloned(),
            recorded: None,
        };
        let mut failure = Ok(());
        if let Some(recorder) = self.recorder {
            outcome.lost += recorder.lost();
            let path = recorder.path().to_owned();
            let written = recorder.finish(self.lost).map_err(one);
            let committed = written.and_then(|written| {
                written.outputs.commit().map_err(one)?;
                Ok(written.ticks)
            });
            match committed {
                Ok(ticks) => outcome.recorded = Some((path, ticks)),
                Err(error) => failure = Err(error),
            }
        }
        if outcome.lost > 0 {
            self.console.warn(&format!(
                "{} lost because reading or writing was too slow; the ticks themselves ran",
                counted(outcome.lost, "record was", "records were")
            ));
        }
        // The session is reported even where its record was lost.
        if self.json {
            self.console
                .json(&summary::json(session, &outcome))
                .map_err(one)?;
        } else {
            self.console
                .text(&summary::text(session, &outcome))
                .map_err(one)?;
        }
        failure
    }
}

/// When a file was changed, and its length.
fn stamp(path: &Path) -> Option<(SystemTime, u64)> {
    let metadata = fs::metadata(path).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

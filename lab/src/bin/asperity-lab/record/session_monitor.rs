//! Looks after the loop and the sensor: takes what they send, shows the grid, says when to end.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::mpsc::SyncSender;
use std::thread::sleep;
use std::time::{Duration, Instant};

use asperity_console::Console;
use asperity_host::servo::{self, Clock as _, Monotonic, RecordReader, Report};
use asperity_io::diagnostic::{Failures, one};
use asperity_lab::capture::{Counts, NextStep, Reader, Simulated, Take};
use asperity_lab::servo_session::Attended;
use indicatif::ProgressBar;

use super::screen;
use crate::error::Plain;
use crate::loop_options::refusals;

/// Time between two looks at the queues, and between two pictures of the grid.
const LOOK: Duration = Duration::from_millis(5);
const SELDOM: Duration = Duration::from_millis(200);
/// A device that tells no position for so long is gone, ns: an import bridges less.
const GONE_NS: u64 = 900_000_000;

/// Why a recording ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    /// Everything was visited.
    Covered,
    /// Ctrl-C.
    Asked,
    /// After its seconds, or at the end of what is played.
    Over,
    /// An import would keep no more.
    Full,
    /// Device or sensor has gone.
    Lost,
    /// Code of the device changed how the processor rounds.
    Rounding,
}

/// A recording that is over.
pub(super) struct Recorded {
    pub(super) take: Take,
    pub(super) end: End,
    pub(super) counts: Counts,
    /// Records and samples that came too fast to be taken.
    pub(super) lost: (u64, u64),
    /// Periods of the loop that were missed.
    pub(super) missed: u64,
    /// Why it ended, if something failed.
    pub(super) failures: Failures,
}

/// Looks after the loop and the sensor.
pub(super) struct SessionMonitor {
    console: Console,
    take: Take,
    reader: Reader,
    simulated: Option<(Simulated, SyncSender<Vec<u8>>)>,
    status: ProgressBar,
    end: Option<End>,
    failures: Failures,
    lost_records: u64,
    /// Samples that were lost before the loop began.
    unused: u64,
    pub(super) report: Option<Report>,
}

impl SessionMonitor {
    pub(super) fn new(
        console: Console,
        take: Take,
        reader: Reader,
        simulated: Option<(Simulated, SyncSender<Vec<u8>>)>,
    ) -> Self {
        Self {
            console,
            take,
            reader,
            simulated,
            status: console.activity(),
            end: None,
            failures: Failures::new(),
            lost_records: 0,
            unused: 0,
            report: None,
        }
    }

    /// Attends to the loop until it ends.
    pub(super) fn attend(
        &mut self,
        attended: Attended<'_, '_, '_, '_>,
        mut record_reader: RecordReader,
        stop: &AtomicBool,
        end_of_run: &AtomicBool,
    ) {
        for refusal in refusals(attended.grants) {
            self.console.warn(&refusal);
        }
        // What came while the device was opened is of no use, and was not lost.
        while self.reader.batch().is_some() {}
        self.unused = self.reader.lost();
        let clock = Monotonic::default();
        let begin_ns = clock.now_ns();
        let mut shown = Instant::now();
        loop {
            let is_over = attended.servo.is_finished();
            self.drain(&mut record_reader);
            if is_over {
                break;
            }
            if self.end.is_none() {
                let touches = self.take.touches();
                let last_ns = touches
                    .last()
                    .map_or(begin_ns, |touch| touch.at_ns.max(begin_ns));
                self.end = self.ends(stop, clock.now_ns().saturating_sub(last_ns) > GONE_NS);
            }
            if self.end.is_some() {
                end_of_run.store(true, Relaxed);
            }
            if shown.elapsed() >= SELDOM {
                self.status
                    .set_message(screen::picture(self.take.exploration()));
                shown = Instant::now();
            }
            sleep(LOOK);
        }
        self.lost_records = record_reader.lost();
    }

    fn ends(&mut self, stop: &AtomicBool, is_gone: bool) -> Option<End> {
        if stop.load(Relaxed) {
            Some(End::Asked)
        } else if self.take.exploration().next_step() == NextStep::Nothing {
            Some(End::Covered)
        } else if self.take.is_full() {
            Some(End::Full)
        } else if self.reader.is_over() {
            Some(End::Lost)
        } else if is_gone {
            self.failures.extend(Plain::failure(
                "the device gave no new position for 0.9 s",
                "run `asperity-lab device probe` with its name, and record again",
            ));
            Some(End::Lost)
        } else {
            None
        }
    }

    /// Takes what loop and sensor sent.
    fn drain(&mut self, record_reader: &mut RecordReader) {
        while let Some(record) = record_reader.record() {
            self.take.tick(&record);
            if let Some((simulated, to)) = &mut self.simulated
                && let Some(lines) = simulated.tick(&record)
            {
                // A sensor that is not read has ended, which is reported elsewhere.
                let _ = to.try_send(lines.into_bytes());
            }
        }
        // A device fault is reported only if the device stays away.
        while record_reader.event().is_some() {}
        while let Some(batch) = self.reader.batch() {
            if let Some(description) = self.reader.description() {
                self.take.batch(description, &batch);
            }
        }
    }

    /// Ends the sensor as well.
    pub(super) fn finish(mut self) -> Recorded {
        self.status.finish_and_clear();
        while let Some(batch) = self.reader.batch() {
            if let Some(description) = self.reader.description() {
                self.take.batch(description, &batch);
            }
        }
        let lost_samples = self.reader.lost() - self.unused;
        let by_itself = match self.report {
            Some(report) if report.end == servo::End::Rounding => End::Rounding,
            _ => End::Over,
        };
        let (counts, ended) = self.reader.end();
        if let Err(error) = ended {
            self.failures.extend(one(error));
        }
        Recorded {
            take: self.take,
            end: self.end.unwrap_or(by_itself),
            counts,
            lost: (self.lost_records, lost_samples),
            missed: self.report.map_or(0, |report| report.missed),
            failures: self.failures,
        }
    }
}

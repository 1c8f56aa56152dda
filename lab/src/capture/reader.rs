//! Reads a sensor on a thread of its own.

use super::columns::Layout;
use super::error::SensorError;
use super::samples::{Counts, Samples};
use super::source::Source;
use asperity_host::servo::{Clock as _, Monotonic};
use std::io;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, OnceLock};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Batches that wait for the other thread, at most; later ones are lost, and counted.
const WAITING: usize = 4096;
/// Longest wait for a sensor before it is asked whether to end.
const WAIT: Duration = Duration::from_millis(50);
/// A sensor that sends nothing for so long has stalled; before its first sample, it may be slower.
const STALLED: Duration = Duration::from_secs(1);
const FIRST: Duration = Duration::from_secs(5);

/// Samples that came at once.
#[derive(Debug, Clone, PartialEq)]
pub struct Batch {
    /// When, on the clock of the servo loop, ns.
    pub arrived_ns: u64,
    /// The samples.
    pub samples: Samples,
}

/// The sensor's own description.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorDescription {
    /// Its columns.
    pub layout: Layout,
    /// Seconds in a unit of its own time, if it states them.
    pub stated_scale: Option<f64>,
}

/// A sensor that is read.
#[derive(Debug)]
pub struct Reader {
    batches: Receiver<Batch>,
    stop: Arc<AtomicBool>,
    lost: Arc<AtomicU64>,
    description: Arc<OnceLock<SensorDescription>>,
    thread: JoinHandle<(Counts, Result<(), SensorError>)>,
}

impl Reader {
    /// Begins to read.
    ///
    /// # Errors
    /// [`io::Error`] where the system has no room for a thread.
    pub fn start(source: impl Source + 'static) -> io::Result<Self> {
        let (to, batches) = sync_channel(WAITING);
        let stop = Arc::new(AtomicBool::new(false));
        let lost = Arc::new(AtomicU64::new(0));
        let description = Arc::new(OnceLock::new());
        let shared = (
            Arc::clone(&stop),
            Arc::clone(&lost),
            Arc::clone(&description),
        );
        let body = move || {
            let mut source = source;
            let ended = read(&mut source, &to, &shared.0, &shared.1, &shared.2);
            (source.counts(), ended)
        };
        let thread = thread::Builder::new().name("asperity-sensor".into());
        Ok(Self {
            batches,
            stop,
            lost,
            description,
            thread: thread.spawn(body)?,
        })
    }

    /// The next batch, if one waits.
    #[must_use]
    pub fn batch(&self) -> Option<Batch> {
        self.batches.try_recv().ok()
    }

    /// Returns true if no more samples will come; [`end`](Self::end) says why.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.thread.is_finished()
    }

    /// Returns the sensor's own description, once a sample has come.
    #[must_use]
    pub fn description(&self) -> Option<&SensorDescription> {
        self.description.get()
    }

    /// Samples that were lost since nobody took them.
    #[must_use]
    pub fn lost(&self) -> u64 {
        self.lost.load(Relaxed)
    }

    /// Ends the thread. Gives what came, and why nothing came any more.
    pub fn end(self) -> (Counts, Result<(), SensorError>) {
        self.stop.store(true, Relaxed);
        // A thread that panicked has said so.
        let ended = self.thread.join();
        ended.unwrap_or((Counts::default(), Ok(())))
    }
}

/// Why no sample came.
fn stalled(source: &dyn Source, patience: Duration) -> SensorError {
    let name = source.name().to_owned();
    if source.layout().is_none() && source.counts().bad_lines > 0 {
        return SensorError::Header {
            name,
            why: "did not come".into(),
        };
    }
    SensorError::Stalled {
        name,
        what: "no sample came",
        seconds: patience.as_secs(),
    }
}

fn read(
    source: &mut dyn Source,
    to: &SyncSender<Batch>,
    stop: &AtomicBool,
    lost: &AtomicU64,
    description: &OnceLock<SensorDescription>,
) -> Result<(), SensorError> {
    let clock = Monotonic::default();
    let mut last = Instant::now();
    while !stop.load(Relaxed) {
        let mut samples = Samples::default();
        let read = source.read(WAIT, &mut samples);
        let arrived_ns = clock.now_ns();
        if samples.is_empty() {
            read?;
            let patience = if description.get().is_some() {
                STALLED
            } else {
                FIRST
            };
            if last.elapsed() > patience {
                return Err(stalled(source, patience));
            }
            continue;
        }
        if samples.values.iter().any(|value| value.is_finite()) {
            last = Instant::now();
        } else if last.elapsed() > STALLED {
            return Err(SensorError::Stalled {
                name: source.name().to_owned(),
                what: "no number came, only missing values,",
                seconds: STALLED.as_secs(),
            });
        }
        if let (None, Some(layout)) = (description.get(), source.layout()) {
            // Nobody else sets it.
            let _ = description.set(SensorDescription {
                layout: layout.clone(),
                stated_scale: source.stated_scale(),
            });
        }
        let count = samples.len() as u64;
        match to.try_send(Batch {
            arrived_ns,
            samples,
        }) {
            Ok(()) => {}
            Err(TrySendError::Full(_)) => {
                lost.fetch_add(count, Relaxed);
            }
            Err(TrySendError::Disconnected(_)) => return Ok(()),
        }
        read?;
    }
    Ok(())
}

//! From the servo thread to a file, through a bounded queue and a thread that writes.

use std::io::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::sync::mpsc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use super::{Conditions, Encoder, Entry, SessionLogError, Summary, TextureInfo};

/// Poll interval of the writing thread.
const LOOK: Duration = Duration::from_millis(2);
/// Longest time that ticks wait for a full block.
const PATIENCE: Duration = Duration::from_millis(500);

/// The servo thread's end.
#[derive(Debug)]
pub struct Recorder {
    queue: rtrb::Producer<Entry>,
    /// Ticks lost since the last recorded one.
    lost: u32,
    all_lost: Arc<AtomicU64>,
}

impl Recorder {
    /// Records a tick. It never waits and never allocates: where the queue is full, the tick is
    /// lost and counted.
    pub fn push(&mut self, entry: Entry) {
        let entry = Entry {
            lost_before: self.lost,
            ..entry
        };
        if self.queue.push(entry).is_ok() {
            self.lost = 0;
        } else {
            self.lost = self.lost.saturating_add(1);
            self.all_lost.fetch_add(1, Relaxed);
        }
    }

    /// Ticks that were lost so far.
    #[must_use]
    pub fn lost(&self) -> u64 {
        self.all_lost.load(Relaxed)
    }
}

/// The writing thread.
#[derive(Debug)]
pub struct Writing {
    thread: JoinHandle<Result<Summary, SessionLogError>>,
    textures: mpsc::Sender<TextureInfo>,
}

impl Writing {
    /// Says which texture is the next to play. Call it before the servo thread can play it.
    pub fn announce(&self, texture: TextureInfo) {
        // A thread that ended early says why in `finish`.
        let _ = self.textures.send(texture);
    }

    /// Waits for the end of the file. The [`Recorder`] must have been dropped.
    ///
    /// # Errors
    /// [`SessionLogError`]: what could not be written.
    pub fn finish(self) -> Result<Summary, SessionLogError> {
        drop(self.textures);
        self.thread.join().map_err(|_| SessionLogError::Writer)?
    }
}

/// Begins a recording. `capacity` ticks fit into the queue; two seconds' worth forgive a slow disk.
///
/// # Errors
/// [`SessionLogError`]: the conditions could not be written, or no thread could be started.
pub fn start<W: Write + Send + 'static>(
    to: W,
    conditions: &Conditions,
    capacity: usize,
) -> Result<(Recorder, Writing), SessionLogError> {
    let encoder = Encoder::new(to, conditions)?;
    let (queue, entries) = rtrb::RingBuffer::new(capacity.max(1));
    let (textures, announced) = mpsc::channel();
    let all_lost = Arc::new(AtomicU64::new(0));
    let thread = std::thread::Builder::new()
        .name("recording".into())
        .spawn({
            let all_lost = Arc::clone(&all_lost);
            move || write(encoder, entries, &announced, &all_lost)
        })?;
    let recorder = Recorder {
        queue,
        lost: 0,
        all_lost,
    };
    Ok((recorder, Writing { thread, textures }))
}

fn write<W: Write>(
    mut encoder: Encoder<W>,
    mut entries: rtrb::Consumer<Entry>,
    announced: &mpsc::Receiver<TextureInfo>,
    all_lost: &AtomicU64,
) -> Result<Summary, SessionLogError> {
    let mut flushed = Instant::now();
    loop {
        // What was pushed before the end is in the queue once the end is seen.
        let ended = entries.is_abandoned();
        // An entry is looked at before the announcements, so that its texture is among them.
        let waiting = entries.slots();
        while let Ok(texture) = announced.try_recv() {
            encoder.announce(&texture)?;
        }
        for _ in 0..waiting {
            if let Ok(entry) = entries.pop() {
                encoder.push(&entry)?;
            }
        }
        if ended && waiting == 0 {
            let (_, summary) = encoder.finish(all_lost.load(Relaxed))?;
            return Ok(summary);
        }
        if flushed.elapsed() > PATIENCE {
            encoder.flush()?;
            flushed = Instant::now();
        }
        if !ended {
            std::thread::sleep(LOOK);
        }
    }
}

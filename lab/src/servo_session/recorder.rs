//! Every tick of a servo loop into a file, on a thread of its own: a disk that is slow keeps nobody
//! waiting who must stop the loop.

use super::error::ServoSessionError;
use super::trace::Trace;
use asperity_host::servo::Record;
use asperity_host::session_log::{Conditions, Encoder, FromServo, SessionLogError, TextureInfo};
use asperity_io::output::{OutputId, Outputs, is_standard_output};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, OnceLock};
use std::thread::{self, JoinHandle};

/// Output format of the ticks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// A table (CSV).
    Table,
    /// A recording (`formats/RECORDING.md`).
    SessionLog,
}

impl Form {
    /// The form that a name asks for: `.aspr` a recording; `.csv`, standard output and devices a
    /// table.
    ///
    /// # Errors
    /// [`ServoSessionError::RecordName`].
    pub fn of(path: &Path) -> Result<Self, ServoSessionError> {
        let is = |extension: &str| {
            path.extension()
                .is_some_and(|found| found.eq_ignore_ascii_case(extension))
        };
        let is_stream = is_standard_output(path)
            || path
                .metadata()
                .is_ok_and(|data| !data.is_file() && !data.is_dir());
        if is("aspr") {
            Ok(Self::SessionLog)
        } else if is("csv") || is_stream {
            Ok(Self::Table)
        } else {
            Err(ServoSessionError::RecordName(path.to_owned()))
        }
    }
}

/// Records that wait for a slow disk, at most; later ones are lost, and counted.
const WAITING: usize = 100_000;

/// A batch for the writer thread.
#[derive(Debug, Default)]
struct Batch {
    /// Textures that play in these records or later.
    textures: Vec<TextureInfo>,
    records: Vec<Record>,
    /// Ticks that were lost so far, known at the end.
    lost: u64,
}

/// A finished record.
#[derive(Debug)]
pub struct Written {
    /// The file, which [`Outputs::commit`] gives its name.
    pub outputs: Outputs,
    /// Ticks in it.
    pub ticks: u64,
}

/// The way to the thread that writes, and the thread, until it has ended. Dropped before, it is
/// waited for: it holds a temporary file.
#[derive(Debug)]
struct Writer(Option<(SyncSender<Batch>, Writing)>);

type Writing = JoinHandle<Result<Written, io::Error>>;

impl Writer {
    /// Waits for the end of the thread.
    fn end(&mut self) -> Option<thread::Result<Result<Written, io::Error>>> {
        let (to, thread) = self.0.take()?;
        drop(to);
        Some(thread.join())
    }
}

impl Drop for Writer {
    fn drop(&mut self) {
        // Nobody asks any more what became of it.
        let _ = self.end();
    }
}

/// Writes records on a thread of its own.
#[derive(Debug)]
pub struct Recorder {
    path: PathBuf,
    form: Form,
    writer: Writer,
    next: Batch,
    lost: u64,
    failure: Arc<OnceLock<String>>,
    is_closed: bool,
}

impl Recorder {
    /// Begins a record in an output that is open.
    ///
    /// # Errors
    /// [`ServoSessionError::Thread`].
    pub fn start(
        path: &Path,
        form: Form,
        outputs: Outputs,
        output: OutputId,
        conditions: Conditions,
    ) -> Result<Self, ServoSessionError> {
        // One batch is written while the next one comes together.
        let (to, batches) = sync_channel(1);
        let failure = Arc::new(OnceLock::new());
        let told = Arc::clone(&failure);
        let body = move || {
            let mut outputs = outputs;
            let file = outputs.file(output);
            let written = match form {
                Form::Table => table(file, &batches),
                Form::SessionLog => recording(file, &batches, &conditions),
            };
            match written {
                Ok(ticks) => Ok(Written { outputs, ticks }),
                Err(error) => {
                    // Nobody else sets it.
                    let _ = told.set(error.to_string());
                    Err(error)
                }
            }
        };
        let thread = thread::Builder::new().name("asperity-record".into());
        Ok(Self {
            path: path.to_owned(),
            form,
            writer: Writer(Some((
                to,
                thread.spawn(body).map_err(ServoSessionError::Thread)?,
            ))),
            next: Batch::default(),
            lost: 0,
            failure,
            is_closed: false,
        })
    }

    /// Takes a record.
    pub fn take(&mut self, record: &Record) {
        if self.is_closed {
            return;
        }
        if self.next.records.len() < WAITING {
            self.next.records.push(*record);
        } else {
            self.lost += 1;
        }
    }

    /// Says which texture is the next to play, before a record of it is taken.
    pub fn announce(&mut self, texture: TextureInfo) {
        self.next.textures.push(texture);
    }

    /// Hands over what was taken, unless the disk is behind.
    pub fn hand_over(&mut self) {
        if self.next.records.is_empty() {
            return;
        }
        let Some((to, _)) = &self.writer.0 else {
            return;
        };
        match to.try_send(std::mem::take(&mut self.next)) {
            Ok(()) => {}
            Err(TrySendError::Full(batch)) => self.next = batch,
            // It has said why; what comes later has no place.
            Err(TrySendError::Disconnected(_)) => self.is_closed = true,
        }
    }

    /// Takes no more: the loop begins anew. Gives whether the form has no place for that; a table
    /// goes on.
    pub fn begin_anew(&mut self) -> bool {
        self.is_closed |= self.form == Form::SessionLog;
        self.is_closed
    }

    /// Why nothing can be written any more.
    #[must_use]
    pub fn failure(&self) -> Option<&str> {
        self.failure.get().map(String::as_str)
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Records that this recorder lost, since the disk was behind.
    #[must_use]
    pub fn lost(&self) -> u64 {
        self.lost
    }

    /// Waits until everything is written. `lost` records never came to this recorder.
    ///
    /// # Errors
    /// [`ServoSessionError::Record`].
    pub fn finish(mut self, lost: u64) -> Result<Written, ServoSessionError> {
        self.next.lost = lost + self.lost;
        if let Some((to, _)) = &self.writer.0 {
            // The thread that is gone says why.
            let _ = to.send(self.next);
        }
        let ended = self.writer.end().ok_or(ServoSessionError::Bug)?;
        let written = ended.map_err(|_| ServoSessionError::Bug)?;
        written.map_err(|cause| ServoSessionError::Record {
            path: self.path,
            cause,
        })
    }
}

/// Writes a table; gives its rows.
fn table(mut file: impl io::Write, batches: &Receiver<Batch>) -> io::Result<u64> {
    let mut rows = Vec::new();
    let mut trace = Trace::begin(&mut rows)?;
    for batch in batches {
        for record in &batch.records {
            trace.row(record, &mut rows)?;
        }
        file.write_all(&rows)?;
        rows.clear();
    }
    file.write_all(&rows)?;
    file.flush()?;
    Ok(trace.rows())
}

/// Writes a recording; gives its ticks.
fn recording(
    file: impl io::Write,
    batches: &Receiver<Batch>,
    conditions: &Conditions,
) -> io::Result<u64> {
    let mut encoder = Encoder::new(file, conditions).map_err(plain)?;
    let mut entries = FromServo::default();
    let mut lost = 0;
    for batch in batches {
        for texture in &batch.textures {
            encoder.announce(texture).map_err(plain)?;
        }
        for record in &batch.records {
            encoder.push(&entries.entry(record)).map_err(plain)?;
        }
        lost = batch.lost;
    }
    let (_, summary) = encoder.finish(lost.max(entries.lost())).map_err(plain)?;
    Ok(summary.recorded)
}

fn plain(error: SessionLogError) -> io::Error {
    match error {
        SessionLogError::Io(error) => error,
        other => io::Error::other(other),
    }
}

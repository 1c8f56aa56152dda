//! Bounded work for the machine while a loop is measured.

use std::fs::File;
use std::io::{Seek as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering::Relaxed},
};
use std::thread::JoinHandle;
use std::time::Duration;
use std::{fs, hint, io, thread};

/// Bytes that each thread of [`Load::Memory`] streams through.
const MEMORY_BYTES: usize = 32 << 20;
/// Bytes that [`Load::Disk`] writes, over and over into one file.
const DISK_BYTES: usize = 16 << 20;
/// Threads of [`Load::Timers`].
const TIMER_THREADS: usize = 32;
/// Time between two timers of a thread.
const TIMER: Duration = Duration::from_micros(200);

/// Load on the machine during a measurement; it ends with it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Load {
    /// No load.
    None,
    /// A busy thread on every processor.
    Cpu,
    /// A thread on every processor that streams through 32 MiB.
    Memory,
    /// A thread that writes 16 MiB to a file and waits for the disk.
    Disk,
    /// 32 threads that sleep 200 µs each.
    Timers,
}

impl Load {
    /// Every load.
    pub const ALL: [Self; 5] = [
        Self::None,
        Self::Cpu,
        Self::Memory,
        Self::Disk,
        Self::Timers,
    ];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Cpu => "cpu",
            Self::Memory => "memory",
            Self::Disk => "disk",
            Self::Timers => "timers",
        }
    }
}

/// A load at work; dropping it ends it.
#[derive(Debug)]
pub struct Loading {
    stop: Arc<AtomicBool>,
    threads: Vec<JoinHandle<()>>,
    file: Option<PathBuf>,
}

impl Loading {
    /// Starts a load. [`Load::Disk`] writes a file of its own into `folder`, and removes it.
    ///
    /// # Errors
    /// [`io::Error`] where the file cannot be made, or the system allows no further thread.
    pub fn start(load: Load, folder: &Path) -> io::Result<Self> {
        let mut loading = Self {
            stop: Arc::default(),
            threads: Vec::new(),
            file: None,
        };
        let cpus = thread::available_parallelism().map_or(1, Into::into);
        match load {
            Load::None => {}
            Load::Cpu => {
                (0..cpus).try_for_each(|_| loading.repeat(|| (0..10_000).for_each(spin)))?;
            }
            Load::Memory => {
                for _ in 0..cpus {
                    let mut bytes = vec![0_u8; MEMORY_BYTES];
                    loading.repeat(move || stream(&mut bytes))?;
                }
            }
            Load::Disk => {
                let path = folder.join(format!("asperity-load-{}.tmp", std::process::id()));
                let mut file = File::create_new(&path)?;
                loading.file = Some(path);
                let bytes = vec![0x5a_u8; 1 << 20];
                loading.repeat(move || {
                    // A full disk is load as well.
                    let _ = write(&mut file, &bytes);
                })?;
            }
            Load::Timers => {
                (0..TIMER_THREADS).try_for_each(|_| loading.repeat(|| thread::sleep(TIMER)))?;
            }
        }
        Ok(loading)
    }

    fn repeat(&mut self, mut work: impl FnMut() + Send + 'static) -> io::Result<()> {
        let stop = Arc::clone(&self.stop);
        let body = move || {
            while !stop.load(Relaxed) {
                work();
            }
        };
        self.threads.push(thread::Builder::new().spawn(body)?);
        Ok(())
    }
}

fn spin(n: u32) {
    hint::black_box(n);
}

fn stream(bytes: &mut [u8]) {
    for line in bytes.chunks_mut(64) {
        line[0] = line[0].wrapping_add(1);
    }
    hint::black_box(bytes);
}

fn write(file: &mut File, bytes: &[u8]) -> io::Result<()> {
    file.rewind()?;
    for _ in 0..DISK_BYTES / bytes.len() {
        file.write_all(bytes)?;
    }
    file.sync_data()
}

impl Drop for Loading {
    fn drop(&mut self) {
        self.stop.store(true, Relaxed);
        for thread in self.threads.drain(..) {
            // A thread that panicked has ended too.
            let _ = thread.join();
        }
        if let Some(path) = &self.file {
            let _ = fs::remove_file(path);
        }
    }
}

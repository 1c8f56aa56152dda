//! Runs a command and measures what it took.

use std::{
    ffi::OsString,
    fs::{self, File},
    path::{Path, PathBuf},
    process::{Command, ExitStatus, Stdio},
    sync::mpsc::{RecvTimeoutError, channel},
    time::{Duration, Instant},
};
use wait4::Wait4 as _;

/// A command that takes longer is ended: it waits for something, whatever the machine's load.
const MAX_WALL: Duration = Duration::from_secs(60);

/// Outcome of a command.
pub(crate) struct Run {
    pub(crate) status: ExitStatus,
    pub(crate) was_killed: bool,
    pub(crate) cpu: Duration,
    pub(crate) wall: Duration,
    pub(crate) max_rss_bytes: u64,
    pub(crate) stderr: String,
}

/// Runs a program in a folder. What it prints never blocks it.
pub(crate) fn run(program: PathBuf, arguments: &[OsString], folder: &Path) -> Run {
    let printed = folder.with_extension("stderr");
    let stderr = File::create(&printed).expect("a file for what is printed");
    let from = Instant::now();
    let mut child = Command::new(program)
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(stderr)
        .spawn()
        .expect("the program starts");
    let id = child.id().to_string();
    let (ended, is_ended) = channel();
    let watch = std::thread::spawn(move || {
        let hangs = is_ended.recv_timeout(MAX_WALL) == Err(RecvTimeoutError::Timeout);
        if hangs {
            // The child is not waited for before this thread is, so the id is its own.
            let _ = Command::new("kill").args(["-KILL", &id]).status();
        }
        hangs
    });
    let usage = child.wait4().expect("the child ends");
    let wall = from.elapsed();
    // The thread has ended already where the child was killed.
    let _ = ended.send(());
    let was_killed = watch.join().expect("the watch does not panic");
    let stderr = fs::read(&printed).unwrap_or_default();
    let _ = fs::remove_file(printed);
    Run {
        status: usage.status,
        was_killed,
        cpu: usage.rusage.utime + usage.rusage.stime,
        wall,
        max_rss_bytes: usage.rusage.maxrss,
        stderr: String::from_utf8_lossy(&stderr).into_owned(),
    }
}

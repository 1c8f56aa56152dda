//! Files and folders that must not outlive an interrupt.

use std::{
    collections::BTreeSet,
    fs,
    path::PathBuf,
    sync::{Mutex, MutexGuard, PoisonError},
};

/// Files and folders that an interrupt removes.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// The list, locked. An interrupt waits for the lock, so what is done under it is whole.
pub(super) fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    // A list of paths is whole after any panic.
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes what is unfinished and exits with status 130, as an interrupt does. For a command with a
/// handler of its own.
pub fn clean_up_and_exit() -> ! {
    let list = unfinished();
    // In order of path, a folder comes before what was put into it.
    for path in list.iter().rev() {
        let _ = fs::remove_file(path).or_else(|_| fs::remove_dir(path));
    }
    // Still under the lock: no new file can appear.
    std::process::exit(130);
}

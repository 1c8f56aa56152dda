//! The threads that share a command's work.

use rayon::{ThreadBuilder, ThreadPoolBuildError, ThreadPoolBuilder};
use std::{
    sync::mpsc::{Sender, channel},
    thread,
};

/// More threads than these share no work of ours, whatever a variable asks for.
const MOST: usize = 1024;
/// Threads that are left to others where the system allows no more: one that reads a pipe, say.
const SPARE: usize = 2;

/// Starts as many threads as the machine has processors, or as `RAYON_NUM_THREADS` says. Where the
/// system allows fewer, these share the work; where it allows none, the calling thread does it. What
/// a command writes does not depend on their number. For a command's `main`, before its work.
///
/// Rayon starts its threads at their first use, and panics where it cannot start one.
pub fn share_work() {
    let wanted = wanted(std::env::var("RAYON_NUM_THREADS").ok().as_deref());
    // Each waits for its part in the pool, so that none can fail once the pool is asked for.
    let mut waiting: Vec<Sender<ThreadBuilder>> = Vec::new();
    while waiting.len() < wanted {
        let (part, told) = channel::<ThreadBuilder>();
        let started = thread::Builder::new().spawn(move || {
            // Without a part it ends.
            if let Ok(part) = told.recv() {
                part.run();
            }
        });
        if started.is_err() {
            waiting.truncate(waiting.len().saturating_sub(SPARE));
            break;
        }
        waiting.push(part);
    }
    // Fails only where a pool exists already.
    let _ = pool(waiting);
}

fn pool(mut waiting: Vec<Sender<ThreadBuilder>>) -> Result<(), ThreadPoolBuildError> {
    if waiting.is_empty() {
        let alone = ThreadPoolBuilder::new().num_threads(1);
        return alone.use_current_thread().build_global();
    }
    ThreadPoolBuilder::new()
        .num_threads(waiting.len())
        .spawn_handler(|part| {
            let thread = waiting.pop().and_then(|thread| thread.send(part).ok());
            thread.ok_or_else(|| std::io::ErrorKind::WouldBlock.into())
        })
        .build_global()
}

/// Number of threads that the user, or else the machine, asks for.
fn wanted(variable: Option<&str>) -> usize {
    let stated = variable.and_then(|text| text.trim().parse().ok());
    stated
        .filter(|&count: &usize| count > 0)
        .unwrap_or_else(|| thread::available_parallelism().map_or(1, usize::from))
        .min(MOST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_of_threads_is_taken_and_anything_else_is_the_machines() {
        let machine = wanted(None);
        assert!(machine >= 1);
        assert_eq!(wanted(Some("3")), 3);
        assert_eq!(wanted(Some("999999")), MOST);
        for none in ["0", "", "-1", "many", "99999999999999999999999"] {
            assert_eq!(wanted(Some(none)), machine, "{none:?}");
        }
    }
}

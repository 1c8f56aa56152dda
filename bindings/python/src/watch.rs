//! Long work that Python watches: Ctrl-C ends it, and its progress can be shown.

use pyo3::prelude::*;
use std::{
    panic::resume_unwind,
    sync::atomic::{
        AtomicBool, AtomicUsize,
        Ordering::{Acquire, Relaxed, Release},
    },
    thread,
    time::Duration,
};

/// Time between two looks for Ctrl-C.
const LOOK: Duration = Duration::from_millis(50);
/// Stack of the thread that works, as large as that of most main threads.
const STACK_BYTES: usize = 8 << 20;

/// Steps of a work: how many are done, and whether more are wanted.
#[derive(Default)]
pub(crate) struct Steps {
    done: AtomicUsize,
    total: AtomicUsize,
    /// Set once no more are wanted.
    pub(crate) stop: AtomicBool,
    is_over: AtomicBool,
}

impl Steps {
    /// States how many there are.
    pub(crate) fn of(&self, total: usize) {
        self.total.store(total, Relaxed);
    }

    /// Counts a completed step, from any thread.
    pub(crate) fn done(&self) {
        self.done.fetch_add(1, Relaxed);
    }
}

/// Wakes the thread that watches, however the work ends.
struct Over<'a>(&'a Steps, thread::Thread);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.is_over.store(true, Release);
        self.1.unpark();
    }
}

/// Does a work on a thread of its own, without the interpreter. `progress` is called with the steps that are done and
/// all of them, on the calling thread. An exception, of `progress` or by Ctrl-C, sets `stop`, which the work heeds.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Steps) -> T + Send,
) -> PyResult<T> {
    let steps = Steps::default();
    let mut shown = 0;
    let mut look = || -> PyResult<()> {
        py.check_signals()?;
        let done = steps.done.load(Relaxed);
        match progress {
            Some(progress) if done != shown => {
                shown = done;
                progress.call1((done, steps.total.load(Relaxed)))?;
            }
            _ => {}
        }
        Ok(())
    };
    thread::scope(|scope| {
        let caller = thread::current();
        let over = Over(&steps, caller);
        let worker = thread::Builder::new()
            .stack_size(STACK_BYTES)
            .spawn_scoped(scope, || {
                let over = over;
                work(over.0)
            })?;
        let mut seen = Ok(());
        loop {
            py.detach(|| thread::park_timeout(LOOK));
            // Before the look, so that the last one sees every step.
            let is_over = steps.is_over.load(Acquire);
            if seen.is_ok() {
                seen = look();
                steps.stop.store(seen.is_err(), Relaxed);
            }
            if is_over {
                break;
            }
        }
        let result = worker.join().unwrap_or_else(|panic| resume_unwind(panic));
        seen.map(|()| result)
    })
}

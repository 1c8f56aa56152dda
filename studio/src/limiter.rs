//! Limits how many requests work at once: compiling takes all processors, so a few at a time are as fast as many, and
//! take less memory.

use std::{
    sync::{Condvar, Mutex, PoisonError},
    thread::available_parallelism,
};

/// Most requests that compute, or whose large bodies are in memory, at once.
const MOST: usize = 4;

/// A counting semaphore.
pub(crate) struct Limiter {
    free: Mutex<usize>,
    given_back: Condvar,
}

impl Limiter {
    /// For requests that compute.
    pub(crate) fn computing() -> Self {
        Self::new(available_parallelism().map_or(1, usize::from).min(MOST))
    }

    /// For requests that send large bodies.
    pub(crate) fn sending() -> Self {
        Self::new(MOST)
    }

    fn new(turns: usize) -> Self {
        Self {
            free: Mutex::new(turns),
            given_back: Condvar::new(),
        }
    }

    /// Does this once it has a turn; gives it back even after a panic.
    pub(crate) fn take<T>(&self, work: impl FnOnce() -> T) -> T {
        let free = self.free.lock().unwrap_or_else(PoisonError::into_inner);
        let none = |free: &mut usize| *free == 0;
        let mut free = self
            .given_back
            .wait_while(free, none)
            .unwrap_or_else(PoisonError::into_inner);
        *free -= 1;
        drop(free);
        let _turn = Turn(self);
        work()
    }
}

/// A turn that was taken.
struct Turn<'a>(&'a Limiter);

impl Drop for Turn<'_> {
    fn drop(&mut self) {
        let mut free = self.0.free.lock().unwrap_or_else(PoisonError::into_inner);
        *free += 1;
        self.0.given_back.notify_one();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::{
        panic::{AssertUnwindSafe, catch_unwind},
        sync::atomic::{AtomicUsize, Ordering},
        thread::{scope, yield_now},
    };

    #[test]
    fn no_more_work_at_once_than_turns_and_a_panic_keeps_none() {
        let limiter = Limiter::computing();
        let all = *limiter.free.lock().unwrap();
        for _ in 0..all {
            let work = AssertUnwindSafe(|| limiter.take(|| panic!("a test's panic")));
            assert!(catch_unwind(work).is_err());
        }
        let (now, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        scope(|threads| {
            for _ in 0..16 {
                threads.spawn(|| {
                    limiter.take(|| {
                        most.fetch_max(now.fetch_add(1, Ordering::SeqCst) + 1, Ordering::SeqCst);
                        (0..100).for_each(|_| yield_now());
                        now.fetch_sub(1, Ordering::SeqCst);
                    });
                });
            }
        });
        assert!((1..=all).contains(&most.into_inner()));
        assert_eq!(*limiter.free.lock().unwrap(), all);
    }
}

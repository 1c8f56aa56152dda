//! The newest few words of one thread, for another.
//!
//! A sequence lock: the number is odd while the words change. A reader that meets a change tries
//! again some times, then goes without. Neither side ever waits.

use std::sync::atomic::{
    AtomicU32,
    Ordering::{Acquire, Relaxed, Release},
    fence,
};

/// Tries of a reader. A writer is done within nanoseconds, once a period.
const TRIES: usize = 64;

/// The newest `N` words of one writer.
#[derive(Debug)]
pub(super) struct Snapshot<const N: usize> {
    /// Twice the count of publications, and 1 more while one is under way.
    sequence: AtomicU32,
    words: [AtomicU32; N],
}

impl<const N: usize> Default for Snapshot<N> {
    fn default() -> Self {
        Self {
            sequence: AtomicU32::new(0),
            words: [const { AtomicU32::new(0) }; N],
        }
    }
}

impl<const N: usize> Snapshot<N> {
    /// Replaces the words. One thread alone may call this.
    pub(super) fn publish(&self, words: [u32; N]) {
        let sequence = self.sequence.load(Relaxed);
        self.sequence.store(sequence.wrapping_add(1), Relaxed);
        fence(Release);
        for (place, word) in self.words.iter().zip(words) {
            place.store(word, Relaxed);
        }
        self.sequence.store(sequence.wrapping_add(2), Release);
    }

    /// The count of publications and the newest words. `None` before the first, or if the writer
    /// was at it in every try.
    pub(super) fn newest(&self) -> Option<(u32, [u32; N])> {
        for _ in 0..TRIES {
            let before = self.sequence.load(Acquire);
            if before == 0 {
                return None;
            }
            let words = std::array::from_fn(|n| self.words[n].load(Relaxed));
            fence(Acquire);
            if before.is_multiple_of(2) && self.sequence.load(Relaxed) == before {
                return Some((before / 2, words));
            }
            std::hint::spin_loop();
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_read_was_published_as_a_whole() {
        let snapshot = Snapshot::<7>::default();
        assert_eq!(snapshot.newest(), None);
        std::thread::scope(|scope| {
            scope.spawn(|| (1..=200_000).for_each(|n| snapshot.publish([n; 7])));
            let mut last = 0;
            while last < 200_000 {
                if let Some((number, words)) = snapshot.newest() {
                    assert_eq!(words, [number; 7]);
                    assert!(number >= last, "never an older one");
                    last = number;
                }
            }
        });
    }
}

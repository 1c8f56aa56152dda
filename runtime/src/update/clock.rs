//! Models slower than the servo loop: their clock, in ticks.
//!
//! A model steps in one tick of several, always the same number of them; its samples are those
//! of a servo loop at its own rate. A cycle lasts as many samples as it has ticks there: the query
//! is taken in the last tick before the second sample, and takes effect with the sample in whose
//! place it would there, so that a change is heard after at most as many samples, whatever the
//! servo rate. Slices of the work fall into ticks without a sample.

use super::cycle::Cycle;

/// Ticks after a sample that do a slice, at most.
const WORKING_TICKS: u8 = 3;

/// Slices of a cycle at so many ticks a sample: one with the query, the others between samples.
pub(crate) const fn slices_of_cycle(ticks: u8, cycle: Cycle) -> usize {
    match ticks {
        0 | 1 => cycle.working() as usize,
        _ => 1 + (working_samples(cycle) * working_ticks(ticks)) as usize,
    }
}

/// Samples of a cycle after which work is done: all between that of the query and that of the
/// effect.
const fn working_samples(cycle: Cycle) -> u8 {
    cycle.working() - 2
}

const fn working_ticks(ticks: u8) -> u8 {
    if ticks > WORKING_TICKS {
        WORKING_TICKS
    } else {
        ticks - 1
    }
}

/// Where in a cycle a tick is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Clock {
    /// Sample of the cycle.
    sample: u8,
    /// Ticks since that sample.
    tick: u8,
}

impl Clock {
    /// Before the first tick of a cycle.
    pub(crate) const START: Self = Self {
        sample: 0,
        tick: u8::MAX,
    };

    /// A new cycle begins with the next sample; the clock goes on.
    pub(crate) fn begin_cycle(&mut self, cycle: Cycle) {
        self.sample = cycle.samples() - 1;
    }

    /// Goes on by a tick, of `ticks` a sample.
    #[inline(always)]
    pub(crate) fn advance(&mut self, ticks: u8, cycle: Cycle) {
        self.tick = self.tick.wrapping_add(1);
        if self.tick == ticks {
            self.tick = 0;
            self.sample += 1;
            if self.sample >= cycle.samples() {
                self.sample = 0;
            }
        }
    }

    /// Whether the models have a sample in this tick.
    #[inline(always)]
    pub(crate) const fn is_sample(&self) -> bool {
        self.tick == 0
    }

    /// Whether the query is taken in this tick.
    #[inline(always)]
    pub(crate) const fn is_query(&self, ticks: u8) -> bool {
        self.sample == 0 && self.tick == ticks - 1
    }

    /// The slice to do in this tick, if any: 1 and more.
    #[inline(always)]
    pub(crate) const fn slice(&self, ticks: u8, cycle: Cycle) -> Option<u8> {
        let working = working_ticks(ticks);
        let in_turn = self.sample.wrapping_sub(1);
        if in_turn < working_samples(cycle) && self.tick.wrapping_sub(1) < working {
            Some(in_turn * working + self.tick)
        } else {
            None
        }
    }
}

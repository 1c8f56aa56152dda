//! The clock of models that are slower than the servo loop, in ticks.
//!
//! A model has a sample in one of several ticks, always the same number of them. Its samples are
//! those of a servo loop at its own rate, and a cycle lasts as many samples as it lasts ticks in
//! that loop. The query is taken in the last tick before the second sample, and takes effect with
//! the same sample as it does there. So a change is heard after the same number of samples at most,
//! whatever the servo rate. Slices of the work fall into ticks without a sample.

use super::cycle::Cycle;

/// At most this many ticks after a sample do a slice.
const WORKING_TICKS: u8 = 3;

/// Slices of a cycle at so many ticks a sample: one with the query, the others between samples.
pub(crate) const fn slices_of_cycle(ticks: u8, cycle: Cycle) -> usize {
    match ticks {
        0 | 1 => cycle.working() as usize,
        _ => 1 + (working_samples(cycle) * working_ticks(ticks)) as usize,
    }
}

/// Samples of a cycle after which work is done: all between the sample of the query and the sample
/// of its effect.
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

    /// Returns true if the models have a sample in this tick.
    #[inline(always)]
    pub(crate) const fn is_sample(&self) -> bool {
        self.tick == 0
    }

    /// Returns true if the query is taken in this tick.
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

//! Models slower than the servo loop: their clock, in ticks.
//!
//! A model steps in one tick of several, always the same number of them; its samples are those
//! of a servo loop at its own rate. A cycle lasts as many samples as ticks there: the query is
//! taken in the last tick before the second sample, and takes effect with the sample in whose
//! place it would there, so that a change is heard after at most as many samples, whatever the
//! servo rate. Shares of the work fall into ticks without a sample.

use super::{Sounded, Vibration};
use crate::{
    Texture,
    arithmetic::{Arithmetic, Number, units::Unit},
    cycle::Cycle,
    interpolate::{Held, Interpolator},
    synthesis::Lags,
};

/// Ticks after a sample that do a share, at most.
const WORKING_TICKS: u8 = 3;

/// Shares of a cycle at so many ticks a sample: one with the query, the others between samples.
pub(crate) const fn shares_of_cycle(ticks: u8, cycle: Cycle) -> usize {
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
pub(super) struct Clock {
    /// Sample of the cycle.
    sample: u8,
    /// Ticks since that sample.
    tick: u8,
}

impl Clock {
    /// Before the first tick of a cycle.
    pub(super) const START: Self = Self {
        sample: 0,
        tick: u8::MAX,
    };

    /// A new cycle begins with the next sample; the clock goes on.
    pub(super) fn begin_cycle(&mut self, cycle: Cycle) {
        self.sample = cycle.ticks() - 1;
    }

    /// Goes on by a tick, of `ticks` a sample.
    #[inline(always)]
    fn advance(&mut self, ticks: u8, cycle: Cycle) {
        self.tick = self.tick.wrapping_add(1);
        if self.tick == ticks {
            self.tick = 0;
            self.sample += 1;
            if self.sample >= cycle.ticks() {
                self.sample = 0;
            }
        }
    }

    /// Whether the models have a sample in this tick.
    #[inline(always)]
    pub(super) const fn is_sample(&self) -> bool {
        self.tick == 0
    }

    /// Whether the query is taken in this tick.
    #[inline(always)]
    const fn is_query(&self, ticks: u8) -> bool {
        self.sample == 0 && self.tick == ticks - 1
    }

    /// The share to do in this tick, if any: 1 and more.
    #[inline(always)]
    const fn share(&self, ticks: u8, cycle: Cycle) -> Option<u8> {
        let working = working_ticks(ticks);
        let in_turn = self.sample.wrapping_sub(1);
        if in_turn < working_samples(cycle) && self.tick.wrapping_sub(1) < working {
            Some(in_turn * working + self.tick)
        } else {
            None
        }
    }
}

impl<A: Arithmetic> Vibration<A> {
    /// [`Vibration::prepare`] between samples, at `ticks` a sample.
    #[inline(never)]
    pub(super) fn prepare_between<
        const V: usize,
        const T: usize,
        const P: usize,
        const Q: usize,
        const K: usize,
    >(
        &mut self,
        texture: &Texture<V, T, P, Q, K, A>,
        follow_share: Number<A, Unit>,
        ticks: u8,
    ) {
        let cycle = texture.cycle();
        self.clock.advance(ticks, cycle);
        // To the rest of a tick a phase of 0 is the query's.
        self.phase = u8::from(!self.clock.is_query(ticks));
        if self.takes_query() {
            self.contact.begin_cycle();
        }
        if let Some(share) = self.clock.share(ticks, cycle) {
            self.work(texture, follow_share, texture.share(share));
            if usize::from(share) + 1 == shares_of_cycle(ticks, cycle) {
                self.finish(texture);
            }
        }
    }

    /// [`Vibration::sound`] between samples. With `sounding` false nothing is left of what the
    /// low-pass holds.
    #[inline(never)]
    pub(super) fn sound_between(
        &mut self,
        lags: Lags,
        interpolator: &Interpolator<A>,
        sounding: bool,
    ) -> Sounded<A> {
        let is_sample = self.clock.is_sample();
        let (y, clamped) = if is_sample {
            let e = self.draw();
            let (a, b) = (&self.a, &self.b);
            self.history
                .advance_in_loops(&mut self.newest, a, b, lags, e, sounding)
        } else {
            (Number::ZERO, false)
        };
        if !sounding {
            self.held = Held::SILENT;
        } else if is_sample && y == Number::ZERO {
            self.held.settle();
        }
        (interpolator.step(&mut self.held, y), clamped)
    }

    /// [`Vibration::finishes`] between samples.
    pub(super) fn finishes_between(&self, ticks: u8, cycle: Cycle) -> bool {
        let mut next = self.clock;
        next.advance(ticks, cycle);
        next.share(ticks, cycle)
            .is_some_and(|share| usize::from(share) + 1 == shares_of_cycle(ticks, cycle))
    }
}

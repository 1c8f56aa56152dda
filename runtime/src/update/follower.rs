//! The model under way, and the line spectrum that follows speed and force.

use super::{
    clock::{Clock, slices_of_cycle},
    cycle::Cycle,
    onset::Onset,
    plan::Plan,
    slices::Slice,
};
use crate::{
    arithmetic::Arithmetic,
    capacity::Capacity,
    model::{
        barycentric::{Search, WeightSearch},
        filter::{Model, Models},
        lsf_to_ar::LineSpectrum,
        mixture::RowMixture,
        scratch::Scratch,
        section_pair::SectionProduct,
    },
    quantity::{
        Quantity,
        unit::{DirectionFactor, ExcitationLevel, Fraction, MillimetrePerSecond, Newton},
    },
};

/// State of the work on the model under way.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Follower<A: Arithmetic> {
    /// The search, then the conversion under way.
    scratch: Scratch,
    /// The line spectrum that follows.
    spectrum: LineSpectrum<A>,
    /// The level of the mixture found, m/s².
    next_level: Quantity<A, ExcitationLevel>,
    phase: u8,
    clock: Clock,
    /// Block of the triangle found last.
    block: u8,
}

impl<A: Arithmetic> Follower<A> {
    /// Before the first query.
    pub(crate) const START: Self = Self {
        scratch: Scratch::IDLE,
        spectrum: LineSpectrum::ZERO,
        next_level: Quantity::ZERO,
        phase: 0,
        clock: Clock::START,
        block: 0,
    };

    /// Starts over with another texture. With `forget`, the old line spectrum is dropped.
    pub(crate) fn restart(&mut self, forget: bool) {
        if forget {
            self.spectrum = LineSpectrum::ZERO;
        }
        self.phase = 0;
        self.clock = Clock::START;
    }

    /// Starts over with another texture while the old model is still at work. The clock goes on.
    pub(crate) fn begin(&mut self, cycle: Cycle) {
        self.spectrum = LineSpectrum::ZERO;
        self.next_level = Quantity::ZERO;
        self.phase = 0;
        self.clock.begin_cycle(cycle);
    }

    /// Returns true if this tick ends with a query.
    #[inline(always)]
    pub(crate) const fn takes_query(&self) -> bool {
        self.phase == 0
    }

    /// Returns true if the models, slower than the servo loop, have a sample in this tick.
    #[inline(always)]
    pub(crate) const fn is_sample(&self) -> bool {
        self.clock.is_sample()
    }

    /// Returns true if a new model takes effect in the tick that begins.
    #[inline]
    pub(crate) fn finishes(&self, plan: &Plan) -> bool {
        let (ticks, cycle) = (plan.ticks_per_sample, plan.cycle);
        if ticks <= 1 {
            return self.phase + 1 == cycle.working();
        }
        let mut next = self.clock;
        next.advance(ticks, cycle);
        let slice = next.slice(ticks, cycle);
        slice.is_some_and(|slice| usize::from(slice) + 1 == slices_of_cycle(ticks, cycle))
    }
}

impl<A: WeightSearch + RowMixture + SectionProduct> Follower<A> {
    /// Begins a tick: does its slice of the cycle, unless that is the first one. The line spectrum
    /// goes a `fraction` of its way in a cycle; the level is `gain` times that of the grid.
    #[inline(always)]
    pub(crate) fn step<S: Capacity>(
        &mut self,
        models: &Models<S, A>,
        plan: &Plan,
        fraction: impl Fn() -> Quantity<A, Fraction>,
        gain: impl Fn() -> Quantity<A, DirectionFactor>,
        onset: &mut Onset,
        model: &mut Model<A>,
    ) {
        if plan.ticks_per_sample > 1 {
            self.step_between(models, plan, fraction(), gain(), onset, model);
        } else if self.phase == Cycle::OVER {
            self.phase = 0;
            onset.begin_cycle();
        } else if self.phase >= plan.cycle.working() {
            self.phase += 1;
        } else if self.phase > 0 {
            self.work(models, plan.slice(self.phase), fraction(), *onset);
            self.phase += 1;
            if self.phase == plan.cycle.working() {
                self.finish(models, gain(), onset, model);
                self.phase = plan.cycle.rest();
            }
        }
    }

    /// [`Follower::step`] where the models are slower than the servo loop.
    #[inline(never)]
    fn step_between<S: Capacity>(
        &mut self,
        models: &Models<S, A>,
        plan: &Plan,
        fraction: Quantity<A, Fraction>,
        gain: Quantity<A, DirectionFactor>,
        onset: &mut Onset,
        model: &mut Model<A>,
    ) {
        let (ticks, cycle) = (plan.ticks_per_sample, plan.cycle);
        self.clock.advance(ticks, cycle);
        // A phase of 0 tells the rest of the tick to take a query.
        self.phase = u8::from(!self.clock.is_query(ticks));
        if self.takes_query() {
            onset.begin_cycle();
        }
        if let Some(slice) = self.clock.slice(ticks, cycle) {
            self.work(models, plan.slice(slice), fraction, *onset);
            if usize::from(slice) + 1 == slices_of_cycle(ticks, cycle) {
                self.finish(models, gain, onset, model);
            }
        }
    }

    /// Ends a tick that takes a query: does the first slice of a cycle.
    #[inline(never)]
    pub(crate) fn query<S: Capacity>(
        &mut self,
        models: &Models<S, A>,
        plan: &Plan,
        speed: Quantity<A, MillimetrePerSecond>,
        force: Quantity<A, Newton>,
    ) {
        let mut search = models.grid.begin(speed, force, self.block);
        let blocks = plan.slice(0).blocks.into();
        models.grid.look(&mut search, blocks);
        search.keep(&mut self.scratch);
        self.phase = 1;
    }

    /// Does a slice of the work.
    #[inline(always)]
    fn work<S: Capacity>(
        &mut self,
        models: &Models<S, A>,
        slice: &Slice,
        fraction: Quantity<A, Fraction>,
        onset: Onset,
    ) {
        if slice.blocks > 0 && Search::<A>::goes_on(&self.scratch) {
            let mut search = Search::kept(&self.scratch);
            models.grid.look(&mut search, slice.blocks.into());
            search.keep(&mut self.scratch);
        }
        if slice.mixes {
            let search = Search::kept(&self.scratch);
            self.block = search.block();
            let mixture = models.grid.choose(&search);
            self.next_level = models.vertices.level(&mixture);
            // A new contact starts at its own model.
            let fraction = if onset == Onset::Followed {
                fraction
            } else {
                Quantity::whole(1)
            };
            models.follow(&mut self.spectrum, &mixture, fraction);
        }
        for part in slice.section_pairs() {
            models.multiply(&mut self.scratch, &self.spectrum, part);
        }
    }

    /// Puts the model to work that the cycle made.
    #[inline(always)]
    fn finish<S: Capacity>(
        &mut self,
        models: &Models<S, A>,
        gain: Quantity<A, DirectionFactor>,
        onset: &mut Onset,
        model: &mut Model<A>,
    ) {
        models.coefficients(&self.scratch, model);
        model.level = if *onset == Onset::Left {
            Quantity::ZERO
        } else {
            *onset = Onset::Followed;
            self.next_level * gain
        };
    }
}

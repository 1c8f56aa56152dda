//! The model under way, and the line spectrum that follows speed and force.

use super::{
    clock::{Clock, slices_of_cycle},
    cycle::Cycle,
    onset::Onset,
    slices::{Slice, Slices, cycle, slices},
};
use crate::{
    arithmetic::Arithmetic,
    capacity::Capacity,
    math::exp,
    model::{
        barycentric::{Search, WeightSearch},
        filter::{Model, Models},
        lsf_to_ar::LineSpectrum,
        mixture::BlockMixture,
        scratch::Scratch,
        section_pair::SectionProduct,
    },
    quantity::{
        Quantity,
        unit::{ExcitationLevel, Fraction, MillimetrePerSecond, Newton},
    },
};

/// How the work on a texture's models is cut, decided when it is loaded.
#[derive(Debug, Clone)]
pub(crate) struct Plan {
    /// How long a cycle lasts.
    pub(crate) cycle: Cycle,
    slices: Slices,
    /// Ticks that a sample of the models lasts.
    ticks_per_sample: u8,
}

impl Plan {
    /// The plan of a slot that was never loaded.
    pub(crate) const NONE: Self = Self {
        cycle: Cycle::SLOWEST,
        slices: Slices::NONE,
        ticks_per_sample: 1,
    };

    /// The plan for these models, at this many ticks a sample.
    pub(crate) fn new<S: Capacity, A: WeightSearch>(
        models: &Models<S, A>,
        ticks_per_sample: u8,
    ) -> Self {
        let (blocks, orders) = (models.grid.blocks(), &models.orders);
        let cycle = cycle(blocks, orders);
        let count = slices_of_cycle(ticks_per_sample, cycle);
        // Rows are mixed over the whole capacity of the slot.
        let fours = S::AR_ORDER / 4 + if orders.ma() > 0 { S::MA_ORDER / 4 } else { 0 };
        Self {
            cycle,
            slices: slices::<A>(blocks, fours, orders, count),
            ticks_per_sample,
        }
    }

    /// The work of a tick of the cycle.
    #[inline]
    fn slice(&self, phase: u8) -> &Slice {
        self.slices.of(phase)
    }
}

/// The fraction of its way that a one-pole of time constant `constant` goes in a time.
pub(crate) fn fraction_after(time: f32, constant: f32) -> f32 {
    let constants = constant / time;
    if constants > 0.0125 {
        1.0 - exp(-1.0 / constants)
    } else {
        1.0
    }
}

/// The fractions of the way to a mixture that a line spectrum goes in a cycle, by ticks a sample
/// and kind of cycle.
#[derive(Debug, Clone)]
pub(crate) struct Following<A: Arithmetic>([[Quantity<A, Fraction>; Cycle::KINDS]; 32]);

impl<A: Arithmetic> Following<A> {
    /// The fractions for a time constant in ticks.
    pub(crate) fn new(constant_ticks: f32) -> Self {
        Self(core::array::from_fn(|per_sample| {
            let mut fractions = [Quantity::ZERO; Cycle::KINDS];
            for cycle in Cycle::ALL {
                let ticks = usize::from(cycle.samples()) * per_sample.max(1);
                let fraction = fraction_after(ticks as f32, constant_ticks);
                fractions[cycle.kind()] = Quantity::of(fraction);
            }
            fractions
        }))
    }

    /// The fraction for a plan.
    #[inline(always)]
    pub(crate) fn of(&self, plan: &Plan) -> Quantity<A, Fraction> {
        self.0[usize::from(plan.ticks_per_sample % 32)][plan.cycle.kind()]
    }
}

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

    /// Whether this tick ends with a query.
    #[inline(always)]
    pub(crate) const fn takes_query(&self) -> bool {
        self.phase == 0
    }

    /// Whether the models have a sample in this tick, where they are slower than the servo loop.
    #[inline(always)]
    pub(crate) const fn is_sample(&self) -> bool {
        self.clock.is_sample()
    }

    /// Whether the tick that begins puts a new model to work.
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

impl<A: WeightSearch + BlockMixture + SectionProduct> Follower<A> {
    /// Begins a tick: does its slice of the cycle, unless that is the first one. The line spectrum
    /// goes a `fraction` of its way in a cycle.
    #[inline(always)]
    pub(crate) fn step<S: Capacity>(
        &mut self,
        models: &Models<S, A>,
        plan: &Plan,
        fraction: impl Fn() -> Quantity<A, Fraction>,
        onset: &mut Onset,
        model: &mut Model<A>,
    ) {
        if plan.ticks_per_sample > 1 {
            self.step_between(models, plan, fraction(), onset, model);
        } else if self.phase == Cycle::OVER {
            self.phase = 0;
            onset.begin_cycle();
        } else if self.phase >= plan.cycle.working() {
            self.phase += 1;
        } else if self.phase > 0 {
            self.work(models, plan.slice(self.phase), fraction(), *onset);
            self.phase += 1;
            if self.phase == plan.cycle.working() {
                self.finish(models, onset, model);
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
                self.finish(models, onset, model);
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
        onset: &mut Onset,
        model: &mut Model<A>,
    ) {
        models.coefficients(&self.scratch, model);
        model.level = if *onset == Onset::Left {
            Quantity::ZERO
        } else {
            *onset = Onset::Followed;
            self.next_level
        };
    }
}

//! The slot: one texture, decoded and prepared for the tick.

mod codes;
mod load;
mod needs;

pub use needs::Needs;

use crate::{
    arithmetic::Float,
    capacity::{Capacity, HostCapacities},
    coupling::Coupling,
    model::{
        barycentric::{Barycentric, WeightSearch},
        filter::{Filter, Models},
        mixture::RowMixture,
        section_pair::SectionProduct,
    },
    quantity::{
        Quantity,
        unit::{MillimetrePerSecond, Newton},
    },
    stage::{
        contact_law::ContactLaw,
        direction::Axis,
        friction_law::{FactorLookup, FrictionLaw},
        recursion::{InnerProduct, Recursion},
        tap::bank::TapBank,
        upsample::Upsampler,
    },
    update::plan::Plan,
};
use asperity_formats as formats;
use core::mem::MaybeUninit;

/// A texture slot in caller-provided memory.
///
/// `S` are its [capacities](crate::Capacities). One slot drives any number of
/// [`State`](crate::State)s; a texture that does not fit is refused.
#[derive(Debug, Clone)]
pub struct Texture<S: Capacity = HostCapacities, A: WeightSearch = Float> {
    pub(crate) models: Models<S, A>,
    pub(crate) plan: Plan,
    pub(crate) taps: TapBank<S, A>,
    pub(crate) coupling: Coupling<A>,
    pub(crate) law: FrictionLaw,
    contact: ContactLaw<A>,
    /// True if there is a contact law; an option would take four bytes.
    gives_way: bool,
    axis: Axis<A>,
    /// True if there is an axis.
    has_axis: bool,
    /// True if μ depends on the speed or the direction of a stroke.
    mu_varies: bool,
    id: u32,
    recursion: Recursion,
    upsampler: Upsampler<A>,
}

/// A slot for any texture. It takes 33 KiB, which is too much for most stacks: make it static, or
/// [build it in place](Texture::init).
pub type HostTexture = Texture<HostCapacities>;

impl<S: Capacity, A: WeightSearch + RowMixture + SectionProduct + InnerProduct> Default
    for Texture<S, A>
{
    fn default() -> Self {
        Self::new()
    }
}

impl<S: Capacity, A: WeightSearch + RowMixture + SectionProduct + InnerProduct> Texture<S, A> {
    /// An empty slot: no wall, no sound. A static begins with it and needs no stack.
    pub const EMPTY: Self = Self {
        models: Models::EMPTY,
        plan: Plan::NONE,
        taps: TapBank::EMPTY,
        coupling: Coupling::NONE,
        law: FrictionLaw::NONE,
        contact: ContactLaw::NONE,
        gives_way: false,
        axis: Axis::NONE,
        has_axis: false,
        mu_varies: false,
        id: 0,
        recursion: Recursion::new(0, 0),
        upsampler: Upsampler::NONE,
    };

    /// An empty slot: no wall, no sound. As a value it may pass through the stack;
    /// [`Texture::init`] builds one in place.
    #[must_use]
    pub const fn new() -> Self {
        Self::EMPTY
    }

    /// Builds an empty slot in memory of the caller's, which may come from
    /// [`Box::new_uninit`](https://doc.rust-lang.org/std/boxed/struct.Box.html#method.new_uninit)
    /// or a static. An optimised build copies it from the program's constants, not over the stack.
    #[inline]
    pub fn init(memory: &mut MaybeUninit<Self>) -> &mut Self {
        memory.write(Self::EMPTY)
    }

    /// Empties a slot in place, part by part: no wall, no sound. Needs no stack for the slot, and
    /// no constant of its size.
    pub fn clear(&mut self) {
        self.models = Models::EMPTY;
        self.plan = Plan::NONE;
        self.taps = TapBank::EMPTY;
        self.coupling = Coupling::NONE;
        self.law = FrictionLaw::NONE;
        self.contact = ContactLaw::NONE;
        self.gives_way = false;
        self.axis = Axis::NONE;
        self.has_axis = false;
        self.mu_varies = false;
        self.id = 0;
        self.recursion = Recursion::new(0, 0);
        self.upsampler = Upsampler::NONE;
    }

    /// Rate that the slot was loaded for, Hz; 0 for an empty slot.
    #[must_use]
    pub const fn servo_rate_hz(&self) -> f32 {
        self.upsampler.servo_rate_hz()
    }

    /// Ticks that a sample of the models lasts, 1 to 20: the servo rate over theirs.
    #[must_use]
    pub const fn ticks_per_sample(&self) -> u8 {
        self.upsampler.ticks()
    }

    /// Samples of the models from one query of speed and force to the next, 6 to 8: a larger
    /// texture takes more ticks to answer, and is asked more often.
    #[must_use]
    pub const fn cycle_samples(&self) -> u8 {
        self.plan.cycle.samples()
    }

    /// Wall and gains.
    #[must_use]
    pub fn coupling(&self) -> formats::Coupling {
        self.coupling.values()
    }

    /// Coefficient of kinetic friction; where it depends on speed, what the factors multiply.
    #[must_use]
    pub fn mu(&self) -> f32 {
        self.coupling.mu.value()
    }

    /// The tap bank at the servo rate.
    #[must_use]
    pub const fn taps(&self) -> &TapBank<S, A> {
        &self.taps
    }

    /// Triangle and weights of a query; convex and finite for every input.
    #[must_use]
    pub fn weights_at(&self, speed_mm_s: f32, force_n: f32) -> Barycentric<A> {
        let force = Quantity::of(force_n);
        self.models.grid.locate(Quantity::of(speed_mm_s), force)
    }

    /// The steady model of a query: what the tick renders once speed and force rest.
    #[must_use]
    pub fn filter_at(&self, speed_mm_s: f32, force_n: f32) -> Filter {
        let force = Quantity::of(force_n);
        self.models.model_at(Quantity::of(speed_mm_s), force).into()
    }

    /// [`filter_at`](Self::filter_at) of a query that was located in this texture.
    #[must_use]
    pub fn filter_of(&self, query: &Barycentric<A>) -> Filter {
        self.models.model_of(query).into()
    }

    /// Returns true if a query is answered by an edge model.
    #[inline]
    pub(crate) fn is_outside(
        &self,
        speed: Quantity<A, MillimetrePerSecond>,
        force: Quantity<A, Newton>,
    ) -> bool {
        self.models.grid.extent.is_outside(speed, force)
    }

    /// Checksum of what was loaded; 0 for an empty slot.
    #[inline]
    pub(crate) const fn id(&self) -> u32 {
        self.id
    }

    /// Returns true if a contact law takes the wall's place.
    #[must_use]
    pub const fn gives_way(&self) -> bool {
        self.gives_way
    }

    /// The contact law, if there is one.
    #[inline(always)]
    pub(crate) const fn contact_law(&self) -> Option<&ContactLaw<A>> {
        if self.gives_way {
            Some(&self.contact)
        } else {
            None
        }
    }

    /// Returns true if the texture differs along an axis and across it.
    #[must_use]
    pub const fn has_axis(&self) -> bool {
        self.has_axis
    }

    /// The axis, if there is one.
    #[inline(always)]
    pub(crate) const fn axis(&self) -> Option<&Axis<A>> {
        if self.has_axis {
            Some(&self.axis)
        } else {
            None
        }
    }

    /// Length and kind of the recursion.
    #[inline]
    pub(crate) const fn recursion(&self) -> Recursion {
        self.recursion
    }

    /// The low-pass from samples of the models to ticks.
    #[inline]
    pub(crate) const fn upsampler(&self) -> &Upsampler<A> {
        &self.upsampler
    }
}

impl<S: Capacity, A: WeightSearch + FactorLookup> Texture<S, A> {
    /// Coefficient of kinetic friction at a tangential speed, mm/s, across the axis if there is one.
    #[must_use]
    pub fn mu_at(&self, speed_mm_s: f32) -> f32 {
        let factor = self.law.factor(Quantity::of(speed_mm_s));
        (self.coupling.mu * factor).value()
    }

    /// Returns true if μ depends on the speed or the direction of a stroke.
    #[inline(always)]
    pub(crate) const fn mu_varies(&self) -> bool {
        self.mu_varies
    }
}

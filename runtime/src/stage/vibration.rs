//! The vibration y\[n\]: the model at work, driven by noise.
//!
//! `y[n] = Σ a_k(F_n, v_t) y[n−k] + ε[n]` of the paper: the follower in `update/` makes the model
//! in slices, [`Excitation`] draws ε, the [recursion](super::recursion) gives y. Where the servo
//! loop is faster than the models, a sample of theirs comes in one of several ticks, and the
//! upsampler (`upsample.rs`) gives the ticks between.
//!
//! A contact is silent until a query that was taken in it takes effect (`update/onset.rs`).

use super::{
    excitation::{Excitation, GaussianCubic},
    recursion::{History, InnerProduct, Recursion, VibrationSample},
    upsample::{Held, Upsampler},
};
use crate::{
    arithmetic::Float,
    capacity::Capacity,
    model::{
        barycentric::WeightSearch, filter::Model, mixture::RowMixture, section_pair::SectionProduct,
    },
    quantity::{
        Quantity,
        unit::{DirectionFactor, Fraction, MillimetrePerSecond, Newton, VibrationAcceleration},
    },
    texture::Texture,
    update::{cycle::Cycle, follower::Follower, onset::Onset, plan::Plan},
};

pub use crate::update::cycle::LAG_SAMPLES;

/// State of the vibration.
#[derive(Debug, Clone, PartialEq)]
pub struct Vibration<A: InnerProduct = Float> {
    follower: Follower<A>,
    /// The model at work.
    model: Model<A>,
    history: History<A>,
    /// State of the upsampler.
    held: Held<A>,
    excitation: Excitation,
    texture: u32,
    onset: Onset,
    /// Where the newest numbers of the history stand, 0..=3.
    newest: u8,
}

impl<A: InnerProduct> Vibration<A> {
    /// Silence. `seed` seeds the excitation.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self {
            follower: Follower::START,
            model: Model::SILENT,
            history: History::SILENT,
            held: Held::SILENT,
            excitation: Excitation::new(seed),
            texture: 0,
            onset: Onset::Begun,
            newest: 0,
        }
    }

    /// Ends the contact and its sound.
    pub(crate) fn silence(&mut self) {
        self.history = History::SILENT;
        self.held = Held::SILENT;
        self.leave();
        // The query of this tick is still to come.
        if self.takes_query() {
            self.onset.begin_cycle();
        }
    }

    #[inline]
    fn leave(&mut self) {
        self.model.level = Quantity::ZERO;
        self.onset = Onset::Left;
    }

    /// Changes to another texture. A cycle that began on one is not finished on the other.
    #[cold]
    pub(crate) fn change_texture(&mut self, texture: u32) {
        // A new state has nothing to forget.
        let used = self.texture != 0;
        if used {
            self.silence();
            self.model = Model::SILENT;
        }
        self.texture = texture;
        self.follower.restart(used);
        self.onset.begin_cycle();
    }

    /// Begins another texture. The model at work stays until the first cycle of the new texture
    /// ends.
    #[cold]
    pub(crate) fn begin(&mut self, texture: u32, cycle: Cycle) {
        self.texture = texture;
        self.follower.begin(cycle);
        self.onset = Onset::Begun;
    }

    /// Returns true if a new model takes effect in the tick that begins.
    #[inline]
    pub(crate) fn finishes(&self, plan: &Plan) -> bool {
        self.follower.finishes(plan)
    }

    /// Stops the model at work. Returns its last sample, m/s².
    #[cold]
    pub(crate) fn stop(&mut self) -> Quantity<A, VibrationAcceleration> {
        let last = self.history.last(self.newest);
        self.history = History::SILENT;
        self.model = Model {
            level: self.model.level,
            ..Model::SILENT
        };
        last
    }

    /// Returns true if the texture is the last one rendered.
    #[inline]
    pub(crate) const fn is_on(&self, texture: u32) -> bool {
        self.texture == texture
    }

    /// Returns true if this tick ends with a query.
    #[inline(always)]
    pub(crate) const fn takes_query(&self) -> bool {
        self.follower.takes_query()
    }
}

impl<A: WeightSearch + RowMixture + SectionProduct + GaussianCubic + InnerProduct> Vibration<A> {
    /// Computes a stand-alone tick: the slice of the cycle, the output and, if due, the query. The
    /// line spectrum covers a `fraction` of its way in a cycle ([`Texture::cycle_samples`]); with
    /// `sounding` false the vibration is mute.
    #[inline]
    pub fn step<S: Capacity>(
        &mut self,
        texture: &Texture<S, A>,
        speed: Quantity<A, MillimetrePerSecond>,
        force: Quantity<A, Newton>,
        fraction: Quantity<A, Fraction>,
        sounding: bool,
    ) -> VibrationSample<A> {
        if !self.is_on(texture.id()) {
            self.change_texture(texture.id());
        }
        self.prepare(texture, || fraction, || Quantity::whole(1));
        let sounded = self.sound(texture.recursion(), texture.upsampler(), sounding);
        self.query(texture, speed, force);
        sounded
    }

    /// Begins a tick on the texture of [`Vibration::is_on`]: does its slice of the cycle. The level is
    /// `gain` times that of the grid.
    #[inline(always)]
    pub(crate) fn prepare<S: Capacity>(
        &mut self,
        texture: &Texture<S, A>,
        fraction: impl Fn() -> Quantity<A, Fraction>,
        gain: impl Fn() -> Quantity<A, DirectionFactor>,
    ) {
        let (onset, model) = (&mut self.onset, &mut self.model);
        self.follower
            .step(&texture.models, &texture.plan, fraction, gain, onset, model);
    }

    /// The next output; `recursion` and `upsampler` belong to the texture at work.
    #[inline(always)]
    pub(crate) fn sound(
        &mut self,
        recursion: Recursion,
        upsampler: &Upsampler<A>,
        sounding: bool,
    ) -> VibrationSample<A> {
        if !sounding {
            self.leave();
        }
        if upsampler.ticks() > 1 {
            return self.sound_between(recursion, upsampler, sounding);
        }
        let e = self.draw();
        let (a, b) = (&self.model.a, &self.model.b);
        self.history
            .step(&mut self.newest, a, b, recursion, e, sounding)
    }

    /// [`Vibration::sound`] where the models are slower than the servo loop. With `sounding` false
    /// the upsampler is emptied.
    #[inline(never)]
    fn sound_between(
        &mut self,
        recursion: Recursion,
        upsampler: &Upsampler<A>,
        sounding: bool,
    ) -> VibrationSample<A> {
        let is_sample = self.follower.is_sample();
        let VibrationSample { y, clamped } = if is_sample {
            let e = self.draw();
            let (a, b) = (&self.model.a, &self.model.b);
            self.history
                .step_in_loops(&mut self.newest, a, b, recursion, e, sounding)
        } else {
            VibrationSample {
                y: Quantity::ZERO,
                clamped: false,
            }
        };
        if !sounding {
            self.held = Held::SILENT;
        } else if is_sample && y == Quantity::ZERO {
            self.held.settle();
        }
        let y = upsampler.step(&mut self.held, y);
        VibrationSample { y, clamped }
    }

    /// The next excitation, m/s².
    #[inline(always)]
    fn draw(&mut self) -> Quantity<A, VibrationAcceleration> {
        self.model.level * self.excitation.step::<A>()
    }

    /// Ends a tick: takes a query, where one is due.
    #[inline(always)]
    pub(crate) fn query<S: Capacity>(
        &mut self,
        texture: &Texture<S, A>,
        speed: Quantity<A, MillimetrePerSecond>,
        force: Quantity<A, Newton>,
    ) {
        if self.takes_query() {
            self.follower
                .query(&texture.models, &texture.plan, speed, force);
        }
    }
}

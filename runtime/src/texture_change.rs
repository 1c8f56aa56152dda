//! The way from one texture to the next while in contact.
//!
//! Wall, gains and friction go to the new texture as a one-pole, and so do the factor of a law of
//! friction and the forces of a contact law. The old vibration goes on until
//! the first model of the new texture is made. The new vibration then starts from silence, and the
//! last output of the old one fades beside it. So no step of the force is larger than the steps of
//! a texture by itself.

use crate::{
    capacity::Capacity,
    coupling::Coupling,
    events::Flags,
    quantity::{
        Quantity,
        unit::{DirectionFactor, Fraction, VibrationAcceleration},
    },
    render_arithmetic::RenderArithmetic,
    renderer::Renderer,
    sample::{Output, Sample},
    stage::{
        contact::DistanceField,
        contact_law::ContactState,
        direction::Heading,
        force_crossing::ForceCrossing,
        friction_law::FactorCrossing,
        recursion::{Recursion, VibrationSample},
        upsample::Upsampler,
        vibration::Vibration,
    },
    state::State,
    texture::Texture,
    tick::Touched,
};

/// The fraction of a stopped vibration that remains a tick later.
const FADE: f32 = 0.75;

/// State of the way from one texture to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TextureChange<A: RenderArithmetic> {
    /// Wall, gains and friction.
    coupling: Coupling<A>,
    /// The factor of μ.
    factor: FactorCrossing<A>,
    /// The forces of contact laws.
    pub(crate) forces: ForceCrossing<A>,
    /// The vibration.
    vibration: VibrationCrossing<A>,
    /// True if the last tick was in contact.
    pub(crate) touching: bool,
}

/// State of the way from one vibration to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
struct VibrationCrossing<A: RenderArithmetic> {
    /// Recursion of the vibration at work.
    recursion: Recursion,
    /// Ticks that a sample of the vibration at work lasts.
    ticks_per_sample: u8,
    /// Its last output, m/s².
    heard: Quantity<A, VibrationAcceleration>,
    /// The fading remainder of the previous vibration, m/s².
    fading: Quantity<A, VibrationAcceleration>,
    /// True while the vibration at work belongs to the previous texture.
    changing: bool,
}

impl<A: RenderArithmetic> TextureChange<A> {
    /// No wall, no friction, silence.
    pub(crate) const START: Self = Self {
        coupling: Coupling::NONE,
        factor: FactorCrossing::START,
        forces: ForceCrossing::START,
        vibration: VibrationCrossing::START,
        touching: false,
    };

    /// Returns true while the new texture's first model is being computed or the old vibration fades.
    #[inline]
    pub(crate) fn is_under_way(&self) -> bool {
        self.vibration.changing | (self.vibration.fading != Quantity::ZERO)
    }
}

impl<A: RenderArithmetic> VibrationCrossing<A> {
    /// Silence.
    const START: Self = Self {
        recursion: Recursion::new(0, 0),
        ticks_per_sample: 1,
        heard: Quantity::ZERO,
        fading: Quantity::ZERO,
        changing: false,
    };

    /// [`Vibration::prepare`] on the way from one texture to the next.
    #[inline]
    fn prepare<S: Capacity>(
        &mut self,
        vibration: &mut Vibration<A>,
        texture: &Texture<S, A>,
        fraction: impl Fn() -> Quantity<A, Fraction>,
        gain: impl Fn() -> Quantity<A, DirectionFactor>,
    ) {
        let ticks = texture.ticks_per_sample();
        if !vibration.is_on(texture.id()) {
            if self.ticks_per_sample == ticks {
                vibration.begin(texture.id(), texture.plan.cycle);
                self.changing = true;
            } else {
                // The clocks differ, so the old vibration stops at once.
                self.fading = self.fading + self.heard;
                self.ticks_per_sample = ticks;
                self.recursion = texture.recursion();
                self.changing = false;
                vibration.change_texture(texture.id());
            }
        }
        if self.changing && vibration.finishes(&texture.plan) {
            let last = vibration.stop();
            // Where there is an upsampler, what it holds fades by itself.
            if ticks == 1 {
                self.fading = self.fading + last;
            }
            self.recursion = texture.recursion();
            self.changing = false;
        }
        vibration.prepare(texture, fraction, gain);
    }

    /// [`Vibration::sound`], plus the vibration that fades beside it.
    #[inline]
    fn sound(
        &mut self,
        vibration: &mut Vibration<A>,
        upsampler: &Upsampler<A>,
        sounding: bool,
    ) -> VibrationSample<A> {
        let VibrationSample { y, clamped } = vibration.sound(self.recursion, upsampler, sounding);
        self.heard = y;
        let faded = Quantity::<A, Fraction>::of(FADE) * self.fading;
        // In fixed point a step or two are their own fade.
        let audible = (faded.max(-faded) > Quantity::of(A::SILENCE_M_S2)) & (faded != self.fading);
        self.fading = if sounding && audible {
            faded
        } else {
            Quantity::ZERO
        };
        VibrationSample {
            y: y + self.fading,
            clamped,
        }
    }
}

impl<A: RenderArithmetic> Renderer<A> {
    /// [`Renderer::tick`] on a solid, on the way to a texture. Without contact the way takes no
    /// time.
    #[inline(always)]
    pub(crate) fn tick_crossing<S: Capacity>(
        &self,
        field: &DistanceField<A>,
        texture: &Texture<S, A>,
        crossing: &mut TextureChange<A>,
        state: &mut State<A>,
        sample: &Sample<A>,
    ) -> Output<A> {
        let fraction = if crossing.touching {
            self.coupling_fraction
        } else {
            Quantity::whole(1)
        };
        crossing.coupling.follow(&texture.coupling, fraction);
        if texture.contact_law().is_some() | crossing.forces.is_lawful() {
            // The forces themselves follow.
            crossing.coupling.wall = texture.coupling.wall;
        }
        let coupling = crossing.coupling;
        let begins = !state.vibration.is_on(texture.id());
        // A wall follows in every tick, and one that gives way never.
        if texture.contact_law().is_none() || begins || state.vibration.takes_query() {
            self.lower(&coupling, texture.contact_law(), state);
        }
        let touched = Touched {
            texture,
            field,
            coupling: &coupling,
        };
        let following = || self.following.of(&texture.plan);
        if begins {
            state.contact = ContactState::UNTOUCHED;
            state.heading = Heading::none();
            crossing.forces.begin();
            crossing.factor.begin();
        }
        let gain = || state.heading.level;
        crossing
            .vibration
            .prepare(&mut state.vibration, texture, following, gain);
        let upsampler = texture.upsampler();
        let (factor, forces) = (&mut crossing.factor, &mut crossing.forces);
        let mu = |of_texture| factor.of(coupling.mu, of_texture, fraction);
        let mix = |force| forces.step(force, texture.contact_law().is_some(), fraction);
        let fading = &mut crossing.vibration;
        let sound =
            |vibration: &mut Vibration<A>, sounding| fading.sound(vibration, upsampler, sounding);
        let output = self.force(touched, state, sample, mu, mix, sound);
        Self::query(texture, state, &output);
        crossing.touching = output.flags.contains(Flags::CONTACT);
        output
    }
}

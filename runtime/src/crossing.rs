//! The way from one texture to the next while in contact.
//!
//! Wall, gains and friction go to the new texture as a one-pole. The old vibration goes on
//! until the first model of the new texture is made; that starts from silence, and the old
//! one's last output fades beside it: a step of the force is never more than a texture's own.

use crate::{
    Flags, Output, Renderer, Sample, State, Texture,
    arithmetic::{
        Arithmetic, Number, Point,
        units::{Acceleration, Unit},
    },
    contact::Solid,
    cycle::Cycle,
    interpolate::Interpolator,
    synthesis::Lags,
    texture::Feel,
    tick::Felt,
    vibration::Vibration,
};

/// What is left a tick later of a vibration that was stopped.
const FADE: f32 = 0.75;

/// What is felt on the way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crossing<A: Arithmetic> {
    /// Wall, gains and friction.
    feel: Feel<A>,
    /// Of the vibration at work.
    lags: Lags,
    /// Ticks a sample of the vibration at work.
    ticks_per_sample: u8,
    /// Its last output, m/s².
    heard_m_s2: Number<A, Acceleration>,
    /// What fades of the vibration before, m/s².
    fading_m_s2: Number<A, Acceleration>,
    /// The vibration at work is that of the texture before.
    changing: bool,
    /// In contact in the tick before.
    pub(crate) touching: bool,
}

impl<A: Arithmetic> Crossing<A> {
    /// No wall, no friction, silence.
    pub(crate) const START: Self = Self {
        feel: Feel::NONE,
        lags: Lags::new(0, 0),
        ticks_per_sample: 1,
        heard_m_s2: Number::ZERO,
        fading_m_s2: Number::ZERO,
        changing: false,
        touching: false,
    };

    /// Whether the new texture's model is still made, or the old sound still fades.
    #[inline]
    pub(crate) fn is_under_way(&self) -> bool {
        self.changing | (self.fading_m_s2 != Number::ZERO)
    }

    /// Goes `share` of the way to a texture's wall, gains and friction; exactly there with 1.
    #[inline]
    fn follow(&mut self, to: &Feel<A>, share: Number<A, Unit>) {
        let left = Number::whole(1) - share;
        let from = &mut self.feel;
        from.stiffness_n_m = mix(from.stiffness_n_m, to.stiffness_n_m, left);
        from.damping_n_s_m = mix(from.damping_n_s_m, to.damping_n_s_m, left);
        from.effective_mass_kg = mix(from.effective_mass_kg, to.effective_mass_kg, left);
        from.set_gain(
            mix(from.vib_s2_m, to.vib_s2_m, left),
            mix(from.f_max_n, to.f_max_n, left),
        );
        from.mu = mix(from.mu, to.mu, left);
    }

    /// [`Vibration::prepare`], from one texture to the next.
    #[inline]
    fn prepare<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize>(
        &mut self,
        vibration: &mut Vibration<A>,
        texture: &Texture<V, T, P, Q, K, A>,
        follow_share: impl Fn(u8, Cycle) -> Number<A, Unit>,
    ) {
        let ticks = texture.ticks_per_sample();
        if !vibration.is_on(texture.id()) {
            if self.ticks_per_sample == ticks {
                vibration.begin(texture.id(), texture.cycle());
                self.changing = true;
            } else {
                // Clocks of their own: the old one stops at once.
                self.fading_m_s2 = self.fading_m_s2 + self.heard_m_s2;
                self.ticks_per_sample = ticks;
                self.lags = texture.lags();
                self.changing = false;
                vibration.change_texture(texture.id());
            }
        }
        if self.changing && vibration.finishes(ticks, texture.cycle()) {
            let last = vibration.stop();
            // Between samples the low-pass gives what it holds, which fades by itself.
            if ticks == 1 {
                self.fading_m_s2 = self.fading_m_s2 + last;
            }
            self.lags = texture.lags();
            self.changing = false;
        }
        vibration.prepare(texture, follow_share);
    }

    /// [`Vibration::sound`], and what fades beside it.
    #[inline]
    fn sound(
        &mut self,
        vibration: &mut Vibration<A>,
        interpolator: &Interpolator<A>,
        sounding: bool,
    ) -> (Number<A, Acceleration>, bool) {
        let (y, clamped) = vibration.sound(self.lags, interpolator, sounding);
        self.heard_m_s2 = y;
        let faded = Number::<A, Unit>::of(FADE).times(self.fading_m_s2);
        let audible = faded.max(-faded) > Number::of(A::SILENCE_M_S2);
        self.fading_m_s2 = if sounding && audible {
            faded
        } else {
            Number::ZERO
        };
        (y + self.fading_m_s2, clamped)
    }
}

/// A number, `left` of the way before its end.
#[inline(always)]
fn mix<A: Arithmetic, F: Point>(
    from: Number<A, F>,
    to: Number<A, F>,
    left: Number<A, Unit>,
) -> Number<A, F> {
    to - left.times(to - from)
}

impl<A: Arithmetic> Renderer<A> {
    /// [`Renderer::tick`] on a solid, on the way to a texture; without contact it is there at
    /// once.
    #[inline(always)]
    pub(crate) fn tick_crossing<
        const V: usize,
        const T: usize,
        const P: usize,
        const Q: usize,
        const K: usize,
    >(
        &self,
        solid: &Solid<A>,
        texture: &Texture<V, T, P, Q, K, A>,
        crossing: &mut Crossing<A>,
        state: &mut State<A>,
        sample: &Sample<A>,
    ) -> Output<A> {
        let share = if crossing.touching {
            self.texture_share
        } else {
            Number::whole(1)
        };
        crossing.follow(&texture.feel, share);
        let feel = crossing.feel;
        let felt = Felt {
            solid,
            feel: &feel,
            wall: self.wall_of(&feel),
        };
        let follow_share = |ticks, cycle| self.follow_share(ticks, cycle);
        crossing.prepare(&mut state.vibration, texture, follow_share);
        let interpolator = texture.interpolator();
        let sound = |vibration: &mut Vibration<A>, sounding| {
            crossing.sound(vibration, interpolator, sounding)
        };
        let output = self.tick_on(felt, texture, state, sample, sound);
        if state.vibration.takes_query() {
            let (speed_mm_s, force_n) = (output.speed_mm_s, output.normal_force_n);
            let vibration = &mut state.vibration;
            vibration.query(texture, Number(speed_mm_s), Number(force_n));
        }
        crossing.touching = output.flags.contains(Flags::CONTACT);
        output
    }
}

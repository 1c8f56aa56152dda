//! The way from one texture to the next while in contact.
//!
//! Wall, gains and friction go to the new texture as a one-pole. The old vibration goes on
//! until the first model of the new texture is made; that starts from silence, and the old
//! one's last output fades beside it: a step of the force is never more than a texture's own.

use crate::{
    Flags, Output, Renderer, Sample, State, Texture, contact::Solid, interpolate::Interpolator,
    synthesis::Lags, tick::Felt, vibration::Vibration,
};
use asperity_formats::Surface;

/// What is left a tick later of a vibration that was stopped.
const FADE: f32 = 0.75;
/// Less than this is silence, m/s².
const SILENCE_M_S2: f32 = 1.0e-20;

/// What is felt on the way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crossing {
    /// Wall and gains.
    surface: Surface,
    /// Coefficient of kinetic friction.
    mu: f32,
    /// Of the vibration at work.
    lags: Lags,
    /// Ticks a sample of the vibration at work.
    ticks_per_sample: u8,
    /// Its last output, m/s².
    heard_m_s2: f32,
    /// What fades of the vibration before, m/s².
    fading_m_s2: f32,
    /// The vibration at work is that of the texture before.
    changing: bool,
    /// In contact in the tick before.
    pub(crate) touching: bool,
}

impl Crossing {
    /// No wall, no friction, silence.
    pub(crate) const START: Self = Self {
        surface: Surface {
            stiffness_n_m: 0.0,
            damping_n_s_m: 0.0,
            vib_s2_m: 0.0,
            effective_mass_kg: 0.0,
            f_max_n: 0.0,
        },
        mu: 0.0,
        lags: Lags::new(0, 0),
        ticks_per_sample: 1,
        heard_m_s2: 0.0,
        fading_m_s2: 0.0,
        changing: false,
        touching: false,
    };

    /// Whether the new texture's model is still made, or the old sound still fades.
    #[inline]
    pub(crate) fn is_under_way(&self) -> bool {
        self.changing | (self.fading_m_s2 != 0.0)
    }

    /// Goes `share` of the way to a texture's wall, gains and friction; exactly there with 1.
    #[inline]
    fn follow(&mut self, to: &Surface, mu: f32, share: f32) {
        let left = 1.0 - share;
        let mix = |from: f32, to: f32| to - left * (to - from);
        let from = &mut self.surface;
        from.stiffness_n_m = mix(from.stiffness_n_m, to.stiffness_n_m);
        from.damping_n_s_m = mix(from.damping_n_s_m, to.damping_n_s_m);
        from.vib_s2_m = mix(from.vib_s2_m, to.vib_s2_m);
        from.effective_mass_kg = mix(from.effective_mass_kg, to.effective_mass_kg);
        from.f_max_n = mix(from.f_max_n, to.f_max_n);
        self.mu = mix(self.mu, mu);
    }

    /// [`Vibration::prepare`], from one texture to the next.
    #[inline]
    fn prepare<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize>(
        &mut self,
        vibration: &mut Vibration,
        texture: &Texture<V, T, P, Q, K>,
        follow_share: impl Fn(u8) -> f32,
    ) {
        let ticks = texture.ticks_per_sample();
        if !vibration.is_on(texture.id()) {
            if self.ticks_per_sample == ticks {
                vibration.begin(texture.id());
                self.changing = true;
            } else {
                // Clocks of their own: the old one stops at once.
                self.fading_m_s2 += self.heard_m_s2;
                self.ticks_per_sample = ticks;
                self.lags = texture.lags();
                self.changing = false;
            }
        }
        if self.changing && vibration.is_last_of_cycle(ticks) {
            let last = vibration.stop();
            // Between samples the low-pass gives what it holds, which fades by itself.
            self.fading_m_s2 += if ticks > 1 { 0.0 } else { last };
            self.lags = texture.lags();
            self.changing = false;
        }
        vibration.prepare(texture, follow_share);
    }

    /// [`Vibration::sound`], and what fades beside it.
    #[inline]
    fn sound(
        &mut self,
        vibration: &mut Vibration,
        interpolator: &Interpolator,
        sounding: bool,
    ) -> (f32, bool) {
        let (y, clamped) = vibration.sound(self.lags, interpolator, sounding);
        self.heard_m_s2 = y;
        let faded = FADE * self.fading_m_s2;
        self.fading_m_s2 = if sounding && faded.abs() > SILENCE_M_S2 {
            faded
        } else {
            0.0
        };
        (y + self.fading_m_s2, clamped)
    }
}

impl Renderer {
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
        solid: &Solid,
        texture: &Texture<V, T, P, Q, K>,
        crossing: &mut Crossing,
        state: &mut State,
        sample: &Sample,
    ) -> Output {
        let share = if crossing.touching {
            self.texture_share
        } else {
            1.0
        };
        crossing.follow(&texture.surface, texture.mu, share);
        let (surface, mu) = (crossing.surface, crossing.mu);
        let felt = Felt {
            solid,
            surface: &surface,
            mu,
        };
        let follow_share = |ticks| self.follow_share(ticks);
        crossing.prepare(&mut state.vibration, texture, follow_share);
        let interpolator = texture.interpolator();
        let sound =
            |vibration: &mut Vibration, sounding| crossing.sound(vibration, interpolator, sounding);
        let output = self.tick_on(felt, texture, state, sample, sound);
        let (speed_mm_s, force_n) = (output.speed_mm_s, output.normal_force_n);
        state.vibration.query(texture, speed_mm_s, force_n);
        crossing.touching = output.flags.contains(Flags::CONTACT);
        output
    }
}

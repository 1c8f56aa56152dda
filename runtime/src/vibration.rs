//! The vibration y\[n\]: parameters that follow speed and force, and the next sample.
//!
//! The model at a speed and a force is made in cycles of [`CYCLE_TICKS`] ticks. The first
//! tick of a cycle takes the query; every tick does an equal share of location, mixture and
//! conversion; the last one puts the new coefficients and level to work. A change of speed or
//! force is thus heard after 5 to 10 ticks. Between cycles the shape of the spectrum follows
//! its target as a one-pole, which keeps the recursion bounded when speed or force jump; the
//! level is the target's.
//!
//! A contact is silent until a query that was taken in it takes effect, and starts at its own
//! model. Out of contact the cycles go on, so that a tick always costs the same.
//!
//! When the texture changes in a contact, the old model sounds on until the new one is made.
//! That starts from silence, and the last output fades beside it: a step of the force is never
//! more than a texture's own.

pub use crate::schedule::CYCLE_TICKS;
use crate::{
    Barycentric, Texture,
    excitation::Excitation,
    locate::Search,
    lsf::Products,
    synthesis::{History, Lags, Line},
    texture::Pairs,
};

/// What is left a tick later of a model that no longer sounds.
const FADE: f32 = 0.75;
/// Less than this is silence, m/s².
const FADED_M_S2: f32 = 1.0e-20;

/// State of the vibration.
#[derive(Debug, Clone, PartialEq)]
pub struct Vibration {
    /// Partial products of the conversion under way.
    products: Products,
    /// Smoothed parameters.
    pairs: Pairs,
    /// Coefficients at work.
    a: Line,
    b: Line,
    lags: Lags,
    history: History,
    level_m_s2: f32,
    /// What fades of the texture before, m/s².
    fading_m_s2: f32,
    // The query of the cycle under way, and what was found.
    speed_mm_s: f32,
    force_n: f32,
    search: Search,
    found: Barycentric,
    share: f32,
    excitation: Excitation,
    texture: u32,
    phase: u8,
    /// In contact since the query was taken.
    in_contact: bool,
    /// The parameters at work belong to this contact.
    follows: bool,
    /// The coefficients at work are those of the texture before.
    changing: bool,
}

impl Vibration {
    /// Silence; the seed is that of the excitation.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self {
            products: Products::ONE,
            pairs: Pairs::ZERO,
            a: Line::ZERO,
            b: Line::ZERO,
            lags: Lags { ar: 0, ma: 0 },
            history: History::SILENT,
            level_m_s2: 0.0,
            fading_m_s2: 0.0,
            speed_mm_s: 0.0,
            force_n: 0.0,
            search: Search::START,
            found: Barycentric::NONE,
            share: 1.0,
            excitation: Excitation::new(seed),
            texture: 0,
            phase: 0,
            in_contact: false,
            follows: false,
            changing: false,
        }
    }

    /// The contact ends, and what was heard of it.
    pub(crate) fn silence(&mut self) {
        self.history = History::SILENT;
        self.leave();
    }

    #[inline]
    fn leave(&mut self) {
        self.level_m_s2 = 0.0;
        self.fading_m_s2 = 0.0;
        self.in_contact = false;
        self.follows = false;
    }

    /// Another texture: a cycle begun on one is not finished on the other. What is at work
    /// stays until the first cycle ends.
    #[cold]
    fn change_texture(&mut self, texture: u32) {
        self.texture = texture;
        self.products = Products::ONE;
        self.pairs = Pairs::ZERO;
        self.found = Barycentric::NONE;
        self.phase = 0;
        self.follows = false;
        self.changing = true;
    }

    /// The first cycle on another texture ends.
    #[cold]
    fn take_over(&mut self, lags: Lags) {
        if self.in_contact {
            self.fading_m_s2 += self.history.last();
        }
        self.history = History::SILENT;
        (self.a, self.b, self.lags) = (Line::ZERO, Line::ZERO, lags);
        self.changing = false;
    }

    /// One tick. `follow_share` is the share of the way that parameters go in a cycle; with
    /// `sounding` false the vibration is mute. Returns y, m/s², and whether it had to be
    /// clamped.
    #[inline]
    pub fn step<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize>(
        &mut self,
        texture: &Texture<V, T, P, Q, K>,
        speed_mm_s: f32,
        force_n: f32,
        follow_share: f32,
        sounding: bool,
    ) -> (f32, bool) {
        if self.texture != texture.id() {
            self.change_texture(texture.id());
        }
        if !sounding {
            self.leave();
        }
        if self.phase == 0 {
            (self.speed_mm_s, self.force_n) = texture.locator.clamp(speed_mm_s, force_n);
            self.search = Search::START;
            self.in_contact = sounding;
            self.share = if self.follows { follow_share } else { 1.0 };
        }
        self.work(texture);
        let e = self.level_m_s2 * self.excitation.next_gaussian();
        let (y, clamped) = self.history.step(&self.a, &self.b, self.lags, e, sounding);
        let faded = FADE * self.fading_m_s2;
        self.fading_m_s2 = if faded.abs() > FADED_M_S2 { faded } else { 0.0 };
        (y + self.fading_m_s2, clamped)
    }

    /// This tick's share of the cycle.
    #[inline]
    fn work<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize>(
        &mut self,
        texture: &Texture<V, T, P, Q, K>,
    ) {
        let share = texture.share(self.phase);
        let (speed, force) = (self.speed_mm_s, self.force_n);
        texture
            .locator
            .look(&mut self.search, speed, force, share.blocks());
        if share.chooses {
            self.found = texture.locator.choose(&self.search, speed, force);
        }
        if share.mixes_ar {
            texture.follow_ar(&mut self.pairs, &self.found, self.share);
        }
        if share.mixes_ma {
            texture.follow_ma(&mut self.pairs, &self.found, self.share);
        }
        for unit in share.units() {
            texture.multiply(&mut self.products, &self.pairs, unit);
        }
        self.phase += 1;
        if usize::from(self.phase) >= CYCLE_TICKS {
            self.phase = 0;
            if self.changing {
                self.take_over(texture.lags());
            }
            texture.coefficients(&self.products, &mut self.a, &mut self.b);
            self.level_m_s2 = if self.in_contact {
                texture.level_m_s2(&self.found)
            } else {
                0.0
            };
            self.follows = self.in_contact;
        }
    }
}

//! The vibration y\[n\]: parameters that follow speed and force, and the next sample.
//!
//! The model at a speed and a force is made in cycles ([`Texture::cycle_samples`]). The first
//! tick of a cycle ends with a query and the first share of location, mixture and conversion; three
//! to five more, as many as the texture's size asks for, begin with a share each, the last of
//! which puts the new coefficients and level to work. The others do nothing of this: the next
//! query is taken as late as lets a change of speed or force be heard within [`LAG_SAMPLES`].
//! Between cycles the shape of the spectrum follows its target as a one-pole, which keeps the
//! recursion bounded when speed or force jump; the level is the target's.
//!
//! A contact is silent until a query that was taken in it takes effect, and starts at its own
//! model. Out of contact the cycles go on, so that a tick always costs the same.
//!
//! Where the servo loop is faster than the models, a sample of theirs takes the place of a tick
//! in all of this (`vibration/between.rs`), and a low-pass gives the ticks between them.

pub(crate) mod between;

pub use crate::cycle::LAG_SAMPLES;
use crate::{
    Texture,
    arithmetic::{
        Arithmetic, Float, Number,
        units::{Acceleration, Level, MillimetrePerSecond, Newton, Unit},
    },
    cycle::Cycle,
    excitation::Excitation,
    interpolate::{Held, Interpolator},
    locate::Search,
    lsf::Pairs,
    schedule::Share,
    synthesis::{History, Lags, Line},
    workspace::Workspace,
};
use between::Clock;

/// State of the vibration.
#[derive(Debug, Clone, PartialEq)]
pub struct Vibration<A: Arithmetic = Float> {
    /// The search, then the conversion under way.
    workspace: Workspace,
    /// Smoothed parameters.
    pairs: Pairs<A>,
    /// Coefficients at work.
    a: Line<A>,
    b: Line<A>,
    history: History<A>,
    /// What the low-pass between samples holds.
    held: Held<A>,
    level_m_s2: Number<A, Level>,
    /// That of the mixture found.
    next_level_m_s2: Number<A, Level>,
    excitation: Excitation,
    texture: u32,
    phase: u8,
    clock: Clock,
    contact: Contact,
    /// Where the newest of the history stand, 0..=3.
    newest: u8,
    /// Block of the triangle found last.
    block: u8,
}

/// What of a cycle was in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Contact {
    /// Not all of it.
    Left,
    /// Every tick since its query, that one included.
    Begun,
    /// The same, and the parameters at work belong to this contact.
    Followed,
}

impl Contact {
    /// A query is taken.
    #[inline(always)]
    fn begin_cycle(&mut self) {
        if *self == Self::Left {
            *self = Self::Begun;
        }
    }
}

/// A sample, m/s², and whether it had to be clamped.
type Sounded<A> = (Number<A, Acceleration>, bool);

impl<A: Arithmetic> Vibration<A> {
    /// Silence; the seed is that of the excitation.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self {
            workspace: Workspace::IDLE,
            pairs: Pairs::ZERO,
            a: Line::ZERO,
            b: Line::ZERO,
            history: History::SILENT,
            held: Held::SILENT,
            level_m_s2: Number::ZERO,
            next_level_m_s2: Number::ZERO,
            excitation: Excitation::new(seed),
            texture: 0,
            phase: 0,
            clock: Clock::START,
            contact: Contact::Begun,
            newest: 0,
            block: 0,
        }
    }

    /// The contact ends, and what was heard of it.
    pub(crate) fn silence(&mut self) {
        self.history = History::SILENT;
        self.held = Held::SILENT;
        self.leave();
        // A query of this tick follows.
        if self.takes_query() {
            self.contact.begin_cycle();
        }
    }

    #[inline]
    fn leave(&mut self) {
        self.level_m_s2 = Number::ZERO;
        self.contact = Contact::Left;
    }

    /// Another texture: a cycle begun on one is not finished on the other.
    #[cold]
    pub(crate) fn change_texture(&mut self, texture: u32) {
        // A new state has nothing to forget.
        if self.texture != 0 {
            self.silence();
            self.pairs = Pairs::ZERO;
            (self.a, self.b) = (Line::ZERO, Line::ZERO);
        }
        self.texture = texture;
        self.phase = 0;
        self.contact.begin_cycle();
        self.clock = Clock::START;
    }

    /// Another texture in a scene: what is at work stays until the first cycle ends.
    #[cold]
    pub(crate) fn begin(&mut self, texture: u32, cycle: Cycle) {
        self.texture = texture;
        self.pairs = Pairs::ZERO;
        self.next_level_m_s2 = Number::ZERO;
        self.phase = 0;
        self.contact = Contact::Begun;
        self.clock.begin_cycle(cycle);
    }

    /// Whether the tick that begins, of `ticks` a sample, puts new coefficients to work.
    #[inline]
    pub(crate) fn finishes(&self, ticks: u8, cycle: Cycle) -> bool {
        if ticks > 1 {
            return self.finishes_between(ticks, cycle);
        }
        self.phase + 1 == cycle.working()
    }

    /// Stops what is at work. Returns its last sample, m/s².
    #[cold]
    pub(crate) fn stop(&mut self) -> Number<A, Acceleration> {
        let last = self.history.last(self.newest);
        self.history = History::SILENT;
        (self.a, self.b) = (Line::ZERO, Line::ZERO);
        last
    }

    /// Whether the texture is the one that was rendered last.
    #[inline]
    pub(crate) const fn is_on(&self, texture: u32) -> bool {
        self.texture == texture
    }

    /// One tick by itself. `follow_share` is the share of the way that parameters go in a cycle
    /// ([`Texture::cycle_samples`]); with `sounding` false the vibration is mute. Returns y, m/s², and whether it had to be
    /// clamped.
    #[inline]
    pub fn step<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize>(
        &mut self,
        texture: &Texture<V, T, P, Q, K, A>,
        speed_mm_s: A::Scalar<MillimetrePerSecond>,
        force_n: A::Scalar<Newton>,
        follow_share: A::Scalar<Unit>,
        sounding: bool,
    ) -> (A::Scalar<Acceleration>, bool) {
        if !self.is_on(texture.id()) {
            self.change_texture(texture.id());
        }
        self.prepare(texture, |_, _| Number(follow_share));
        let (y, clamped) = self.sound(texture.lags(), texture.interpolator(), sounding);
        if self.takes_query() {
            self.query(texture, Number(speed_mm_s), Number(force_n));
        }
        (y.0, clamped)
    }

    /// Begins a tick on the texture of [`Vibration::is_on`]: its share of the cycle, where that is
    /// not the first one. `follow_share` is asked with the ticks a sample of the texture and its
    /// cycle.
    #[inline(always)]
    pub(crate) fn prepare<
        const V: usize,
        const T: usize,
        const P: usize,
        const Q: usize,
        const K: usize,
    >(
        &mut self,
        texture: &Texture<V, T, P, Q, K, A>,
        follow_share: impl Fn(u8, Cycle) -> Number<A, Unit>,
    ) {
        let (ticks, cycle) = (texture.interpolator().ticks(), texture.cycle());
        if ticks > 1 {
            self.prepare_between(texture, follow_share(ticks, cycle), ticks);
        } else if self.phase == Cycle::OVER {
            self.phase = 0;
            self.contact.begin_cycle();
        } else if self.phase >= cycle.working() {
            self.phase += 1;
        } else if self.phase > 0 {
            let share = texture.share(self.phase);
            self.work(texture, follow_share(1, cycle), share);
            self.phase += 1;
            if self.phase == cycle.working() {
                self.finish(texture);
                self.phase = cycle.rest();
            }
        }
    }

    /// The next output; `lags` and `interpolator` are those of the texture at work.
    #[inline(always)]
    pub(crate) fn sound(
        &mut self,
        lags: Lags,
        interpolator: &Interpolator<A>,
        sounding: bool,
    ) -> Sounded<A> {
        if !sounding {
            self.leave();
        }
        if interpolator.ticks() > 1 {
            return self.sound_between(lags, interpolator, sounding);
        }
        let e = self.draw();
        let (a, b) = (&self.a, &self.b);
        self.history
            .advance(&mut self.newest, a, b, lags, e, sounding)
    }

    /// The next excitation, m/s².
    #[inline(always)]
    pub(super) fn draw(&mut self) -> Number<A, Acceleration> {
        let gaussian = self.excitation.draw::<A>();
        self.level_m_s2.times_within(gaussian, A::VIB_LIMIT_M_S2)
    }

    /// Whether this tick ends with a query.
    #[inline(always)]
    pub(crate) const fn takes_query(&self) -> bool {
        self.phase == 0
    }

    /// Ends a tick that takes a query, with the first share of a cycle.
    #[inline(never)]
    pub(crate) fn query<
        const V: usize,
        const T: usize,
        const P: usize,
        const Q: usize,
        const K: usize,
    >(
        &mut self,
        texture: &Texture<V, T, P, Q, K, A>,
        speed_mm_s: Number<A, MillimetrePerSecond>,
        force_n: Number<A, Newton>,
    ) {
        let mut search = texture.locator.begin(speed_mm_s, force_n, self.block);
        let blocks = texture.share(0).blocks.into();
        texture.locator.look(&mut search, blocks);
        search.keep(&mut self.workspace);
        self.phase = 1;
    }

    /// The share of another tick.
    #[inline(always)]
    fn work<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize>(
        &mut self,
        texture: &Texture<V, T, P, Q, K, A>,
        follow_share: Number<A, Unit>,
        share: &Share,
    ) {
        if share.blocks > 0 && Search::<A>::goes_on(&self.workspace) {
            let mut search = Search::kept(&self.workspace);
            texture.locator.look(&mut search, share.blocks.into());
            search.keep(&mut self.workspace);
        }
        if share.mixes {
            let search = Search::kept(&self.workspace);
            self.block = search.block();
            let found = texture.locator.choose(&search);
            self.next_level_m_s2 = texture.level_m_s2(&found);
            // A new contact starts at its own model.
            let way = if self.contact == Contact::Followed {
                follow_share
            } else {
                Number::whole(1)
            };
            texture.follow(&mut self.pairs, &found, way);
        }
        for part in share.twos() {
            texture.multiply(&mut self.workspace, &self.pairs, part);
        }
    }

    /// Puts what the cycle made to work.
    #[inline(always)]
    fn finish<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize>(
        &mut self,
        texture: &Texture<V, T, P, Q, K, A>,
    ) {
        texture.coefficients(&self.workspace, &mut self.a, &mut self.b);
        self.level_m_s2 = if self.contact == Contact::Left {
            Number::ZERO
        } else {
            self.contact = Contact::Followed;
            self.next_level_m_s2
        };
    }
}

//! The contact law of a material that gives way: what takes the wall's place where an asset has one.
//!
//! With δ the depth below the undeformed surface, p the imprint and e = max(δ − p, 0):
//!
//! ```text
//! F_el = max(k·s(e) + q, 0)                  load: a spring of shape s, and a Maxwell branch
//! q'   = a·q + k₁·g·Δe                       a = exp(−T/τ), g = (1 − a)·τ/T: exact for a steady motion
//! p'   = max(p, χ·(δ − e_y))                 imprint, and it heals with slip or recovers in the open
//! F_n  = max(F_el − (b + λ·F_el)·ḋ, 0) − u   damping after Hunt and Crossley, less adhesion's pull
//! u'   = clamp(u − k_a·Δe, 0, min(A, k_a·e))
//! F_t ≤ μ(v)·F_el + (c·v + w)·δ              drag raises the limit of the bristle
//! ```
//!
//! **No part gives energy off**, as far as a sampled spring does not ([`passivity`](super::passivity),
//! which counts k + k₁ + k_a and the damping at the device's greatest force). The spring stores; the
//! branch and the pull are springs in series with what only loses. The imprint grows only while the
//! spring is beyond its yield, which loses; under a load it heals by the ratio of friction and load, at
//! most by h, a metre of slip, so that the friction pays for what lifts the tip; and it recovers only
//! in the open. Drag is nothing but the limit at which the bristle slips.
//!
//! **At rest** nothing moves: imprint and pull change with motion alone. In the open every number
//! goes to zero, exactly.

use super::{
    passivity::{Lowered, Passivity},
    spring_shape::SpringShape,
    wall::{Pushing, Wall},
};
use crate::{
    arithmetic::{Arithmetic, Cut},
    math::{exp, min},
    quantity::{
        Magnitudes, Quantity, Vector,
        unit::{
            FineNewton, Fraction, FrictionCoefficient, Metre, MetrePerSecond, MillimetrePerMetre,
            MillimetrePerSecond, Newton, NewtonPerMetre, NewtonSecondPerMetre,
            NewtonSecondPerSquareMetre, RelaxingNewton, Second, SecondPerMetre,
        },
    },
};
use asperity_formats as formats;

/// The greatest force of a Maxwell branch, N.
const STRONGEST_N: f32 = 30.0;
/// A branch weaker than this, N, is relaxed in the open.
const WEAKEST_N: f32 = 4.0e-3;
/// An imprint shallower than this, m, is none in the open: half a count of a Touch.
const SHALLOWEST_M: f32 = 20.0e-6;
/// Metres of imprint that a metre of travel in the open leaves behind: four depths away the surface
/// is fresh.
const FRESH: f32 = 0.25;
/// Yielding slower than this, mm/s, is silent.
const SLOWEST_MM_S: f32 = 0.1;
/// The part of the speed of yielding that is left a tick later, where nothing yields.
const CRUNCH: f32 = 0.9375;

/// The law of a texture, or none, prepared for a servo rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ContactLaw<A: Arithmetic> {
    /// s(e).
    shape: SpringShape<A>,
    /// λ.
    damping: Quantity<A, SecondPerMetre>,
    /// k₁.
    relaxing: Quantity<A, NewtonPerMetre>,
    /// 1 − a.
    relaxes: Quantity<A, Fraction>,
    /// g.
    held: Quantity<A, Fraction>,
    /// e_y.
    yields: Quantity<A, Metre>,
    /// χ.
    share: Quantity<A, Fraction>,
    /// h.
    heals: Quantity<A, Fraction>,
    /// 1 − exp(−T/τ_p); 0 for never.
    recovers: Quantity<A, Fraction>,
    /// c.
    viscous: Quantity<A, NewtonSecondPerSquareMetre>,
    /// w.
    plough: Quantity<A, NewtonPerMetre>,
    /// A.
    pull: Quantity<A, Newton>,
    /// k_a.
    sticking: Quantity<A, NewtonPerMetre>,
}

/// State of a [`ContactLaw`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ContactState<A: Arithmetic> {
    /// q, N.
    relaxing: Quantity<A, RelaxingNewton>,
    /// p, m.
    imprint: Quantity<A, Metre>,
    /// u, N.
    pull: Quantity<A, Newton>,
    /// F_el of the last tick, N.
    load: Quantity<A, Newton>,
    /// Deflection of the bristle in the last tick, before it slipped, m.
    reached: Quantity<A, Metre>,
    /// Speed with which the surface yields, mm/s: grains crunch.
    pub(crate) crunch: Quantity<A, MillimetrePerSecond>,
}

/// Motion of the tip, as a law sees it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pressing<A: Magnitudes> {
    /// δ a tick ago, m.
    pub(crate) before: Quantity<A, Metre>,
    /// δ, m.
    pub(crate) depth: Quantity<A, Metre>,
    /// ḋ, away from the surface, m/s.
    pub(crate) outward: Quantity<A, MetrePerSecond>,
    /// Displacement since the last tick, m.
    pub(crate) motion: Vector<A, Metre>,
    /// n̂.
    pub(crate) normal: Vector<A, Fraction>,
    /// Along the surface, m/s.
    pub(crate) speed: Quantity<A, MetrePerSecond>,
    /// μ(v).
    pub(crate) mu: Quantity<A, FrictionCoefficient>,
    /// Periods since the last tick, 1 to 3.
    pub(crate) elapsed_ticks: u32,
}

/// The forces of a surface, N.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SurfaceForce<A: Arithmetic> {
    /// F_el, at least 0.
    pub(crate) load: Quantity<A, Newton>,
    /// Along the normal.
    pub(crate) total: Quantity<A, Newton>,
    /// What the bristle holds by: the load, and drag.
    pub(crate) grip: Quantity<A, Newton>,
    /// The limit of friction.
    pub(crate) limit: Quantity<A, Newton>,
}

impl<A: Arithmetic> SurfaceForce<A> {
    /// No contact.
    pub(crate) const NONE: Self = Self {
        load: Quantity::ZERO,
        total: Quantity::ZERO,
        grip: Quantity::ZERO,
        limit: Quantity::ZERO,
    };
}

impl<A: Arithmetic> ContactState<A> {
    /// An untouched surface.
    pub(crate) const UNTOUCHED: Self = Self {
        relaxing: Quantity::ZERO,
        imprint: Quantity::ZERO,
        pull: Quantity::ZERO,
        load: Quantity::ZERO,
        reached: Quantity::ZERO,
        crunch: Quantity::ZERO,
    };
}

impl<A: Arithmetic> ContactLaw<A> {
    /// A wall.
    pub(crate) const NONE: Self = Self {
        shape: SpringShape::NONE,
        damping: Quantity::ZERO,
        relaxing: Quantity::ZERO,
        relaxes: Quantity::ZERO,
        held: Quantity::ZERO,
        yields: Quantity::ZERO,
        share: Quantity::ZERO,
        heals: Quantity::ZERO,
        recovers: Quantity::ZERO,
        viscous: Quantity::ZERO,
        plough: Quantity::ZERO,
        pull: Quantity::ZERO,
        sticking: Quantity::ZERO,
    };

    /// Takes the law of an asset, in place.
    #[inline(never)]
    pub(crate) fn load(&mut self, law: Option<&formats::ContactLaw<'_>>, rate_hz: f32) {
        *self = Self::NONE;
        let Some(law) = law else {
            return;
        };
        self.shape.load(law.points());
        self.damping = Quantity::of(law.damping_s_m).settled();
        let relaxation = &law.relaxation;
        if relaxation.stiffness_n_m > 0.0 {
            let ticks = relaxation.time_s * rate_hz;
            let relaxes = decay(1.0 / ticks);
            self.relaxing = Quantity::of(relaxation.stiffness_n_m).settled();
            self.relaxes = Quantity::of(relaxes);
            self.held = Quantity::of(relaxes * ticks);
        }
        let imprint = &law.imprint;
        self.yields = Quantity::of(imprint.yield_m).settled();
        self.share = Quantity::of(imprint.share).settled();
        self.heals = Quantity::of(imprint.heal).settled();
        if imprint.recovery_s > 0.0 {
            self.recovers = Quantity::of(decay(1.0 / (imprint.recovery_s * rate_hz)));
        }
        self.viscous = Quantity::of(law.drag.viscous_n_s_m2).settled();
        self.plough = Quantity::of(law.drag.plough_n_m).settled();
        self.pull = Quantity::of(law.adhesion.pull_n).settled();
        self.sticking = Quantity::of(law.adhesion.stiffness_n_m).settled();
    }

    /// The law that a device renders on a wall that it bears.
    #[inline]
    pub(crate) fn lowered(&self, passivity: &Passivity<A>, wall: Wall<A>) -> Lowered<A> {
        passivity.lower(Lowered {
            wall,
            relaxing: self.relaxing,
            sticking: self.sticking,
            damping: self.damping,
        })
    }

    /// Returns true if slip heals an imprint.
    #[inline(always)]
    pub(crate) fn heals(&self) -> bool {
        self.heals > Quantity::ZERO
    }

    /// The imprint heals with the last slip along the surface, which friction paid for. `lengths` are
    /// the deflection that was left of what the last tick reached, and the one that this tick reaches;
    /// `force` gives the friction of a deflection.
    #[inline]
    pub(crate) fn heal(
        &self,
        state: &mut ContactState<A>,
        [left, reaches]: [Quantity<A, Metre>; 2],
        force: impl FnOnce(Quantity<A, Metre>) -> Quantity<A, Newton>,
    ) {
        let slip = (state.reached - left).max(Quantity::ZERO);
        let (load, friction) = (state.load, force(left));
        state.reached = reaches;
        let paid = if load > Quantity::ZERO {
            let ratio = friction.to::<FineNewton>().over(load.to::<FineNewton>());
            ratio.min(self.heals)
        } else {
            self.heals
        };
        state.imprint = (state.imprint - paid * slip).max(Quantity::ZERO);
    }
}

impl<A: Pushing + Magnitudes> ContactLaw<A> {
    /// Advances by a tick of a `period`, s, with what the device bears of the law.
    #[inline(always)]
    pub(crate) fn step(
        &self,
        lowered: &Lowered<A>,
        period: Quantity<A, Second>,
        state: &mut ContactState<A>,
        tip: &Pressing<A>,
    ) -> SurfaceForce<A> {
        let zero = Quantity::ZERO;

        // What yields; then how far the elastic depth has changed. A surface that changed in contact
        // has yielded before.
        let mut imprint = zero;
        if self.share > Quantity::ZERO {
            imprint = state.imprint.max(self.share * (tip.before - self.yields));
            self.give(state, tip);
        }
        let before = (tip.before - imprint).max(zero);
        let elastic = (tip.depth - state.imprint).max(zero);
        let deeper = elastic - before;

        if self.relaxing > Quantity::ZERO {
            if tip.elapsed_ticks > 1 {
                self.relax_late(state, lowered.relaxing, deeper, tip.elapsed_ticks);
            } else {
                self.relax(state, lowered.relaxing, deeper);
            }
        }
        if tip.depth <= zero {
            return self.recover(period, state, tip);
        }

        // Load, damping, pull and drag.
        let spring = lowered.wall.stiffness * self.shape.at(elastic);
        let load = (spring + state.relaxing.to::<Newton>()).max(Quantity::ZERO);
        let load = if elastic > zero { load } else { Quantity::ZERO };
        let damping: Quantity<A, NewtonSecondPerMetre> =
            lowered.wall.damping + lowered.damping * load;
        let total = Quantity(A::left_of(load.0, (damping * tip.outward).0));
        if self.pull > Quantity::ZERO {
            let most = (lowered.sticking * elastic).min(self.pull);
            state.pull = (state.pull - lowered.sticking * deeper).clamp_from_zero(most);
        }
        let drag = (self.viscous * tip.speed + self.plough) * tip.depth;
        state.load = load;
        SurfaceForce {
            load,
            total: total - state.pull,
            grip: load + drag,
            limit: tip.mu * load + drag,
        }
    }

    /// The surface yields to the tip, and crunches as fast.
    #[inline(always)]
    fn give(&self, state: &mut ContactState<A>, tip: &Pressing<A>) {
        let yielded = self.share * (tip.depth - self.yields);
        if yielded > state.imprint {
            let inward = -tip.outward.min(Quantity::ZERO);
            state.imprint = yielded;
            state.crunch = inward * Quantity::<A, MillimetrePerMetre>::whole(1000);
        } else {
            let left = Quantity::<A, Fraction>::of(CRUNCH) * state.crunch;
            state.crunch = left.above(Quantity::of(SLOWEST_MM_S));
        }
    }

    /// [`relax`](Self::relax) over two or three periods of a steady motion.
    #[cold]
    #[inline(never)]
    fn relax_late(
        &self,
        state: &mut ContactState<A>,
        stiffness: Quantity<A, NewtonPerMetre>,
        deeper: Quantity<A, Metre>,
        elapsed_ticks: u32,
    ) {
        let (part, ticks) = if elapsed_ticks == 2 {
            (0.5, 2)
        } else {
            (1.0 / 3.0, 3)
        };
        let deeper = Quantity::<A, Fraction>::of(part) * deeper;
        for _ in 0..ticks {
            self.relax(state, stiffness, deeper);
        }
    }

    /// The Maxwell branch follows the elastic depth for a period.
    #[inline(always)]
    fn relax(
        &self,
        state: &mut ContactState<A>,
        stiffness: Quantity<A, NewtonPerMetre>,
        deeper: Quantity<A, Metre>,
    ) {
        let taken = Quantity::<A, RelaxingNewton>::sum_of_products(
            [(stiffness, self.held * deeper)],
            Cut::At(STRONGEST_N),
        );
        let strongest = Quantity::of(STRONGEST_N);
        let relaxed = state.relaxing - (self.relaxes * state.relaxing).settled() + taken;
        state.relaxing = relaxed.min(strongest).max(-strongest).settled();
    }

    /// Nothing presses: every number goes to zero.
    fn recover(
        &self,
        period: Quantity<A, Second>,
        state: &mut ContactState<A>,
        tip: &Pressing<A>,
    ) -> SurfaceForce<A> {
        let weakest = Quantity::<A, RelaxingNewton>::of(WEAKEST_N);
        if state.relaxing.max(-state.relaxing) < weakest {
            state.relaxing = Quantity::ZERO;
        }
        let travel = tip.speed * period;
        for _ in 0..tip.elapsed_ticks.clamp(1, 3) {
            let gone = self.recovers * state.imprint + Quantity::<A, Fraction>::of(FRESH) * travel;
            state.imprint = (state.imprint - gone).above(Quantity::of(SHALLOWEST_M));
        }
        state.pull = Quantity::ZERO;
        state.load = Quantity::ZERO;
        state.reached = Quantity::ZERO;
        SurfaceForce::NONE
    }
}

/// 1 − exp(−x) for x > 0, also where x is small; not for the tick.
fn decay(x: f32) -> f32 {
    if x > 0.5 {
        return 1.0 - exp(-min(x, 80.0));
    }
    let mut sum = 1.0;
    for n in (2..=8_u8).rev() {
        sum = 1.0 - x / f32::from(n) * sum;
    }
    x * sum
}

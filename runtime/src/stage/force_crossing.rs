//! The way from one surface to another, where either gives way: the difference of their forces fades.

use super::contact_law::SurfaceForce;
use crate::{
    arithmetic::Arithmetic,
    quantity::{
        Quantity,
        unit::{Fraction, Newton},
    },
};

/// A remainder of another surface's force below this, N, is none.
const SMALLEST_REMAINDER_N: f32 = 1.0e-4;

/// Forces on the way from one surface to another, where either gives way: the difference of both
/// fades.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ForceCrossing<A: Arithmetic> {
    last: SurfaceForce<A>,
    remains: SurfaceForce<A>,
    /// True if the surface has changed since the last tick.
    begun: bool,
    /// True if the last force was that of a law, or on the way from one.
    lawful: bool,
}

impl<A: Arithmetic> ForceCrossing<A> {
    /// Nothing was touched yet.
    pub(crate) const START: Self = Self {
        last: SurfaceForce::NONE,
        remains: SurfaceForce::NONE,
        begun: false,
        lawful: false,
    };

    /// Another surface is touched from here on.
    pub(crate) const fn begin(&mut self) {
        self.begun = true;
    }

    /// Returns true if the last force was that of a law, or on the way from one.
    #[inline(always)]
    pub(crate) const fn is_lawful(&self) -> bool {
        self.lawful
    }

    /// The force to render instead of the one of the new surface; a tick goes a `fraction` of the way
    /// to it.
    #[inline(always)]
    pub(crate) fn step(
        &mut self,
        force: SurfaceForce<A>,
        law: bool,
        fraction: Quantity<A, Fraction>,
    ) -> SurfaceForce<A> {
        if law | self.lawful {
            self.lawful = law;
            return self.fade(force, fraction);
        }
        self.begun = false;
        self.last = force;
        force
    }

    #[cold]
    #[inline(never)]
    fn fade(&mut self, force: SurfaceForce<A>, fraction: Quantity<A, Fraction>) -> SurfaceForce<A> {
        let zero = Quantity::ZERO;
        if self.begun {
            self.begun = false;
            self.remains = SurfaceForce {
                load: self.last.load - force.load,
                total: self.last.total - force.total,
                grip: self.last.grip - force.grip,
                limit: self.last.limit - force.limit,
            };
        }
        let left = Quantity::whole(1) - fraction;
        let least = Quantity::of(SMALLEST_REMAINDER_N);
        // In the open, and where little is left, nothing remains.
        let mut some = false;
        let mut fade = |remains: Quantity<A, Newton>| {
            let remains = left * remains;
            let heard = (remains.max(-remains) > least) & (force.load > zero);
            some |= heard;
            if heard { remains } else { zero }
        };
        self.remains = SurfaceForce {
            load: fade(self.remains.load),
            total: fade(self.remains.total),
            grip: fade(self.remains.grip),
            limit: fade(self.remains.limit),
        };
        self.lawful |= some;
        self.last = SurfaceForce {
            load: (force.load + self.remains.load).max(zero),
            total: force.total + self.remains.total,
            grip: (force.grip + self.remains.grip).max(zero),
            limit: (force.limit + self.remains.limit).max(zero),
        };
        self.last
    }
}

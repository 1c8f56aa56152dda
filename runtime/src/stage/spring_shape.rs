//! The shape s(e) of a spring: lines from the origin, one behind the other, the last without end.
//!
//! It is evaluated as `s(e) = m₁e + Σ (mᵢ₊₁ − mᵢ)·max(e − eᵢ, 0)`, with the slopes mᵢ of its lines
//! and the depths eᵢ at which they end. The work is the same for every shape and every depth: five
//! bends take fewer instructions than a search among six lines.

use crate::{
    arithmetic::{Arithmetic, Cut},
    quantity::{
        Quantity,
        unit::{Fraction, Metre},
    },
};
use asperity_formats::{SpringPoint, limits::MAX_SPRING_POINTS};

/// Bends between as many lines as an asset has points.
const BENDS: usize = MAX_SPRING_POINTS - 1;

/// A shape whose slopes are 0 to 1. It takes 44 bytes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SpringShape<A: Arithmetic> {
    /// m₁.
    slope: Quantity<A, Fraction>,
    /// eᵢ.
    depths: [Quantity<A, Metre>; BENDS],
    /// mᵢ₊₁ − mᵢ; 0 for no bend.
    changes: [Quantity<A, Fraction>; BENDS],
}

impl<A: Arithmetic> SpringShape<A> {
    /// s(e) = 0.
    pub(crate) const NONE: Self = Self {
        slope: Quantity::ZERO,
        depths: [Quantity::ZERO; BENDS],
        changes: [Quantity::ZERO; BENDS],
    };

    /// Takes the points at which the lines end, in place; s(e) = e without any.
    pub(crate) fn load(&mut self, points: impl Iterator<Item = SpringPoint>) {
        *self = Self::NONE;
        self.slope = Quantity::whole(1);
        let (mut from, mut before) = (SpringPoint::default(), 0.0);
        for (line, to) in points.enumerate() {
            // Codes ascend and are whole numbers, so that their differences are exact.
            let depth = f32::from(to.depth_code.saturating_sub(from.depth_code));
            let slope = f32::from(to.shape_code.saturating_sub(from.shape_code)) / depth;
            match line.checked_sub(1) {
                None => self.slope = Quantity::of(slope),
                Some(bend) if bend < BENDS => {
                    self.depths[bend] = Quantity::of(f32::from(from.depth_code) * 1.0e-6);
                    self.changes[bend] = Quantity::of(slope - before);
                }
                Some(_) => {}
            }
            (from, before) = (to, slope);
        }
    }

    /// s(e) at an elastic depth e ≥ 0, m.
    #[inline(always)]
    pub(crate) fn at(&self, elastic: Quantity<A, Metre>) -> Quantity<A, Metre> {
        let mut terms = [(self.slope, elastic); BENDS + 1];
        let bends = self.changes.iter().zip(&self.depths);
        for (term, (&change, &depth)) in terms.iter_mut().skip(1).zip(bends) {
            *term = (change, (elastic - depth).max(Quantity::ZERO));
        }
        Quantity::sum_of_products(terms, Cut::Never)
    }
}

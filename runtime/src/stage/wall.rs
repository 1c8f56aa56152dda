//! The virtual wall: `F = k·δ − b·ḋ`, and never less than zero.
//!
//! A wall pushes and never pulls. The spring k·δ alone looks up the grid, and friction is
//! proportional to it.

use crate::{
    arithmetic::{Arithmetic, Fixed, Float},
    math::max,
    quantity::{
        Quantity, Raw,
        unit::{Metre, MetrePerSecond, Newton, NewtonPerMetre, NewtonSecondPerMetre},
    },
};

/// The difference of a spring's force and a damper's.
pub trait Pushing: Arithmetic {
    /// a − b, but never below zero, and zero where a is zero.
    fn left_of(a: Raw<Self, Newton>, b: Raw<Self, Newton>) -> Raw<Self, Newton>;
}

impl Pushing for Float {
    #[inline(always)]
    fn left_of(a: f32, b: f32) -> f32 {
        if a > 0.0 { max(a - b, 0.0) } else { 0.0 }
    }
}

impl Pushing for Fixed {
    #[inline(always)]
    fn left_of(a: Raw<Self, Newton>, b: Raw<Self, Newton>) -> Raw<Self, Newton> {
        // Products cost much here. So b is computed in any case, and a tick always costs the same.
        let zero = Raw::<Self, Newton>::ZERO;
        let left = (a - b).max(zero);
        if a > zero { left } else { zero }
    }
}

/// Stiffness and damping of a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall<A: Arithmetic = Float> {
    /// Stiffness k, N/m.
    pub stiffness: Quantity<A, NewtonPerMetre>,
    /// Rendered damping b, N·s/m.
    pub damping: Quantity<A, NewtonSecondPerMetre>,
}

/// The forces of a wall along the normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalForce<A: Arithmetic = Float> {
    /// k·δ, N: the paper's F_n.
    pub spring: Quantity<A, Newton>,
    /// k·δ − b·ḋ, N, at least 0, and 0 out of contact.
    pub total: Quantity<A, Newton>,
}

impl<A: Arithmetic> Wall<A> {
    /// No wall.
    pub const NONE: Self = Self {
        stiffness: Quantity::ZERO,
        damping: Quantity::ZERO,
    };

    /// A wall of stiffness k, N/m, and damping b, N·s/m.
    #[must_use]
    pub fn of(stiffness_n_m: f32, damping_n_s_m: f32) -> Self {
        Self {
            stiffness: Quantity::of(stiffness_n_m),
            damping: Quantity::of(damping_n_s_m),
        }
    }
}

impl<A: Pushing> Wall<A> {
    /// The forces at a depth δ ≥ 0, m, and a velocity outwards ḋ, m/s.
    #[inline(always)]
    #[must_use]
    pub fn step(
        &self,
        depth: Quantity<A, Metre>,
        outward: Quantity<A, MetrePerSecond>,
    ) -> NormalForce<A> {
        let spring = self.stiffness * depth;
        let damped = self.damping * outward;
        let total = Quantity(A::left_of(spring.0, damped.0));
        NormalForce { spring, total }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_never_pulls() {
        let wall = Wall::<Float>::of(500.0, 1.0);
        let total = |depth_m, outward_m_s| {
            let forces = wall.step(Quantity::of(depth_m), Quantity::of(outward_m_s));
            forces.total.value()
        };
        assert_eq!(total(2e-4, 5.0), 0.0);
        assert_eq!(total(0.0, -5.0), 0.0);
        assert_eq!(total(2e-4, -0.5), 0.6);
    }
}

//! The virtual wall: `F = k·δ − b·ḋ`, and never less than zero.
//!
//! A wall pushes and never pulls. The spring k·δ alone looks up the grid, and friction is
//! proportional to it.

use crate::{
    arithmetic::{Arithmetic, Float},
    quantity::{
        Quantity,
        unit::{Metre, MetrePerSecond, Newton, NewtonPerMetre, NewtonSecondPerMetre},
    },
};

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

    /// The forces at a depth δ ≥ 0, m, and a velocity outwards ḋ, m/s.
    #[inline(always)]
    #[must_use]
    pub fn step(
        &self,
        depth: Quantity<A, Metre>,
        outward: Quantity<A, MetrePerSecond>,
    ) -> NormalForce<A> {
        let spring = self.stiffness * depth;
        let pushing = (spring - self.damping * outward).max(Quantity::ZERO);
        let total = if spring > Quantity::ZERO {
            pushing
        } else {
            Quantity::ZERO
        };
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

//! Wall, gains and friction of a texture, as a tick computes with them.

use crate::{
    arithmetic::Arithmetic,
    quantity::{
        Quantity,
        unit::{Fraction, FrictionCoefficient, Kilogram, Newton, SecondSquaredPerMetre, Unit},
    },
    stage::wall::Wall,
};
use asperity_formats as formats;

/// The [`Coupling`](formats::Coupling) and the friction of an asset, in an arithmetic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Coupling<A: Arithmetic> {
    /// The wall that the asset asks for.
    pub(crate) wall: Wall<A>,
    vib: Quantity<A, SecondSquaredPerMetre>,
    /// m_eff of a tap, kg.
    pub(crate) effective_mass: Quantity<A, Kilogram>,
    f_max: Quantity<A, Newton>,
    /// g_vib·F_max of the vibration, kg.
    pub(crate) vib_mass: Quantity<A, Kilogram>,
    /// Coefficient of kinetic friction μ, before its law.
    pub(crate) mu: Quantity<A, FrictionCoefficient>,
}

impl<A: Arithmetic> Coupling<A> {
    /// No wall, no friction, silence.
    pub(crate) const NONE: Self = Self {
        wall: Wall::NONE,
        vib: Quantity::ZERO,
        effective_mass: Quantity::ZERO,
        f_max: Quantity::ZERO,
        vib_mass: Quantity::ZERO,
        mu: Quantity::ZERO,
    };

    /// Converts the coupling and μ of an asset.
    pub(crate) fn new(coupling: &formats::Coupling, mu: f32) -> Self {
        let (vib, f_max) = (
            Quantity::of(coupling.vib_s2_m).settled(),
            Quantity::of(coupling.f_max_n).settled(),
        );
        Self {
            wall: Wall {
                stiffness: Quantity::of(coupling.stiffness_n_m).settled(),
                damping: Quantity::of(coupling.damping_n_s_m).settled(),
            },
            vib,
            effective_mass: Quantity::of(coupling.effective_mass_kg).settled(),
            f_max,
            vib_mass: vib * f_max,
            mu: Quantity::of(mu).settled(),
        }
    }

    /// Goes a `fraction` of the way to another coupling; with 1 it arrives exactly. What is left of the
    /// way is rounded to the grid, so that it never becomes a denormal.
    #[inline]
    pub(crate) fn follow(&mut self, to: &Self, fraction: Quantity<A, Fraction>) {
        let left = Quantity::whole(1) - fraction;
        self.wall.stiffness = follow(self.wall.stiffness, to.wall.stiffness, left);
        self.wall.damping = follow(self.wall.damping, to.wall.damping, left);
        self.effective_mass = follow(self.effective_mass, to.effective_mass, left);
        self.vib = follow(self.vib, to.vib, left);
        self.f_max = follow(self.f_max, to.f_max, left);
        self.vib_mass = self.vib * self.f_max;
        self.mu = follow(self.mu, to.mu, left);
    }

    /// The coupling as an asset states it.
    pub(crate) fn values(&self) -> formats::Coupling {
        formats::Coupling {
            stiffness_n_m: self.wall.stiffness.value(),
            damping_n_s_m: self.wall.damping.value(),
            vib_s2_m: self.vib.value(),
            effective_mass_kg: self.effective_mass.value(),
            f_max_n: self.f_max.value(),
        }
    }
}

/// Leaves the share `left` of the way from one value to another.
#[inline(always)]
fn follow<A: Arithmetic, U: Unit>(
    from: Quantity<A, U>,
    to: Quantity<A, U>,
    left: Quantity<A, Fraction>,
) -> Quantity<A, U> {
    to - left * (to - from).settled()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Float, lanes::GRID};

    /// The border between a surface and one that has nothing of it, for as long as anybody stays.
    #[test]
    fn what_goes_to_zero_is_never_a_denormal() {
        let stated = formats::Coupling {
            stiffness_n_m: 500.0,
            damping_n_s_m: 0.5,
            vib_s2_m: 0.05,
            effective_mass_kg: 0.08,
            f_max_n: 3.3,
        };
        for fraction in [0.02, 0.05, 0.3, 1.0] {
            let mut coupling = Coupling::<Float>::new(&stated, 0.6);
            // A decay without the grid reaches denormals after 90 time constants.
            for tick in 0..6000 {
                coupling.follow(&Coupling::NONE, Quantity::of(fraction));
                let values = coupling.values();
                for value in [
                    values.stiffness_n_m,
                    values.damping_n_s_m,
                    values.vib_s2_m,
                    values.effective_mass_kg,
                    values.f_max_n,
                    coupling.vib_mass.value(),
                    coupling.mu.value(),
                ] {
                    assert!(!value.is_subnormal(), "{fraction} after {tick}: {value:e}");
                }
            }
            // It stays where a step is below half of the grid.
            let left = coupling.values().stiffness_n_m;
            assert!(left <= GRID / fraction, "{fraction}: {left:e}");
        }
    }

    const STATED: [formats::Coupling; 2] = [
        formats::Coupling {
            stiffness_n_m: 500.0,
            damping_n_s_m: 0.5,
            vib_s2_m: 0.05,
            effective_mass_kg: 0.08,
            f_max_n: 3.3,
        },
        formats::Coupling {
            stiffness_n_m: 200.0,
            damping_n_s_m: 1.25,
            vib_s2_m: 0.2,
            effective_mass_kg: 0.01,
            f_max_n: 8.0,
        },
    ];

    /// All values, vib_mass and μ included.
    fn all<A: Arithmetic>(coupling: &Coupling<A>) -> [f64; 7] {
        let stated = coupling.values();
        [
            stated.stiffness_n_m,
            stated.damping_n_s_m,
            stated.vib_s2_m,
            stated.effective_mass_kg,
            stated.f_max_n,
            coupling.mu.value(),
            coupling.vib_mass.value(),
        ]
        .map(f64::from)
    }

    #[test]
    fn every_value_goes_its_fraction_of_the_way_and_arrives_exactly() {
        fn check<A: Arithmetic>(within: f64) {
            let [from, to] = STATED;
            let (from, to) = (Coupling::<A>::new(&from, 0.3), Coupling::<A>::new(&to, 0.9));
            let (before, after) = (all(&from), all(&to));
            for fraction in [0.0, 0.25, 0.5, 0.75] {
                let mut found = from;
                found.follow(&to, Quantity::of(fraction));
                let found = all(&found);
                let part = |k: usize| before[k] + f64::from(fraction) * (after[k] - before[k]);
                for (k, value) in found.into_iter().enumerate().take(6) {
                    let near = (value - part(k)).abs() < within * (before[k] + after[k]);
                    assert!(near, "{k} at {fraction}: {value} {}", part(k));
                }
                let product = part(2) * part(4);
                assert!((found[6] - product).abs() < within * 4.0, "{found:?}");
            }
            let mut found = from;
            found.follow(&to, Quantity::whole(1));
            assert_eq!(found, to);
            found.follow(&from, Quantity::whole(1));
            assert_eq!(found, from);
        }
        check::<Float>(1e-6);
        check::<crate::Fixed>(1e-4);
    }

    #[test]
    fn a_coupling_holds_what_the_asset_says() {
        for stated in STATED {
            let coupling = Coupling::<Float>::new(&stated, 0.5);
            assert_eq!(coupling.values(), stated);
            assert_eq!(coupling.mu.value(), 0.5);
            assert_eq!(coupling.vib_mass.value(), stated.vib_s2_m * stated.f_max_n);
        }
    }
}

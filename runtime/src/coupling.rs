//! Wall, gains and friction of a texture, as a tick computes with them.

use crate::{
    arithmetic::Arithmetic,
    quantity::{
        Quantity,
        unit::{Fraction, FrictionCoefficient, Kilogram, Newton, SecondSquaredPerMetre},
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

    /// Goes a `fraction` of the way to another coupling; with 1 it arrives exactly.
    #[inline]
    pub(crate) fn follow(&mut self, to: &Self, fraction: Quantity<A, Fraction>) {
        let left = Quantity::whole(1) - fraction;
        self.wall.stiffness = to.wall.stiffness - left * (to.wall.stiffness - self.wall.stiffness);
        self.wall.damping = to.wall.damping - left * (to.wall.damping - self.wall.damping);
        self.effective_mass = to.effective_mass - left * (to.effective_mass - self.effective_mass);
        self.vib = to.vib - left * (to.vib - self.vib);
        self.f_max = to.f_max - left * (to.f_max - self.f_max);
        self.vib_mass = self.vib * self.f_max;
        // The size of friction, which is an output, is a multiple of it.
        self.mu = to.mu - left * (to.mu - self.mu).settled();
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

//! Wall, gains and friction of a texture.

use crate::sized::sized;
use asperity_formats::Coupling;

/// Coupling of a texture to the hand. Set `struct_size`, or begin with `ASPERITY_COUPLING_INIT`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AsperityCoupling {
    /// `sizeof(AsperityCoupling)`, from the caller.
    pub struct_size: u32,
    /// Stiffness of the wall, N/m, before the renderer lowers it to what the device can bear.
    pub stiffness_n_m: f32,
    /// Damping of the wall, N·s/m.
    pub damping_n_s_m: f32,
    /// Gain of the vibration, s²/m.
    pub vib_s2_m: f32,
    /// Effective mass of a tap, kg.
    pub effective_mass_kg: f32,
    /// Force that the gain of the vibration refers to, N.
    pub f_max_n: f32,
    /// Coefficient of kinetic friction.
    pub mu: f32,
}

impl AsperityCoupling {
    pub(crate) const fn new(coupling: &Coupling, mu: f32) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            stiffness_n_m: coupling.stiffness_n_m,
            damping_n_s_m: coupling.damping_n_s_m,
            vib_s2_m: coupling.vib_s2_m,
            effective_mass_kg: coupling.effective_mass_kg,
            f_max_n: coupling.f_max_n,
            mu,
        }
    }
}

sized!(AsperityCoupling, first version ends with mu, lacking fields are AsperityCoupling {
    struct_size: size_of::<AsperityCoupling>() as u32,
    stiffness_n_m: 0.0,
    damping_n_s_m: 0.0,
    vib_s2_m: 0.0,
    effective_mass_kg: 0.0,
    f_max_n: 0.0,
    mu: 0.0,
});

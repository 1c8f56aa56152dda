//! Values for what no source states. Nobody has confirmed them on a device, and a source may set
//! others.
//!
//! ```
//! use asperity_texture::model::defaults;
//!
//! let gains = defaults::gains();
//! assert!((gains.vib_s2_m * gains.f_max_n - defaults::VIBRATING_MASS_KG).abs() < 1e-12);
//! ```

use crate::model::{Gains, Wall};

/// Stiffness of the wall, N/m: the driver of the 3D Systems Touch reports 0.5 N/mm.
pub const STIFFNESS_N_M: f64 = 500.0;
/// Rendered damping, N·s/m. It is small, because rendered damping raises the damping that the
/// device must have for a stable wall.
pub const DAMPING_N_S_M: f64 = 0.1;
/// Peak force of the 3D Systems Touch, N.
pub const F_MAX_N: f64 = 3.3;
/// Mass that the reference renderer of HaTT multiplies accelerations with, kg.
pub const VIBRATING_MASS_KG: f64 = 0.05;
/// Mass that a tap's acceleration is multiplied with, kg.
pub const EFFECTIVE_MASS_KG: f64 = 0.05;

/// The default wall.
#[must_use]
pub fn wall() -> Wall {
    Wall {
        stiffness_n_m: STIFFNESS_N_M,
        damping_n_s_m: DAMPING_N_S_M,
    }
}

/// The default gains: `g_vib·F_max` is [`VIBRATING_MASS_KG`].
#[must_use]
pub fn gains() -> Gains {
    Gains {
        vib_s2_m: VIBRATING_MASS_KG / F_MAX_N,
        effective_mass_kg: EFFECTIVE_MASS_KG,
        f_max_n: F_MAX_N,
    }
}

//! The generator: it makes a texture from six physical parameters.
//!
//! 1. [`surface`]: the spectrum of heights along the stroke, filtered by the stylus tip, which
//!    cannot follow relief that is finer than its contact.
//! 2. [`transfer`]: heights at speed v become frequencies v·k; two derivatives make
//!    them accelerations; the stylus on its contact is a damped resonator.
//! 3. [`level`]: RMS acceleration at 100 mm/s and 1 N from height, wavelength and
//!    stiffness, growing with speed and force by stated exponents.
//! 4. [`ar`]: autocorrelation and Levinson's recursion to AR(21) under 1 + z⁻¹.
//! 5. [`tap`]: the transients of impacts, by Hertz's contact and the modes of the surface.
//!
//! Everything it makes is synthetic. Constants marked *calibrated* were set so that
//! percentiles over all materials resemble those of HaTT (aggregates only; see
//! `docs/corpus.md`).

pub mod ar;
pub mod level;
pub mod surface;
pub mod tap;
pub mod transfer;

use crate::{BINS, Instance, ORDER, TAPS, UnifiedGrid};

/// Physical parameters of a surface under a stylus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Physical {
    /// Dominant distance between asperities, mm.
    pub wavelength_mm: f64,
    /// Width of the height spectrum around it, octaves.
    pub spread_octaves: f64,
    /// RMS height of the asperities as the stylus meets them, µm.
    pub height_um: f64,
    /// Effective indentation modulus under a 3 mm tip, MPa.
    pub modulus_mpa: f64,
    /// Loss factor of the material.
    pub loss_factor: f64,
    /// Coefficient of kinetic friction of a steel tip.
    pub mu: f64,
}

/// Impact speeds of the bank, m/s: 0.025 to 0.325, as for imported textures.
#[must_use]
pub fn tap_speeds_m_s() -> [f64; TAPS] {
    asperity::impact::speeds_m_s()
}

/// The texture of a surface on a grid.
#[must_use]
pub fn instance(physical: &Physical, grid: &UnifiedGrid) -> Instance {
    let mut lsf_rad = [[0.0; ORDER]; BINS];
    let mut level_db = [0.0; BINS];
    for (index, bin) in grid.bins.iter().enumerate() {
        let shape = transfer::spectrum(physical, bin.speed_mm_s, bin.force_n);
        lsf_rad[index] = ar::lsf(&shape);
        level_db[index] = level::rms_db(physical, bin.speed_mm_s, bin.force_n) as f32;
    }
    Instance {
        lsf_rad,
        level_db,
        taps_m_s2: tap::bank(physical),
    }
}

/// Stiffness of the virtual wall, N/m.
///
/// It grows with the modulus, from 200 N/m to the 500 N/m that the driver of the 3D Systems Touch
/// reports. Nobody has confirmed it on a device.
#[must_use]
pub fn wall_stiffness_n_m(physical: &Physical) -> f64 {
    // From 0.03 MPa, a sponge, to 100 MPa, which feels hard to a hand.
    let share =
        (libm::log10(physical.modulus_mpa / 0.03) / libm::log10(100.0 / 0.03)).clamp(0.0, 1.0);
    200.0 + share * (asperity::defaults::STIFFNESS_N_M - 200.0)
}

//! The generator: it makes a texture from six physical parameters.
//!
//! 1. [`surface`]: the spectrum of heights along the stroke, a line and a broad relief.
//! 2. [`transfer`]: the contact averages heights, which at speed v become frequencies v·k; two derivatives make
//!    them accelerations; the stylus on its contact is a damped resonator; a floor is below. Contact and stylus are
//!    those of [`asperity_surface`].
//! 3. [`level`]: RMS acceleration from height and modulus, growing with speed and force.
//! 4. [`vibration`]: autocorrelation and Levinson's recursion to AR(21) under 1 + z⁻¹.
//! 5. [`tap`]: the transients of impacts, by Hertz's contact and the modes of the surface.
//! 6. [`friction`]: the coefficient of friction.
//!
//! Everything it makes is synthetic. Its global constants are in [`constants`]; `docs/corpus.md`
//! says what they were calibrated on.

pub mod constants;
pub mod friction;
pub mod level;
pub mod surface;
pub mod tap;
pub mod transfer;

use crate::{BINS, Instance, ORDER, TAPS, UnifiedGrid};
use asperity_surface::vibration;
use constants::Constants;

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
    /// Coefficient of kinetic friction of a steel tip, as the corpus states it.
    pub mu: f64,
}

impl Physical {
    /// Decades of modulus above 10 MPa.
    fn hardness_decades(&self) -> f64 {
        libm::log10(self.modulus_mpa / 10.0)
    }

    /// Decades of height above 5 µm.
    fn height_decades(&self) -> f64 {
        libm::log10(self.height_um / 5.0)
    }
}

/// Impact speeds of the bank, m/s: 0.025 to 0.325, as for imported textures.
#[must_use]
pub fn tap_speeds_m_s() -> [f64; TAPS] {
    asperity::signal::impact::speeds_m_s()
}

/// The texture of a surface on a grid.
#[must_use]
pub fn instance(constants: &Constants, physical: &Physical, grid: &UnifiedGrid) -> Instance {
    let mut lsf_rad = [[0.0; ORDER]; BINS];
    let mut level_db = [0.0; BINS];
    for (index, bin) in grid.bins.iter().enumerate() {
        let shape = transfer::spectrum(constants, physical, *bin);
        lsf_rad[index] = vibration::lsf(&shape);
        level_db[index] = level::rms_db(constants, physical, *bin) as f32;
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
    200.0 + share * (asperity::model::defaults::STIFFNESS_N_M - 200.0)
}

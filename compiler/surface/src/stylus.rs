//! A stylus in a hand: a mass on a damped spring, its contact, that the surface moves.

/// Half the loss factor is a damping ratio.
const MATERIAL_DAMPING: f64 = 0.5;

/// Tool and hand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stylus {
    /// Resonance on a contact of 10 MPa at 1 N, Hz.
    pub resonance_hz: f64,
    /// Its exponent in the modulus.
    pub modulus_exponent: f64,
    /// Its exponent in the force.
    pub force_exponent: f64,
    /// Damping ratio of the hand.
    pub hand_damping: f64,
}

/// A surface as it carries the stylus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// Effective indentation modulus, MPa.
    pub modulus_mpa: f64,
    /// Loss factor of the material.
    pub loss_factor: f64,
    /// Normal force, N.
    pub force_n: f64,
}

impl Stylus {
    /// As `training/corpora/generator.toml` calibrates it against measured materials; a test of the corpus compares both.
    pub const CALIBRATED: Self = Self {
        resonance_hz: 222.8,
        modulus_exponent: 0.1358,
        force_exponent: 0.07814,
        hand_damping: 0.762,
    };

    /// Resonance of the stylus on its contact, Hz.
    #[must_use]
    pub fn resonance_hz(&self, support: &Support) -> f64 {
        let modulus = self.modulus_exponent * libm::log10(support.modulus_mpa / 10.0);
        let force = self.force_exponent * libm::log10(support.force_n);
        self.resonance_hz * libm::exp10(modulus + force)
    }

    /// Power of the stylus's motion over that of the heights that move it.
    #[must_use]
    pub fn transmission(&self, support: &Support, freq_hz: f64) -> f64 {
        // The hand's damping acts against the hand, the material's against the surface.
        let material = MATERIAL_DAMPING * support.loss_factor;
        let damping = self.hand_damping + material;
        let ratio = freq_hz / self.resonance_hz(support);
        let detuning = 1.0 - ratio * ratio;
        let drag = 2.0 * damping * ratio;
        let through = 2.0 * material * ratio;
        (1.0 + through * through) / (detuning * detuning + drag * drag)
    }
}

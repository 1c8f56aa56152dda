//! Input of a picture: words, neighbours, feel.

/// A texture as a picture needs it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Description<'a> {
    /// The prompt, or the name of a texture without one.
    pub words: &'a str,
    /// The nearest materials by name, with their shares, 0..=1.
    pub nearest: &'a [(&'a str, f64)],
    /// Ratio of its relief to that of the thing in general, from a number among the words.
    pub coarser: f64,
    /// Feel of the texture; `None` for the material as the table has it.
    pub feel: Option<Feel>,
    /// Seed of the arrangement.
    pub seed: u64,
}

/// Tactile attributes that affect the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Feel {
    /// Wavelength at the centroid of the vibration's spectrum, mm: speed over frequency.
    pub wavelength_mm: f64,
    /// Level of the vibration, dB re 1 (m/s²)².
    pub level_db: f64,
    /// Coefficient of friction.
    pub mu: f64,
    /// Centroid of the spectrum of a tap, Hz.
    pub hard_hz: f64,
}

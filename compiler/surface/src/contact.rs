//! The contact of a tip with a surface, which averages heights.

/// Returns the power transmission of an average over the contact, on heights: `(1 + (2πkw)²)^(−3/2)` with the contact's
/// length w, mm, at a spatial frequency k, 1/mm. The transform of Hertz's pressure, √(1 − x²), falls as k^(−3/2).
#[must_use]
pub fn average_power(k_per_mm: f64, contact_mm: f64) -> f64 {
    let x = std::f64::consts::TAU * k_per_mm * contact_mm;
    let squared = 1.0 + x * x;
    1.0 / (squared * squared.sqrt())
}

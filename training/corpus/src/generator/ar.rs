//! From a sampled power spectrum to the LSFs of its AR(21) model.

use super::transfer::POINTS;
use crate::ORDER;
use asperity::signal::{levinson, lsf};
use std::{f64::consts::PI, sync::LazyLock};

/// cos(lag·ω) at the midpoints, one row for each lag.
static COSINES: LazyLock<Vec<[f64; POINTS]>> = LazyLock::new(|| {
    (0..=ORDER)
        .map(|lag| {
            std::array::from_fn(|point| {
                libm::cos(lag as f64 * (point as f64 + 0.5) * PI / POINTS as f64)
            })
        })
        .collect()
});

/// Line spectral frequencies, rad, of the AR model of order [`ORDER`] whose
/// autocorrelation is that of a positive power spectrum.
#[must_use]
pub fn lsf(power: &[f64; POINTS]) -> [f32; ORDER] {
    let autocorrelation: Vec<f64> = COSINES
        .iter()
        .map(|row| row.iter().zip(power).map(|(c, p)| c * p).sum::<f64>() / POINTS as f64)
        .collect();
    let (monic, _) = levinson::from_autocorrelation(&autocorrelation);
    // The recursion gives |r| < 1 for a positive spectrum, hence a stable polynomial.
    let found = lsf::from_polynomial(&monic).unwrap_or_default();
    let mut lsf_rad = [0.0; ORDER];
    for (slot, omega) in lsf_rad.iter_mut().zip(found) {
        *slot = omega as f32;
    }
    lsf_rad
}

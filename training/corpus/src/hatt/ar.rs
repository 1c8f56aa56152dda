//! Conversion of HaTT's ARMA models to AR(21) under the fixed numerator 1 + z⁻¹.

use crate::ORDER;
use asperity::{
    signal::{lsf, spectrum::squared_magnitude},
    sources::hatt::SourceModel,
};
use asperity_surface::vibration::{self, POINTS, Spectrum};
use std::f64::consts::PI;

/// A model of the corpus at its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sounding {
    /// Tangential speed, mm/s, positive.
    pub speed_mm_s: f64,
    /// Normal force, N, positive.
    pub force_n: f64,
    /// LSFs, rad at the rate of the source, ascending.
    pub lsf_rad: [f64; ORDER],
    /// RMS over all frequencies, dB re 1 m/s².
    pub level_db: f64,
}

/// Returns true if a model vibrates. Edge models at zero speed or zero force do not.
pub(super) fn sounds(model: &SourceModel) -> bool {
    model.variance > 0.0 && model.speed_mm_s > 0.0 && model.force_n > 0.0
}

/// Converts a model by Levinson's recursion on the autocorrelation of its spectrum without the
/// zero at Nyquist.
///
/// The level is that of the source. `None` where double precision does not suffice for ordered
/// LSFs.
pub(super) fn convert(model: &SourceModel) -> Option<Sounding> {
    let mut mean = 0.0;
    let power: Spectrum = std::array::from_fn(|point| {
        let omega = (point as f64 + 0.5) * PI / POINTS as f64;
        let power =
            squared_magnitude(&model.ma.monic, omega) / squared_magnitude(&model.ar.monic, omega);
        mean += power / POINTS as f64;
        power
    });
    let shape = vibration::without_nyquist(&power).map(|power| power / mean);
    let lsf_rad = vibration::lsf(&shape).map(f64::from);
    let sigma = model.gain * model.variance.sqrt();
    let level_db = 20.0 * libm::log10(sigma) + 10.0 * libm::log10(mean);
    (lsf::is_ordered(&lsf_rad) && level_db.is_finite()).then_some(Sounding {
        speed_mm_s: model.speed_mm_s,
        force_n: model.force_n,
        lsf_rad,
        level_db,
    })
}

//! The 22nd channel of a bin: from the level of the vibration to what the network sees,
//! and back.

use crate::config::Excitation;
use asperity::signal::level::nyquist_rms;

/// Returns the network's code for a model with these LSFs (rad) and this level (dB).
pub(crate) fn encode(excitation: Excitation, lsf_rad: &[f32], level_db: f32) -> f32 {
    match excitation {
        Excitation::Level => level_db,
        Excitation::Variance => {
            let sigma_db = f64::from(level_db) - gain_db(lsf_rad);
            libm::exp10(0.1 * sigma_db) as f32
        }
    }
}

/// The level (dB) of a model with these LSFs (rad) that the network describes by `code`.
///
/// A variance must be positive.
pub(crate) fn decode(excitation: Excitation, lsf_rad: &[f32], code: f32) -> f32 {
    match excitation {
        Excitation::Level => code,
        Excitation::Variance => (10.0 * libm::log10(f64::from(code)) + gain_db(lsf_rad)) as f32,
    }
}

/// The codes that lie `margin_db` beyond `low` and `high`.
pub(crate) fn widen(excitation: Excitation, low: f32, high: f32, margin_db: f32) -> (f32, f32) {
    match excitation {
        Excitation::Level => (low - margin_db, high + margin_db),
        Excitation::Variance => {
            let factor = libm::exp10f(0.1 * margin_db);
            (low / factor, high * factor)
        }
    }
}

/// RMS of the vibration for white noise of unit variance, dB.
fn gain_db(lsf_rad: &[f32]) -> f64 {
    let lsf_rad: Vec<f64> = lsf_rad.iter().map(|&omega| f64::from(omega)).collect();
    20.0 * libm::log10(nyquist_rms(&lsf_rad))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LSF: [f32; 4] = [0.4, 0.9, 1.8, 2.6];

    #[test]
    fn every_coding_is_undone() {
        for excitation in [Excitation::Level, Excitation::Variance] {
            for level_db in [-40.0, -3.0, 12.5] {
                let code = encode(excitation, &LSF, level_db);
                assert!((decode(excitation, &LSF, code) - level_db).abs() < 1e-4);
            }
        }
    }

    #[test]
    fn the_variance_is_that_of_the_noise() {
        let rms = nyquist_rms(&LSF.map(f64::from));
        let level_db = 20.0 * libm::log10(3.0 * rms);
        let variance = encode(Excitation::Variance, &LSF, level_db as f32);
        assert!((variance - 9.0).abs() < 1e-4);
    }

    #[test]
    fn a_margin_is_the_same_in_all_codings() {
        let (low, high) = widen(Excitation::Variance, 1.0, 100.0, 6.0);
        let db = |x: f32| 10.0 * x.log10();
        assert!((db(low) + 6.0).abs() < 1e-4 && (db(high) - 26.0).abs() < 1e-4);
    }
}

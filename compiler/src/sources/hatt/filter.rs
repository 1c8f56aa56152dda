//! A polynomial that the source states twice, as coefficients and as LSFs, and the choice between
//! the two.

use asperity_texture::signal::{
    lsf,
    spectrum::{ArmaModel, log_spectral_distance_db},
};
use std::f64::consts::PI;

/// LSFs this close to the coefficients are used as printed, dB RMS.
const AGREEMENT_DB: f64 = 0.05;

/// Polynomial of a model.
#[derive(Debug, Clone, PartialEq)]
pub struct Filter {
    /// `[1, c_1, …]` as printed: the truth that errors are measured against.
    pub monic: Vec<f64>,
    /// Its line spectral frequencies, rad, ascending.
    pub lsf_rad: Vec<f64>,
    /// True if the LSFs were computed from the coefficients, because those printed described another filter.
    pub recomputed: bool,
}

/// Takes the printed LSFs where they describe the filter of the coefficients, else
/// computes them; the error is the distance of the two where neither is possible.
pub(super) fn choose(
    monic: Vec<f64>,
    lsf_rad: Vec<f64>,
    sample_rate_hz: f64,
) -> Result<Filter, f64> {
    let printed: Vec<f64> = lsf_rad.iter().map(|omega| omega.min(PI)).collect();
    let ascending = printed.windows(2).all(|pair| pair[0] <= pair[1]);
    let all_pole = |a: Vec<f64>| ArmaModel {
        sample_rate_hz,
        a,
        b: vec![1.0],
        level_m_s2: 1.0,
    };
    let distance_db = log_spectral_distance_db(
        &all_pole(monic.clone()),
        &all_pole(lsf::to_polynomial(&printed)),
    );
    if ascending && distance_db <= AGREEMENT_DB {
        return Ok(Filter {
            monic,
            lsf_rad: printed,
            recomputed: false,
        });
    }
    match lsf::from_polynomial(&monic) {
        Some(lsf_rad) => Ok(Filter {
            monic,
            lsf_rad,
            recomputed: true,
        }),
        None => Err(distance_db),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LSF: [f64; 4] = [0.4, 0.9, 1.7, 2.6];

    #[test]
    fn printed_frequencies_that_agree_are_kept() {
        let rounded = LSF.map(|omega| (omega * 1e6).round() / 1e6);
        let filter = choose(lsf::to_polynomial(&LSF), rounded.to_vec(), 1000.0).unwrap();
        assert!(!filter.recomputed);
        assert_eq!(filter.lsf_rad, rounded);
    }

    #[test]
    fn printed_frequencies_of_another_filter_are_computed_again() {
        for wrong in [[0.5, 0.9, 1.7, 2.6], [0.9, 0.4, 1.7, 2.6], [0.0; 4]] {
            let filter = choose(lsf::to_polynomial(&LSF), wrong.to_vec(), 1000.0).unwrap();
            assert!(filter.recomputed);
            for (found, expected) in filter.lsf_rad.iter().zip(&LSF) {
                assert!((found - expected).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn an_unstable_polynomial_with_foreign_frequencies_is_refused() {
        assert!(choose(vec![1.0, -2.5, 1.2], vec![0.4, 0.9], 1000.0).is_err());
    }
}

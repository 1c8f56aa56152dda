//! From the power at the frequencies of a segment to the model of a vertex.

use crate::{
    segments::{BAND_HZ, POINTS, frequencies_hz},
    timeline::RATE_HZ,
};
use asperity_texture::{
    model::{GridVertex, Numerator, VertexKind},
    signal::{levinson, lsf, reflection, spectrum::squared_magnitude},
};
use std::f64::consts::{PI, TAU};

/// Frequencies at each end of the band whose mean goes on beyond it.
const ENDS: usize = 12;
/// Power floor relative to the mean.
const FLOOR: f64 = 1e-5;
/// Neighbouring LSFs keep at least this distance, rad: more than an asset demands.
const LEAST_GAP_RAD: f64 = 0.012;

/// Orders of a model: B/A, where B is 1 or 1 + z⁻¹.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Form {
    /// AR order.
    pub(super) order: usize,
    /// 1, or 1 + z⁻¹.
    pub(super) numerator: Numerator,
}

/// The inverse cosine transform of a power over |B|², and Levinson's recursion.
#[derive(Debug, Clone)]
pub(super) struct Modeller {
    /// |B|² at the frequencies of a segment.
    above: Vec<f64>,
    /// Frequencies below those of a segment.
    below: usize,
    /// Cosines of lags 0..=order at every frequency from rest to half the rate.
    cosines: Vec<Vec<f64>>,
}

impl Modeller {
    pub(super) fn new(form: Form) -> Self {
        let step_hz = (BAND_HZ.1 - BAND_HZ.0) / (POINTS - 1) as f64;
        let below = (BAND_HZ.0 / step_hz) as usize;
        let beyond = ((0.5 * RATE_HZ - BAND_HZ.1) / step_hz) as usize;
        let omega = |freq_hz: f64| TAU * freq_hz / RATE_HZ;
        let cosines = (0..below)
            .map(|n| (n as f64 + 0.5) * BAND_HZ.0 / below as f64)
            .chain(frequencies_hz())
            .chain((1..=beyond).map(|n| BAND_HZ.1 + n as f64 * step_hz))
            .map(|freq_hz| {
                let cosine = |lag| libm::cos(lag as f64 * omega(freq_hz));
                (0..=form.order).map(cosine).collect()
            })
            .collect();
        let above = |freq_hz| match form.numerator {
            Numerator::Nyquist => squared_magnitude(&[1.0, 1.0], omega(freq_hz)),
            _ => 1.0,
        };
        Self {
            above: frequencies_hz().into_iter().map(above).collect(),
            below,
            cosines,
        }
    }

    /// The vertex of a power at the frequencies of a segment, (m/s²)²; `None` for silence.
    pub(super) fn vertex(
        &self,
        (speed_mm_s, force_n): (f64, f64),
        power: &[f64],
    ) -> Option<GridVertex> {
        let inside: Vec<f64> = power.iter().zip(&self.above).map(|(p, b)| p / b).collect();
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        let low = mean(&inside[..ENDS]);
        let high = mean(&inside[POINTS - ENDS..]);
        let all = std::iter::repeat_n(low, self.below)
            .chain(inside)
            .chain(std::iter::repeat(high));
        let mut lags = vec![0.0; self.cosines[0].len()];
        for (power, cosines) in all.zip(&self.cosines) {
            for (sum, cosine) in lags.iter_mut().zip(cosines) {
                *sum += power * cosine / self.cosines.len() as f64;
            }
        }
        if !(lags[0].is_finite() && lags[0] > 0.0) {
            return None;
        }
        lags[0] *= 1.0 + FLOOR;
        let (monic, sigma_m_s2) = levinson::from_autocorrelation(&lags);
        // A recursion that stopped early leaves trailing zeros: stable all the same.
        let reflection = reflection::step_down(&monic)?;
        Some(GridVertex {
            speed_mm_s,
            force_n,
            kind: VertexKind::Interior,
            lsf_rad: apart(lsf::from_reflection(&reflection)),
            ma_lsf_rad: None,
            gain: 1.0,
            sigma_m_s2,
        })
    }
}

/// Frequencies moved towards even spacing as little as leaves them far enough apart.
fn apart(lsf_rad: Vec<f64>) -> Vec<f64> {
    let even = PI / (lsf_rad.len() + 1) as f64;
    let gap = lsf::smallest_gap(&lsf_rad);
    if gap >= LEAST_GAP_RAD {
        return lsf_rad;
    }
    lsf::towards_white_noise(&lsf_rad, (LEAST_GAP_RAD - gap) / (even - gap))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_power_of_a_model_gives_the_model() {
        for numerator in [Numerator::None, Numerator::Nyquist] {
            let above: &[f64] = match numerator {
                Numerator::Nyquist => &[1.0, 1.0],
                _ => &[1.0],
            };
            let power: Vec<f64> = frequencies_hz()
                .into_iter()
                .map(|freq_hz| {
                    let omega = TAU * freq_hz / RATE_HZ;
                    squared_magnitude(above, omega) / squared_magnitude(&[1.0, -0.5], omega)
                })
                .collect();
            let form = Form {
                order: 1,
                numerator,
            };
            let vertex = Modeller::new(form)
                .vertex((50.0, 1.0), &power)
                .expect("a model");
            let monic = lsf::to_polynomial(&vertex.lsf_rad);
            assert!((monic[1] + 0.5).abs() < 0.03, "{monic:?}");
            assert!((vertex.sigma_m_s2 - 1.0).abs() < 0.05, "{vertex:?}");
        }
    }
}

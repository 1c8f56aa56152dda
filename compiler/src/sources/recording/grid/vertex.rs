//! From an autocorrelation to the model of a vertex.

use asperity_texture::{
    model::{GridVertex, Numerator, VertexKind},
    signal::{levinson, lsf, reflection, spectrum::squared_magnitude},
};
use std::f64::consts::PI;

/// Frequencies at which a spectrum is divided by that of the numerator.
const POINTS: usize = 256;
/// Least value of |1 + z⁻¹|² that a spectrum is divided by; at half the rate it is zero.
const LEAST_ZERO: f64 = 2e-3;
/// Power floor relative to the mean.
const FLOOR: f64 = 1e-5;
/// Neighbouring LSFs keep at least this distance, rad: more than an asset demands.
const LEAST_GAP_RAD: f64 = 0.012;

/// Form of a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Form {
    /// AR order.
    pub(super) order: usize,
    /// 1, or 1 + z⁻¹.
    pub(super) numerator: Numerator,
}

/// The vertex whose vibration begins with this autocorrelation; `None` for silence.
///
/// The lags are extended by the AR model that has all of them, whose spectrum is positive.
pub(super) fn vertex(
    speed_mm_s: f64,
    force_n: f64,
    lags: &[f64],
    form: Form,
) -> Option<GridVertex> {
    if !(lags[0].is_finite() && lags[0] > 0.0) {
        return None;
    }
    let mut raised = lags.to_vec();
    raised[0] *= 1.0 + FLOOR;
    let (monic, sigma) = if form.numerator == Numerator::None {
        let (monic, variance) = levinson::recursion(&raised[..=form.order]);
        (monic, variance.sqrt())
    } else {
        let (all, variance) = levinson::recursion(&raised);
        let omega = |n: usize| (n as f64 + 0.5) * PI / POINTS as f64;
        let shaped: Vec<f64> = (0..POINTS)
            .map(|n| {
                variance
                    / squared_magnitude(&all, omega(n))
                    / squared_magnitude(&[1.0, 1.0], omega(n)).max(LEAST_ZERO)
            })
            .collect();
        let lag = |lag: usize| {
            shaped
                .iter()
                .enumerate()
                .map(|(n, p)| p * libm::cos(lag as f64 * omega(n)))
                .sum::<f64>()
                / POINTS as f64
        };
        let shaped_lags: Vec<f64> = (0..=form.order).map(lag).collect();
        levinson::from_autocorrelation(&shaped_lags)
    };
    // A recursion that stopped early leaves trailing zeros: stable all the same.
    let reflection = reflection::step_down(&monic)?;
    let lsf_rad = apart(lsf::from_reflection(&reflection));
    Some(GridVertex {
        speed_mm_s,
        force_n,
        kind: VertexKind::Interior,
        lsf_rad,
        ma_lsf_rad: None,
        gain: 1.0,
        sigma_m_s2: sigma,
    })
}

/// Frequencies moved towards even spacing as little as leaves them far enough apart.
pub(super) fn apart(lsf_rad: Vec<f64>) -> Vec<f64> {
    let even = PI / (lsf_rad.len() + 1) as f64;
    let gap = lsf::smallest_gap(&lsf_rad);
    if gap >= LEAST_GAP_RAD {
        return lsf_rad;
    }
    lsf::towards_white_noise(&lsf_rad, (LEAST_GAP_RAD - gap) / (even - gap))
}

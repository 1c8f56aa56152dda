//! The virtual wall.

use crate::math::max;

/// Normal force `k·δ − b·ḋ`, N, never pulling: `stiffness_n` is k·δ (0 out of contact),
/// `damping_n_s_m` is b, `outward_m_s` is ḋ.
#[inline]
#[must_use]
pub fn force_n(stiffness_n: f32, damping_n_s_m: f32, outward_m_s: f32) -> f32 {
    let damped = max(stiffness_n - damping_n_s_m * outward_m_s, 0.0);
    if stiffness_n > 0.0 { damped } else { 0.0 }
}

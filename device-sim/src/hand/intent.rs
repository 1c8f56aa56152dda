//! Intent of a hand during a tick, and the resulting pull on each axis.

use super::grip::Grip;
use crate::axis::Pull;

/// Intent of the hand during a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Intent {
    /// Intended position at the start of the tick, m.
    pub target_m: [f64; 3],
    /// Intended velocity, m/s.
    pub target_m_s: [f64; 3],
    /// Force that the hand adds to overcome the inertia and friction it knows, N.
    pub feed_forward_n: [f64; 3],
    /// Normal force that the hand means to hold, N; `None` while it holds none.
    pub wanted_n: Option<f64>,
    /// Index of the motion in the script.
    pub motion: usize,
    /// True while the motion itself runs; false while the hand lands or settles.
    pub in_body: bool,
}

impl Intent {
    /// The pull on each axis, `t_s` seconds into the tick.
    #[must_use]
    pub fn pull(&self, grip: &Grip, t_s: f64) -> [Pull; 3] {
        std::array::from_fn(|i| Pull {
            stiffness_n_m: grip.stiffness_n_m,
            damping_n_s_m: grip.damping_n_s_m,
            target_m: self.target_m[i] + t_s * self.target_m_s[i],
            target_m_s: self.target_m_s[i],
            force_n: self.feed_forward_n[i],
        })
    }
}

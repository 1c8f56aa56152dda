//! What a hand wants during one tick, and how its grip pulls.

use super::grip::Grip;
use crate::axis::Pull;

/// What the hand wants during one tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Intent {
    /// Where it means to be at the start of the tick, m.
    pub target_m: [f64; 3],
    /// How it means to move, m/s.
    pub target_m_s: [f64; 3],
    /// Force it adds against the inertia and friction it knows, N.
    pub feed_forward_n: [f64; 3],
    /// Normal force it means to hold, N, when it holds one.
    pub wanted_n: Option<f64>,
    /// Index of the motion in the script.
    pub motion: usize,
    /// Whether the motion proper runs: false while landing or settling.
    pub in_body: bool,
}

impl Intent {
    /// The pull on each axis, `t_s` into the tick.
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

//! The force of a contact over time.

use std::f64::consts::PI;

/// How much of its half of the contact time the closing loses at e = 0: losses lean the pulse
/// forward.
const LEAN: f64 = 0.3;

/// A Hertzian pulse, `sin^(3/2)` of a phase that runs from 0 to π. The force of a Hertzian contact
/// is the 3/2 power of an indentation that is nearly a half sine.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pulse {
    /// Contact time without losses, s.
    pub(super) time_s: f64,
    /// Coefficient of restitution.
    pub(super) restitution: f64,
    /// The part of the opening that a dent takes away.
    pub(super) set: f64,
}

impl Pulse {
    /// Force at a time after the touch, relative to its peak.
    pub(super) fn at(&self, t_s: f64) -> f64 {
        let closing_s = 0.5 * self.time_s * (1.0 - LEAN * (1.0 - self.restitution));
        let opening_s = (self.time_s - closing_s) * (1.0 - self.set);
        let phase = if t_s < closing_s {
            0.5 * t_s / closing_s
        } else {
            0.5 + 0.5 * (t_s - closing_s) / opening_s
        };
        if phase < 1.0 {
            let indentation = libm::sin(PI * phase).max(0.0);
            indentation * indentation.sqrt()
        } else {
            0.0
        }
    }
}

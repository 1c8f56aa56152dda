//! Taps: an impact starts a transient along the normal, a_tap(t).
//!
//! [`impact`] gives the speed of an impact, [`bank`] the transient that belongs to it.
//! After an impact the detector waits until the stylus is `rearm_m` away.

pub mod bank;
pub mod impact;
mod resample;

use self::{
    bank::{Selection, TapBank},
    impact::{Detector, WINDOW, place},
};
use crate::{
    arithmetic::{Arithmetic, Float, Scalar as _, Zero as _},
    capacity::Capacity,
    events::Flags,
    quantity::{
        Quantity, Raw,
        unit::{Fraction, Metre, TapAcceleration},
    },
};

/// The impact detector and the transient under way.
#[derive(Debug, Clone, PartialEq)]
pub struct TapState<A: Arithmetic = Float> {
    /// Signed distances in a ring, m.
    distances: [Raw<A, Metre>; WINDOW],
    /// The position of the newest, in parts of an entry; the older ones follow.
    newest: u8,
    armed: bool,
    /// Next tick of the transient; at its length or above when none plays.
    tick: u32,
    // The [`Selection`] that plays, in parts, so that no padding takes memory.
    traces: [u8; 2],
    weights: [Quantity<A, Fraction>; 2],
}

/// Output of the tap stage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tap<A: Arithmetic = Float> {
    /// Acceleration along the normal, m/s².
    pub acceleration: Quantity<A, TapAcceleration>,
    /// Flags for the start of a transient in this tick, and for one under way.
    pub flags: Flags,
}

impl<A: Arithmetic> TapState<A> {
    /// No contact was seen yet, so the first one is no impact.
    pub const IDLE: Self = Self {
        distances: [A::Scalar::ZERO; WINDOW],
        newest: 0,
        armed: false,
        tick: u32::MAX,
        traces: [0; 2],
        weights: [Quantity::ZERO; 2],
    };

    /// Starts over at a distance, m; a first sample inside is no impact.
    pub fn restart(&mut self, distance: Quantity<A, Metre>) {
        *self = Self::IDLE;
        self.distances = [distance.0; WINDOW];
    }

    /// Changes to another surface, from which the last position was `distance` away, m. The slope
    /// stays, and a transient plays on. A surface that was already entered is no impact.
    pub(crate) fn cross(&mut self, distance: Quantity<A, Metre>) {
        let moved = (distance - self.distance()).0;
        for past in &mut self.distances {
            *past = past.saturating_add(moved);
        }
        // The next motion is counted from this distance, so it is stored without rounding.
        self.distances[place(self.newest, 0)] = distance.0;
        self.armed = self.armed && distance > Quantity::ZERO;
    }

    /// The last distance, m.
    #[inline(always)]
    #[must_use]
    pub fn distance(&self) -> Quantity<A, Metre> {
        Quantity(self.distances[place(self.newest, 0)])
    }
}

impl<A: Arithmetic> Detector<A> {
    /// Advances by a tick at a distance from the surface, m, negative inside.
    #[inline]
    pub fn step<S: Capacity>(
        &self,
        state: &mut TapState<A>,
        bank: &TapBank<S, A>,
        distance: Quantity<A, Metre>,
    ) -> Tap<A> {
        state.newest = self.advance(state.newest);
        state.distances[place(state.newest, 0)] = distance.0;
        let mut flags = Flags::NONE;
        if distance < Quantity::ZERO {
            if state.armed {
                let speed = self.approach_speed(&state.distances, state.newest);
                if speed >= self.min_speed {
                    let selection = bank.select(speed);
                    state.traces = selection.traces;
                    state.weights = selection.weights;
                    state.tick = 0;
                    flags = Flags::TAP_STARTED;
                }
            }
            state.armed = false;
        } else if distance > self.rearm {
            state.armed = true;
        }
        let mut acceleration = Quantity::ZERO;
        if (state.tick as usize) < bank.ticks() {
            flags = flags.union(Flags::TAP_ACTIVE);
            let selection = Selection {
                traces: state.traces,
                weights: state.weights,
            };
            acceleration = bank.acceleration(&selection, state.tick as usize);
            state.tick += 1;
        }
        Tap {
            acceleration,
            flags,
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{bank::bank, *};
    use crate::config::Config;

    #[test]
    fn an_impact_rearms_only_at_a_distance() {
        let bank = bank();
        let detector = Detector::<Float>::new(&Config::default().tap, 1000.0);
        let mut state = TapState::IDLE;
        state.restart(Quantity(0.01));
        let mut starts = std::vec::Vec::new();
        // Down at 0.2 m/s, a bounce of 0.3 mm, then up by 3 mm and down again.
        let heights = (0..60)
            .map(|n| 6e-3 - 0.2e-3 * n as f32)
            .take(40)
            .chain([0.3e-3; 10])
            .chain([-0.3e-3; 10])
            .chain((0..40).map(|n| 3e-3 - 0.1e-3 * n as f32));
        for (n, height) in heights.enumerate() {
            let output = detector.step(&mut state, &bank, Quantity(height));
            if output.flags.contains(Flags::TAP_STARTED) {
                starts.push((n, state.traces[0], state.weights[0].value()));
            }
        }
        assert_eq!(starts.len(), 2, "{starts:?}");
        assert_eq!(starts[0].0, 31);
        // The trace of 0.2 m/s alone, within the rounding of eight heights.
        assert!(starts[0].1 == 1 && starts[0].2 > 0.999);
    }
}

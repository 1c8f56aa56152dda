//! The gate: it holds a few bad samples, then enters the safe state.
//!
//! A sample is bad when it is stale, not finite or out of reach. Up to `hold_ticks` bad samples in
//! a row hold the last good one; one more enters the safe state. The wanted force is then zero, and
//! the limiter takes the force there at the slew limit. Periods that the caller reports as missed
//! count like bad samples. The first good sample afterwards restarts the motion estimate, and the
//! force comes back by a ramp.

use crate::{
    arithmetic::{Arithmetic, Fixed, Float},
    config::SafetyConfig,
    events::Flags,
    math::max,
    quantity::{
        Quantity, StoredVector, Vector,
        unit::{Gain, Metre},
    },
    sample::Sample,
};

/// Range of positions in an arithmetic.
pub trait Positions: Arithmetic {
    /// A distance beyond every position in reach, m.
    const OUT_OF_REACH_M: f32;
}

impl Positions for Float {
    const OUT_OF_REACH_M: f32 = 1.0e5;
}

impl Positions for Fixed {
    const OUT_OF_REACH_M: f32 = 4.0;
}

/// The gate that every sample passes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gate<A: Arithmetic = Float> {
    /// Bad samples in a row that hold the last good one.
    hold_ticks: u32,
    /// Largest valid magnitude of a coordinate, m.
    reach: Quantity<A, Metre>,
    /// Recovery of the gain per tick.
    ramp: Quantity<A, Gain>,
}

/// State of a [`Gate`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GateState<A: Arithmetic = Float> {
    position: StoredVector<A, Metre>,
    /// Bad samples in a row. After more than are held, motion starts anew with the next good one.
    bad_in_a_row: u32,
    /// Gain on the force, 0 to 1.
    gain: Quantity<A, Gain>,
}

/// Output of the gate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gated<A: Arithmetic = Float> {
    /// Position to render, m.
    pub position: Vector<A, Metre>,
    /// Displacement since the position before, m; zero where motion starts anew.
    pub motion: Vector<A, Metre>,
    /// Periods since the last rendered position, 1 to 3.
    pub elapsed_ticks: u32,
    /// Gain on the force, 0 to 1.
    pub gain: Quantity<A, Gain>,
    /// Events: held sample, safe state and ramp; restart, bad sample and fault for the other stages.
    pub flags: Flags,
}

impl<A: Arithmetic> Default for GateState<A> {
    fn default() -> Self {
        Self::new()
    }
}

impl<A: Arithmetic> GateState<A> {
    /// The state before the first sample, which is let through without a ramp.
    #[must_use]
    pub fn new() -> Self {
        Self {
            position: StoredVector::ZERO,
            bad_in_a_row: u32::MAX,
            gain: Quantity::whole(1),
        }
    }

    /// The last usable position, m.
    #[inline(always)]
    #[must_use]
    pub fn position(&self) -> Vector<A, Metre> {
        self.position.get()
    }
}

impl<A: Positions> Gate<A> {
    /// The gate of a configuration at a servo rate.
    #[must_use]
    pub fn new(config: &SafetyConfig, servo_rate_hz: f32) -> Self {
        Self {
            hold_ticks: config.hold_ticks,
            reach: Quantity::of(config.reach_m),
            ramp: Quantity::of(1.0 / max(config.ramp_s * servo_rate_hz, 1.0)),
        }
    }

    /// Returns true if a sample holds a usable position.
    #[inline(always)]
    pub(crate) fn is_usable(&self, sample: &Sample<A>) -> bool {
        let position = Vector::<A, Metre>::load(sample.position_m);
        position.is_within(self.reach) & (sample.elapsed_ticks > 0)
    }

    /// Passes a sample through the gate.
    #[inline]
    pub fn step(&self, state: &mut GateState<A>, sample: &Sample<A>) -> Gated<A> {
        let position = Vector::load(sample.position_m);
        // 0 wraps to the largest number, so a stale sample counts as far too late.
        let missed = sample.elapsed_ticks.wrapping_sub(1);
        let within = position.is_within(self.reach);
        // The bits of both are no less than either number. At worst a regular sample takes the
        // longer way.
        if missed | state.bad_in_a_row > self.hold_ticks || !within {
            return self.irregular(state, sample, within);
        }
        let position = position.settled();
        let motion = position - state.position();
        state.position = position.into();
        state.bad_in_a_row = 0;
        let flags = self.ramp(state);
        Gated {
            position,
            motion,
            elapsed_ticks: sample.elapsed_ticks,
            gain: state.gain,
            flags,
        }
    }

    /// Raises the gain by one step of the ramp.
    #[inline(always)]
    fn ramp(&self, state: &mut GateState<A>) -> Flags {
        let whole = Quantity::whole(1);
        if state.gain < whole {
            // Both are at most 1, so the sum is in range.
            state.gain = state.gain + self.ramp;
            if state.gain < whole {
                return Flags::RAMPING;
            }
            state.gain = whole;
        }
        Flags::NONE
    }

    /// Takes a bad sample, a sample after missed periods, or the first one.
    #[inline(always)]
    fn irregular(&self, state: &mut GateState<A>, sample: &Sample<A>, within: bool) -> Gated<A> {
        let fresh = state.bad_in_a_row > self.hold_ticks;
        let (before, mut elapsed_ticks) = (state.position(), 1);
        let mut motion = Vector::ZERO;
        let flags = if within && sample.elapsed_ticks > 0 {
            let position = Vector::load(sample.position_m).settled();
            state.position = position.into();
            state.bad_in_a_row = 0;
            if fresh {
                Flags::RESTART.union(self.ramp(state))
            } else if sample.elapsed_ticks - 1 > self.hold_ticks {
                Flags::RESTART.union(self.fault(state))
            } else {
                (motion, elapsed_ticks) = (position - before, sample.elapsed_ticks);
                self.ramp(state)
            }
        } else {
            state.bad_in_a_row = state.bad_in_a_row.saturating_add(1);
            let flags = if state.bad_in_a_row <= self.hold_ticks {
                let ramping = state.gain < Quantity::whole(1);
                Flags::HELD_SAMPLE.union(Flags::RAMPING.when(ramping))
            } else if fresh {
                state.gain = Quantity::ZERO;
                Flags::SAFE_STATE
            } else {
                self.fault(state)
            };
            flags.union(Flags::BAD_SAMPLE)
        };
        Gated {
            position: state.position(),
            motion,
            elapsed_ticks,
            gain: state.gain,
            flags,
        }
    }

    /// Begins the safe state.
    #[inline(always)]
    fn fault(&self, state: &mut GateState<A>) -> Flags {
        state.gain = Quantity::ZERO;
        Flags::SAFE_STATE.union(Flags::FAULT)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BAD: Sample = Sample::at([f32::NAN, 0.0, 0.0]);
    const GOOD: Sample = Sample::at([0.0; 3]);

    /// Two bad samples are held, and the force comes back in four steps.
    fn gate() -> (Gate, GateState) {
        let config = SafetyConfig {
            hold_ticks: 2,
            ramp_s: 4e-3,
            reach_m: 1.0,
        };
        (Gate::new(&config, 1000.0), GateState::new())
    }

    #[test]
    fn two_bad_samples_hold_and_the_third_is_a_fault() {
        let (gate, mut state) = gate();
        let mut step = |sample: &Sample| gate.step(&mut state, sample);
        assert!(step(&GOOD).flags.contains(Flags::RESTART));
        assert!(step(&BAD).flags.contains(Flags::HELD_SAMPLE));
        assert!(step(&Sample::STALE).flags.contains(Flags::HELD_SAMPLE));
        let third = step(&BAD);
        assert!(
            third.flags.contains(Flags::SAFE_STATE)
                && third.flags.contains(Flags::FAULT)
                && third.gain.0 == 0.0
        );
        let fourth = step(&BAD);
        assert!(
            fourth.flags.contains(Flags::SAFE_STATE) && !fourth.flags.contains(Flags::FAULT),
            "one fault is counted once"
        );
        let back = step(&GOOD);
        assert!(
            back.flags.contains(Flags::RESTART)
                && !back.flags.contains(Flags::SAFE_STATE)
                && back.gain.0 == 0.25
        );
        for gain in [0.5, 0.75, 1.0, 1.0] {
            assert_eq!(step(&GOOD).gain.0, gain);
        }
    }

    #[test]
    fn a_coordinate_beyond_the_reach_is_a_bad_sample() {
        let (gate, mut state) = gate();
        for coordinate in 0..3 {
            for (size, is_bad) in [(1.0, false), (1.0 + f32::EPSILON, true), (40.0, true)] {
                for sign in [1.0, -1.0] {
                    let mut position = [0.0; 3];
                    position[coordinate] = sign * size;
                    let flags = gate.step(&mut state, &Sample::at(position)).flags;
                    assert_eq!(flags.contains(Flags::BAD_SAMPLE), is_bad, "{position:?}");
                }
            }
        }
    }

    #[test]
    fn a_held_sample_keeps_the_force() {
        let (gate, mut state) = gate();
        gate.step(&mut state, &GOOD);
        assert_eq!(gate.step(&mut state, &BAD).gain.0, 1.0);
        let good = gate.step(&mut state, &GOOD);
        assert!(good.gain.0 == 1.0 && !good.flags.contains(Flags::RESTART));
    }

    #[test]
    fn missed_periods_count_like_bad_samples() {
        let late = |elapsed_ticks| Sample {
            elapsed_ticks,
            ..GOOD
        };
        let (gate, mut state) = gate();
        gate.step(&mut state, &GOOD);
        let two_missed = gate.step(&mut state, &late(3));
        assert!(!two_missed.flags.contains(Flags::SAFE_STATE) && two_missed.elapsed_ticks == 3);
        let three_missed = gate.step(&mut state, &late(4));
        assert!(
            three_missed.flags.contains(Flags::FAULT)
                && three_missed.flags.contains(Flags::SAFE_STATE)
                && three_missed.flags.contains(Flags::RESTART)
        );
        assert_eq!(gate.step(&mut state, &GOOD).gain.0, 0.25);
    }

    #[test]
    fn a_start_without_a_sample_is_safe_and_no_fault() {
        let (gate, mut state) = gate();
        let first = gate.step(&mut state, &BAD);
        assert!(
            first.flags.contains(Flags::SAFE_STATE)
                && !first.flags.contains(Flags::FAULT)
                && !first.flags.contains(Flags::HELD_SAMPLE)
        );
    }
}

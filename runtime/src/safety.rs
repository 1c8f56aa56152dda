//! Bad samples: hold, safe state, ramp.
//!
//! A sample is bad when it is stale, not finite or out of reach. Up to `hold_ticks`
//! bad samples in a row hold the last good one; one more enters the safe state: the
//! force wanted is zero, the limiter takes it there at the slew limit. Periods that the
//! caller reports as missed count like bad samples. The first good sample afterwards
//! restarts the motion estimate, and the force comes back by a ramp.

use crate::{
    Flags, Sample,
    arithmetic::{
        Arithmetic, Float, Four, Number, Three,
        units::{Gain, Metre},
    },
};

/// The gate that every sample passes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gate<A: Arithmetic = Float> {
    position_m: Three<A, Metre>,
    /// Bad samples in a row: with more than are held, the next good one starts anew.
    bad_in_a_row: u32,
    /// Share of the force that is let through, 0..=1.
    gain: Number<A, Gain>,
}

/// What the gate lets through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gated<A: Arithmetic = Float> {
    /// Position to render, m.
    pub(crate) position_m: Four<A, Metre>,
    /// Displacement since the position before, m; none where motion starts anew.
    pub(crate) motion_m: Four<A, Metre>,
    /// Periods since the last rendered position, 1..=3.
    pub elapsed_ticks: u32,
    /// Share of the force, 0..=1.
    pub(crate) gain: Number<A, Gain>,
    /// Held sample, safe state, ramp; for the other stages restart, bad sample and fault.
    pub flags: Flags,
}

/// Whether a sample may be a position.
#[inline(always)]
pub(crate) fn is_usable<A: Arithmetic>(sample: &Sample<A>) -> bool {
    let p = Four::<A, Metre>::vec3(sample.position_m);
    p.is_within(A::REACH_M) & (sample.elapsed_ticks > 0)
}

impl<A: Arithmetic> Default for Gate<A> {
    fn default() -> Self {
        Self::new()
    }
}

impl<A: Arithmetic> Gate<A> {
    /// Before the first sample; it is let through without a ramp.
    #[must_use]
    pub fn new() -> Self {
        Self {
            position_m: Three::ZERO,
            bad_in_a_row: u32::MAX,
            gain: Number::whole(1),
        }
    }

    /// The last usable position, m.
    #[inline(always)]
    pub(crate) fn position_m(&self) -> Four<A, Metre> {
        self.position_m.four()
    }

    /// One sample; `ramp_step` is the gain regained a tick.
    #[inline]
    pub fn step(
        &mut self,
        sample: &Sample<A>,
        hold_ticks: u32,
        ramp_step: A::Scalar<Gain>,
    ) -> Gated<A> {
        let ramp_step = Number(ramp_step);
        let p = Four::vec3(sample.position_m);
        // A stale sample counts as far too late.
        let missed = sample.elapsed_ticks.wrapping_sub(1);
        let within = p.is_within(A::REACH_M);
        // The union is no less than either; at worst, a regular sample takes the longer way.
        if missed | self.bad_in_a_row > hold_ticks || !within {
            return self.irregular(sample, within, hold_ticks, ramp_step);
        }
        let motion_m = p - self.position_m();
        self.position_m = Three::of(p);
        self.bad_in_a_row = 0;
        let flags = self.ramp(ramp_step);
        Gated {
            position_m: p,
            motion_m,
            elapsed_ticks: sample.elapsed_ticks,
            gain: self.gain,
            flags,
        }
    }

    /// The force comes back by one step.
    #[inline(always)]
    fn ramp(&mut self, ramp_step: Number<A, Gain>) -> Flags {
        let whole = Number::whole(1);
        if self.gain < whole {
            // Both are at most 1.
            self.gain = self.gain + ramp_step;
            if self.gain < whole {
                return Flags::RAMPING;
            }
            self.gain = whole;
        }
        Flags::NONE
    }

    /// A bad sample, one after missed periods, or the first one.
    #[inline(always)]
    fn irregular(
        &mut self,
        sample: &Sample<A>,
        within: bool,
        hold_ticks: u32,
        ramp_step: Number<A, Gain>,
    ) -> Gated<A> {
        let fresh = self.bad_in_a_row > hold_ticks;
        let (before, mut elapsed_ticks) = (self.position_m(), 1);
        let mut motion_m = Four::ZERO;
        let flags = if within && sample.elapsed_ticks > 0 {
            let p = Four::vec3(sample.position_m);
            self.position_m = Three::of(p);
            self.bad_in_a_row = 0;
            if fresh {
                Flags::RESTART.and(self.ramp(ramp_step))
            } else if sample.elapsed_ticks - 1 > hold_ticks {
                Flags::RESTART.and(self.fault())
            } else {
                (motion_m, elapsed_ticks) = (p - before, sample.elapsed_ticks);
                self.ramp(ramp_step)
            }
        } else {
            self.bad_in_a_row = self.bad_in_a_row.saturating_add(1);
            let flags = if self.bad_in_a_row <= hold_ticks {
                Flags::HELD_SAMPLE.and(Flags::RAMPING.when(self.gain < Number::whole(1)))
            } else if fresh {
                self.gain = Number::ZERO;
                Flags::SAFE_STATE
            } else {
                self.fault()
            };
            flags.and(Flags::BAD_SAMPLE)
        };
        Gated {
            position_m: self.position_m(),
            motion_m,
            elapsed_ticks,
            gain: self.gain,
            flags,
        }
    }

    /// The safe state begins.
    #[inline(always)]
    fn fault(&mut self) -> Flags {
        self.gain = Number::ZERO;
        Flags::SAFE_STATE.and(Flags::FAULT)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BAD: Sample = Sample::at([f32::NAN, 0.0, 0.0]);
    const GOOD: Sample = Sample::at([0.0; 3]);

    #[test]
    fn two_bad_samples_hold_and_the_third_is_a_fault() {
        let mut gate = Gate::new();
        let mut step = |sample: &Sample| gate.step(sample, 2, 0.25);
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
    fn a_held_sample_keeps_the_force() {
        let mut gate = Gate::new();
        gate.step(&GOOD, 2, 0.25);
        assert_eq!(gate.step(&BAD, 2, 0.25).gain.0, 1.0);
        let good = gate.step(&GOOD, 2, 0.25);
        assert!(good.gain.0 == 1.0 && !good.flags.contains(Flags::RESTART));
    }

    #[test]
    fn missed_periods_count_like_bad_samples() {
        let late = |elapsed_ticks| Sample {
            elapsed_ticks,
            ..GOOD
        };
        let mut gate = Gate::new();
        gate.step(&GOOD, 2, 0.25);
        let two_missed = gate.step(&late(3), 2, 0.25);
        assert!(!two_missed.flags.contains(Flags::SAFE_STATE) && two_missed.elapsed_ticks == 3);
        let three_missed = gate.step(&late(4), 2, 0.25);
        assert!(
            three_missed.flags.contains(Flags::FAULT)
                && three_missed.flags.contains(Flags::SAFE_STATE)
                && three_missed.flags.contains(Flags::RESTART)
        );
        assert_eq!(gate.step(&GOOD, 2, 0.25).gain.0, 0.25);
    }

    #[test]
    fn a_start_without_a_sample_is_safe_and_no_fault() {
        let mut gate = Gate::new();
        let first = gate.step(&BAD, 2, 0.25);
        assert!(
            first.flags.contains(Flags::SAFE_STATE)
                && !first.flags.contains(Flags::FAULT)
                && !first.flags.contains(Flags::HELD_SAMPLE)
        );
    }
}

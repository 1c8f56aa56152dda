//! Input and output of a tick.

use crate::{
    arithmetic::{Arithmetic, Float, Scalar as _},
    events::Flags,
    quantity::{
        Raw,
        unit::{Metre, MillimetrePerSecond, Newton, VibrationAcceleration},
    },
};

/// Device sample of one servo period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample<A: Arithmetic = Float> {
    /// Stylus position in the world frame, m. Anything not finite, or beyond the
    /// configuration's `reach_m`, is a bad sample.
    pub position_m: [Raw<A, Metre>; 3],
    /// Servo periods since the sample before: 1 in a healthy loop, more after missed
    /// periods, 0 when the device had nothing new.
    pub elapsed_ticks: u32,
}

impl<A: Arithmetic> Sample<A> {
    /// A fresh sample of a healthy loop.
    #[must_use]
    pub const fn at(position_m: [Raw<A, Metre>; 3]) -> Self {
        Self {
            position_m,
            elapsed_ticks: 1,
        }
    }

    /// Converts a sample in floats. A coordinate that the arithmetic cannot hold becomes a missing
    /// one.
    #[must_use]
    pub fn of(sample: &Sample) -> Self {
        let number = |x: f32| {
            if Raw::<A, Metre>::holds(x) {
                A::Scalar::of(x)
            } else {
                A::Scalar::MISSING
            }
        };
        Self {
            position_m: sample.position_m.map(number),
            elapsed_ticks: sample.elapsed_ticks,
        }
    }

    /// A sample for a period in which the device had nothing new, or was lost.
    pub const STALE: Self = Self {
        position_m: [A::Scalar::MISSING; 3],
        elapsed_ticks: 0,
    };
}

/// Output of a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Output<A: Arithmetic = Float> {
    /// Force on the hand in the world frame, N; finite, within peak and slew.
    pub force_n: [Raw<A, Newton>; 3],
    /// Depth inside the surface, m; 0 outside.
    pub depth_m: Raw<A, Metre>,
    /// Estimated tangential speed, mm/s.
    pub speed_mm_s: Raw<A, MillimetrePerSecond>,
    /// k·δ, N: the force of the query, and the load of the friction.
    pub normal_force_n: Raw<A, Newton>,
    /// y\[n\] before device gain, m/s².
    pub vib_m_s2: Raw<A, VibrationAcceleration>,
    /// Tap force along the normal, N.
    pub tap_n: Raw<A, Newton>,
    /// Magnitude of the friction force, N.
    pub friction_n: Raw<A, Newton>,
    /// Events of the tick.
    pub flags: Flags,
}

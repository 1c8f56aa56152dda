//! Velocity from motion: backward difference and second-order low-pass.
//!
//! Butterworth low-passes by the bilinear transform, in transposed direct form II, one each for
//! the three components along the world's axes and for the distance from the solid. For a motion
//! Δ over n periods
//!
//! ```text
//! u = b0·Δ·rate/n,   v = u + s1,   s1 = 2u − a1·v + s2,   s2 = u − a2·v,
//! ```
//!
//! since b1 = 2·b0 and b2 = b0. Unit gain at DC; the delay at low frequency is √2/(2π f_c).

use crate::{
    arithmetic::{
        Arithmetic, Fixed, Float, Point, Quad,
        fixed::{narrow_within, shift, wide},
    },
    lanes::F4,
    math::{cos_pi, sin_pi},
    quantity::{
        Four, Magnitude, Magnitudes, Quantity, StoredVector, Vector,
        unit::{Fraction, Hertz, Metre, MetrePerSecond, Unit},
    },
};

/// Velocities are whole multiples of this or larger than 2²³ of it, 2⁻³⁶ m/s.
const SLOWEST_M_S: f32 = f32::from_bits((127 - 36) << 23);
/// Below this speed the direction of motion is the last one, m/s.
const DIRECTION_FLOOR_M_S: f32 = 1.0e-4;
/// No component of a velocity enters its low-pass beyond this, m/s, where numbers have a range.
const FASTEST_M_S: f32 = 16.0;

/// The difference of positions times a rate.
pub trait Differences: Magnitudes {
    /// a·b in each lane, cut at the same lane of `limits` where numbers have a range.
    fn scaled_within<F: Point, G: Point, H: Point>(
        a: Self::Four<F>,
        b: Self::Four<G>,
        limits: Self::Four<H>,
    ) -> Self::Four<H>;
}

impl Differences for Float {
    #[inline(always)]
    fn scaled_within<F: Point, G: Point, H: Point>(a: F4, b: F4, _: F4) -> F4 {
        a * b
    }
}

impl Differences for Fixed {
    #[inline(always)]
    fn scaled_within<F: Point, G: Point, H: Point>(
        a: Quad<F>,
        b: Quad<G>,
        limits: Quad<H>,
    ) -> Quad<H> {
        Quad::from_lanes(|lane| {
            let limit = limits.0[lane].to_bits();
            narrow_within(wide(a.0[lane], b.0[lane]), shift::<F, G, H>(), limit)
        })
    }
}

/// The low-passes, prepared for a servo rate.
#[derive(Debug, Clone, Copy)]
pub struct VelocityEstimator<A: Arithmetic = Float> {
    /// b0·rate/n for n = 1, 2 and 3 elapsed periods. Entry 0 is never used.
    gains: [Four<A, Hertz>; 4],
    /// The largest u, m/s, where numbers have a range.
    largest: Four<A, MetrePerSecond>,
    a1: Four<A, Fraction>,
    a2: Four<A, Fraction>,
}

/// State of a [`VelocityEstimator`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VelocityState<A: Arithmetic = Float> {
    s1: Four<A, MetrePerSecond>,
    s2: Four<A, MetrePerSecond>,
}

/// Velocity of the stylus.
#[derive(Debug, Clone, Copy)]
pub struct Velocity<A: Arithmetic = Float> {
    /// Along the world's axes, m/s.
    pub world: Vector<A, MetrePerSecond>,
    /// Away from the solid, ḋ, m/s.
    pub outward: Quantity<A, MetrePerSecond>,
}

impl<A: Arithmetic> VelocityState<A> {
    /// At rest.
    pub const REST: Self = Self {
        s1: Four::ZERO,
        s2: Four::ZERO,
    };
}

impl<A: Magnitudes> Velocity<A> {
    /// The speed in the plane with unit normal n̂, m/s. Where it is more than 0.1 mm/s its
    /// direction t̂ takes the place of `direction`.
    #[inline(always)]
    pub fn slide(
        &self,
        normal: Vector<A, Fraction>,
        direction: &mut StoredVector<A, Fraction>,
    ) -> Quantity<A, MetrePerSecond> {
        // A part along the normal so small that its own parts have no square is none.
        let along = self.world.dot(normal).settled_within(SLOWEST_M_S);
        let slide = self.world - normal * along;
        let magnitude = Magnitude::unguarded(slide);
        let speed = magnitude.length();
        if speed > Quantity::of(DIRECTION_FLOOR_M_S) {
            *direction = slide.direction(magnitude).into();
        }
        speed
    }
}

impl<A: Differences> VelocityEstimator<A> {
    /// Low-passes with cut-offs (−3 dB) of `cutoff_hz` along the axes and `normal_cutoff_hz`
    /// along the normal, at `rate_hz`; 0 < cut-off < rate/2.
    #[must_use]
    pub fn new(cutoff_hz: f32, normal_cutoff_hz: f32, rate_hz: f32) -> Self {
        let k = [cutoff_hz, cutoff_hz, cutoff_hz, normal_cutoff_hz].map(|cutoff_hz| {
            let x = cutoff_hz / rate_hz;
            sin_pi(x) / cos_pi(x)
        });
        let norm = |k: f32| 1.0 / (1.0 + core::f32::consts::SQRT_2 * k + k * k);
        let b0 = k.map(|k| k * k * norm(k));
        let rates_hz = [rate_hz, rate_hz, rate_hz / 2.0, rate_hz / 3.0];
        Self {
            gains: rates_hz.map(|rate_hz| Four::of(b0.map(|b0| b0 * rate_hz))),
            largest: Four::of(b0.map(|b0| b0 * FASTEST_M_S)),
            a1: Four::of(k.map(|k| 2.0 * (k * k - 1.0) * norm(k))),
            a2: Four::of(k.map(|k| (1.0 - core::f32::consts::SQRT_2 * k + k * k) * norm(k))),
        }
    }

    /// The velocity after a `motion`, m, and a change of `distance` from the solid, m, over
    /// `elapsed_ticks` (1 to 3) periods.
    #[inline(always)]
    pub fn step(
        &self,
        state: &mut VelocityState<A>,
        motion: Vector<A, Metre>,
        distance: Quantity<A, Metre>,
        elapsed_ticks: u32,
    ) -> Velocity<A> {
        let motion = motion.with_fourth(distance);
        let gain = self.gains[elapsed_ticks as usize % 4];
        let u = Four(A::scaled_within::<
            <Metre as Unit>::Point,
            <Hertz as Unit>::Point,
            <MetrePerSecond as Unit>::Point,
        >(motion.0, gain.0, self.largest.0));
        // At rest the low-pass would decay through denormals. What is left of it, up to 1 nm/s, stays
        // large enough that its part in any plane has a square.
        let v = (u + state.s1).settled_within(SLOWEST_M_S);
        state.s1 = u + u - self.a1 * v + state.s2;
        state.s2 = u - self.a2 * v;
        Velocity {
            world: v.vector(),
            outward: v.lane(3),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_is_followed_with_the_stated_delay() {
        let rate_hz = 1000.0;
        for (cutoff_hz, normal_cutoff_hz) in [(20.0, 5.0), (40.0, 100.0)] {
            let filter = VelocityEstimator::<Float>::new(cutoff_hz, normal_cutoff_hz, rate_hz);
            let mut state = VelocityState::REST;
            let mut velocity = filter.step(&mut state, Vector::ZERO, Quantity::ZERO, 1);
            for n in 1..2000 {
                let motion_m = n as f32 / rate_hz;
                let distance = Quantity::of(motion_m);
                velocity = filter.step(&mut state, Vector::of([motion_m; 3]), distance, 1);
            }
            let [x, y, z] = velocity.world.values();
            for (y, cutoff_hz) in [
                (x, cutoff_hz),
                (y, cutoff_hz),
                (z, cutoff_hz),
                (velocity.outward.value(), normal_cutoff_hz),
            ] {
                let delay_s = (1999.0 - y) / rate_hz;
                let stated_s = core::f32::consts::SQRT_2 / (core::f32::consts::TAU * cutoff_hz);
                assert!((delay_s - stated_s).abs() < 2e-4, "{delay_s} {stated_s}");
            }
        }
    }
}

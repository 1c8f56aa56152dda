//! The speed of an impact, from the distances before it.
//!
//! The normal distance is watched over the last eight ticks; the impact speed is minus its
//! least-squares slope when the surface is entered. From 2 kHz on, each of the eight entries lasts
//! 2, 4, 8 or 16 ticks. So they span 4 ms or more, and counts of position matter no more than at
//! 1 kHz. The newest entry may be incomplete, and the slope is corrected for that.

use crate::{
    arithmetic::{Arithmetic, Float},
    config::TapConfig,
    quantity::{
        Four, Quantity, Raw,
        unit::{Count, Hertz, Metre, MetrePerSecond},
    },
};

/// Entries of the ring: the distances that give the impact speed.
pub const WINDOW: usize = 8;
/// Parts of an entry, so that a position in the ring is a byte.
const PARTS: u8 = (256 / WINDOW) as u8;
/// An entry of more than one tick lasts at least this long, s.
const PLACE_S: f32 = 1e-3;
/// The slope a tick is Σ (2i − 7)·dᵢ over this number, since Σ (i − 3.5)² over eight samples is 42.
const SPREAD: f32 = 84.0;

/// Impact criteria, prepared for a servo rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Detector<A: Arithmetic = Float> {
    rate: Quantity<A, Hertz>,
    /// Parts of an entry that a tick takes.
    step: u8,
    /// Slowest impact that plays a transient, m/s.
    pub(super) min_speed: Quantity<A, MetrePerSecond>,
    /// Distance that re-arms the detector, m.
    pub(super) rearm: Quantity<A, Metre>,
}

/// Index in the ring of the distance of an age.
#[inline]
pub(super) const fn place(newest: u8, age: usize) -> usize {
    ((newest / PARTS) as usize + age) % WINDOW
}

impl<A: Arithmetic> Detector<A> {
    /// The detector of a configuration.
    #[must_use]
    pub fn new(config: &TapConfig, servo_rate_hz: f32) -> Self {
        let (mut step, mut ticks) = (PARTS, 2.0);
        while step > 2 && ticks <= servo_rate_hz * PLACE_S {
            step /= 2;
            ticks *= 2.0;
        }
        Self {
            rate: Quantity::of(servo_rate_hz * (1.0 / SPREAD)),
            step,
            min_speed: Quantity::of(config.min_speed_m_s),
            rearm: Quantity::of(config.rearm_m),
        }
    }

    /// The position of the newest distance, a tick after it was `newest`.
    #[inline(always)]
    pub(super) const fn advance(&self, newest: u8) -> u8 {
        newest.wrapping_sub(self.step)
    }

    /// Impact speed, m/s: minus the least-squares slope of the last eight distances.
    #[inline(never)]
    pub(super) fn approach_speed(
        &self,
        distances: &[Raw<A, Metre>; WINDOW],
        newest: u8,
    ) -> Quantity<A, MetrePerSecond> {
        let age = |i: usize| distances[place(newest, i)];
        // Age 0 is the newest, so a falling distance gives a positive slope.
        let newer = Four::<A, Metre>::load(&[age(0), age(1), age(2), age(3)]);
        let older = Four::<A, Metre>::load(&[age(4), age(5), age(6), age(7)]);
        let before = Four::<A, Count>::whole([-7, -5, -3, -1]);
        let after = Four::<A, Count>::whole([1, 3, 5, 7]);
        let twice_slope = (newer * before + older * after).sum();
        let speed = twice_slope * self.rate;
        // Where only a part s of the newest entry has passed, the slope of a constant speed is
        // (11 + s)/12 of that speed.
        let passed = i32::from(PARTS - newest % PARTS);
        let places_a_tick = Quantity::<A, Count>::whole(12 * i32::from(self.step));
        speed * places_a_tick.over(Quantity::<A, Count>::whole(11 * i32::from(PARTS) + passed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Config;

    /// An approach in counts of 0.055 mm, wherever between them it begins: as exact at 10 kHz as
    /// at 1 kHz, and a smooth one exact.
    #[test]
    fn the_impact_speed_does_not_get_worse_with_the_rate() {
        let worst = |rate_hz: f32, counts_m: f32| {
            let speeds = (0..200).map(|n| (0.1 + 0.002 * n as f32, 1.7e-6 * n as f32));
            let errors = speeds.map(|(speed, offset)| {
                let detector = Detector::<Float>::new(&Config::default().tap, rate_hz);
                let (mut distances, mut newest) = ([5e-3; WINDOW], 0);
                let mut n = 0;
                loop {
                    let exact = 5e-3 + offset - speed * n as f32 / rate_hz;
                    let counted = if counts_m > 0.0 {
                        ((exact / counts_m + 1000.5) as i32 - 1000) as f32 * counts_m
                    } else {
                        exact
                    };
                    newest = detector.advance(newest);
                    distances[place(newest, 0)] = counted;
                    n += 1;
                    if counted < 0.0 {
                        let found = detector.approach_speed(&distances, newest).value();
                        break (found / speed - 1.0).abs();
                    }
                }
            });
            errors.fold(0.0, crate::math::max)
        };
        for rate_hz in [1000.0, 2000.0, 3000.0, 5000.0, 10_000.0, 20_000.0] {
            let smooth = worst(rate_hz, 0.0);
            assert!(smooth < 1e-3, "{rate_hz}: {smooth}");
        }
        let own = worst(1000.0, 0.055e-3);
        for rate_hz in [5000.0, 10_000.0] {
            let counted = worst(rate_hz, 0.055e-3);
            assert!(counted < 2.0 * own, "{rate_hz}: {counted}, {own} at 1 kHz");
        }
    }
}

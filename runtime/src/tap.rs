//! Taps: impact detection and the transient that follows.
//!
//! The normal distance is watched over the last eight ticks; its least-squares slope
//! when the surface is entered is the impact speed. The transient is the linear
//! interpolation of the two traces nearest in impact speed (the paper's a_tap(t)).
//! Below the slowest trace it shrinks with the speed, above the fastest it stays.
//! After an impact the detector waits until the stylus is `rearm_m` away.

use crate::{
    Flags,
    lanes::F4,
    math::clamp_from_zero,
    resample::{Rates, Resampler},
};
use asperity_formats::{Taps, limits::MAX_TAPS};
use heapless::Vec;

/// Ticks of normal motion that give the impact speed.
pub const WINDOW_TICKS: usize = 8;

/// The tap bank at the servo rate, `K` samples in all.
#[derive(Debug, Clone)]
pub struct TapBank<const K: usize> {
    ticks: usize,
    /// Impact speed of each trace, ascending.
    speeds_m_s: Vec<f32, MAX_TAPS>,
    samples_m_s2: [f32; K],
}

impl<const K: usize> TapBank<K> {
    pub(crate) const EMPTY: Self = Self {
        ticks: 0,
        speeds_m_s: Vec::new(),
        samples_m_s2: [0.0; K],
    };

    /// Samples needed at the servo rate.
    pub(crate) fn needed(taps: &Taps<'_>, servo_rate_hz: f32) -> usize {
        let rates = Rates::new(taps.sample_rate_hz(), servo_rate_hz);
        rates.ticks(taps.samples()) * taps.traces().len()
    }

    /// Converts every trace to the servo rate; [`TapBank::needed`] is at most `K`.
    pub(crate) fn load(&mut self, taps: &Taps<'_>, servo_rate_hz: f32) {
        let rates = Rates::new(taps.sample_rate_hz(), servo_rate_hz);
        let ticks = rates.ticks(taps.samples());
        let resampler = Resampler::new(rates, taps.samples());
        self.speeds_m_s.clear();
        let places = self.samples_m_s2.chunks_exact_mut(max_one(ticks));
        for (trace, place) in taps.traces().zip(places) {
            // A format has at most `MAX_TAPS` traces, so there is room.
            if self.speeds_m_s.push(trace.speed_m_s).is_ok() {
                resampler.convert(trace.accel_m_s2(), place);
            }
        }
        self.ticks = ticks;
    }

    /// Length of a transient in ticks.
    #[must_use]
    pub const fn ticks(&self) -> usize {
        self.ticks
    }

    /// Which two traces, and in which proportion, an impact speed plays.
    #[must_use]
    pub fn select(&self, impact_speed_m_s: f32) -> Selection {
        let Some(&slowest) = self.speeds_m_s.first() else {
            return Selection::SILENT;
        };
        // The last trace that is not faster; every trace is compared with.
        let (mut first, mut low) = (0, slowest);
        for (index, &speed) in self.speeds_m_s.iter().enumerate() {
            let reached = speed <= impact_speed_m_s;
            first = if reached { index } else { first };
            low = if reached { speed } else { low };
        }
        let (second, high) = match self.speeds_m_s.get(first + 1) {
            Some(&speed) => (first + 1, speed),
            None => (first, f32::INFINITY),
        };
        let share = clamp_from_zero((impact_speed_m_s - low) / (high - low), 1.0);
        Selection {
            first: first as u8,
            second: second as u8,
            first_weight: (1.0 - share) * clamp_from_zero(impact_speed_m_s / low, 1.0),
            second_weight: share,
        }
    }

    /// Acceleration of a transient at `tick`, m/s²; 0 beyond its end.
    #[inline]
    #[must_use]
    pub fn accel_m_s2(&self, selection: &Selection, tick: usize) -> f32 {
        let at = |trace: u8| {
            let inside = tick < self.ticks;
            let index = usize::from(trace) * self.ticks + if inside { tick } else { 0 };
            let a = self.samples_m_s2.get(index).copied().unwrap_or(0.0);
            if inside { a } else { 0.0 }
        };
        selection.first_weight * at(selection.first)
            + selection.second_weight * at(selection.second)
    }
}

const fn max_one(n: usize) -> usize {
    if n == 0 { 1 } else { n }
}

/// Two traces and their weights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Selection {
    /// Index of the slower trace.
    pub first: u8,
    /// Index of the faster one.
    pub second: u8,
    /// Weight of the slower.
    pub first_weight: f32,
    /// Weight of the faster.
    pub second_weight: f32,
}

impl Selection {
    /// No trace at all.
    const SILENT: Self = Self {
        first: 0,
        second: 0,
        first_weight: 0.0,
        second_weight: 0.0,
    };
}

/// The impact detector and the transient under way.
#[derive(Debug, Clone, PartialEq)]
pub struct TapState {
    /// Signed distances in a ring, m.
    distances_m: [f32; WINDOW_TICKS],
    /// Where the newest stands; the older ones follow.
    newest: u8,
    armed: bool,
    /// Next tick of the transient; at its length or above when none plays.
    tick: u32,
    selection: Selection,
}

/// What a tick of the tap stage gives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TapOutput {
    /// Acceleration along the normal, m/s².
    pub accel_m_s2: f32,
    /// Whether a transient started in this tick, and whether one is under way.
    pub flags: Flags,
}

impl TapState {
    /// No contact seen yet: the first one is no impact.
    pub const IDLE: Self = Self {
        distances_m: [0.0; WINDOW_TICKS],
        newest: 0,
        armed: false,
        tick: u32::MAX,
        selection: Selection::SILENT,
    };

    /// Starts over at `distance_m`; a first sample inside is no impact.
    pub fn restart(&mut self, distance_m: f32) {
        *self = Self::IDLE;
        self.distances_m = [distance_m; WINDOW_TICKS];
    }

    /// Another surface, from which the last position was `distance_m` away: the slope stays,
    /// and a transient plays on. A surface that was already entered is no impact.
    pub(crate) fn cross(&mut self, distance_m: f32) {
        let moved_m = distance_m - self.distances_m[usize::from(self.newest) % WINDOW_TICKS];
        for past in &mut self.distances_m {
            *past += moved_m;
        }
        self.armed = self.armed && distance_m > 0.0;
    }

    /// Impact speed, m/s: minus the least-squares slope of the last eight distances.
    #[inline]
    fn approach_speed_m_s(&self, servo_rate_hz: f32) -> f32 {
        // Σ (i − 3.5)² over eight samples.
        const SPREAD: f32 = 42.0;
        let age = |i: usize| self.distances_m[(usize::from(self.newest) + i) % WINDOW_TICKS];
        // Age 0 is the newest, so a falling distance gives a positive slope.
        let newer = F4::load(&[age(0), age(1), age(2), age(3)]);
        let older = F4::load(&[age(4), age(5), age(6), age(7)]);
        let products =
            newer * F4::load(&[-3.5, -2.5, -1.5, -0.5]) + older * F4::load(&[0.5, 1.5, 2.5, 3.5]);
        products.sum() * (servo_rate_hz * (1.0 / SPREAD))
    }

    /// One tick at `distance_m` from the surface (negative inside).
    #[inline]
    pub fn step<const K: usize>(
        &mut self,
        bank: &TapBank<K>,
        distance_m: f32,
        servo_rate_hz: f32,
        config: &crate::TapConfig,
    ) -> TapOutput {
        self.newest = self.newest.wrapping_sub(1) % WINDOW_TICKS as u8;
        self.distances_m[usize::from(self.newest) % WINDOW_TICKS] = distance_m;
        let touching = distance_m < 0.0;
        let mut flags = Flags::NONE;
        if touching {
            if self.armed {
                let speed_m_s = self.approach_speed_m_s(servo_rate_hz);
                if speed_m_s >= config.min_speed_m_s {
                    self.selection = bank.select(speed_m_s);
                    self.tick = 0;
                    flags = Flags::TAP_STARTED;
                }
            }
            self.armed = false;
        } else if distance_m > config.rearm_m {
            self.armed = true;
        }
        let mut accel_m_s2 = 0.0;
        if (self.tick as usize) < bank.ticks() {
            flags = flags.and(Flags::TAP_ACTIVE);
            accel_m_s2 = bank.accel_m_s2(&self.selection, self.tick as usize);
            self.tick += 1;
        }
        TapOutput { accel_m_s2, flags }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    fn bank() -> TapBank<8> {
        let mut bank = TapBank::EMPTY;
        bank.ticks = 2;
        bank.speeds_m_s.extend([0.1, 0.2, 0.4]);
        bank.samples_m_s2[..6].copy_from_slice(&[1.0, 0.0, 2.0, 0.0, 4.0, 0.0]);
        bank
    }

    /// The bank above is linear in speed, so its interpolation is.
    #[test]
    fn a_transient_is_linear_in_speed_from_zero_to_the_fastest_trace() {
        let bank = bank();
        for (speed, peak) in [
            (0.0, 0.0),
            (0.05, 0.5),
            (0.1, 1.0),
            (0.15, 1.5),
            (0.2, 2.0),
            (0.3, 3.0),
            (0.4, 4.0),
            (9.0, 4.0),
            (-1.0, 0.0),
        ] {
            let accel = bank.accel_m_s2(&bank.select(speed), 0);
            assert!((accel - peak).abs() < 1e-6, "{speed}: {accel}");
        }
        assert_eq!(bank.accel_m_s2(&bank.select(0.4), 2), 0.0);
    }

    #[test]
    fn an_impact_rearms_only_at_a_distance() {
        let (bank, config) = (bank(), crate::Config::default().tap);
        let mut state = TapState::IDLE;
        state.restart(0.01);
        let mut starts = std::vec::Vec::new();
        // Down at 0.2 m/s, a bounce of 0.3 mm, then up by 3 mm and down again.
        let heights = (0..60)
            .map(|n| 6e-3 - 0.2e-3 * n as f32)
            .take(40)
            .chain([0.3e-3; 10])
            .chain([-0.3e-3; 10])
            .chain((0..40).map(|n| 3e-3 - 0.1e-3 * n as f32));
        for (n, height) in heights.enumerate() {
            let output = state.step(&bank, height, 1000.0, &config);
            if output.flags.contains(Flags::TAP_STARTED) {
                starts.push((n, state.selection));
            }
        }
        assert_eq!(starts.len(), 2, "{starts:?}");
        assert_eq!(starts[0].0, 31);
        // The trace of 0.2 m/s alone, within the rounding of eight heights.
        assert!(starts[0].1.first == 1 && starts[0].1.first_weight > 0.999);
    }
}

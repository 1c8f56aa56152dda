//! Taps: impact detection and the transient that follows.
//!
//! The normal distance is watched over the last eight ticks; its least-squares slope
//! when the surface is entered is the impact speed. From 2 kHz on a place of the eight lasts 2,
//! 4, 8 or 16 ticks, so that they span 4 ms or more and counts of position weigh no more than at
//! 1 kHz; the newest place may have begun just now, which the slope allows for. The transient is the linear
//! interpolation of the two traces nearest in impact speed (the paper's a_tap(t)).
//! Below the slowest trace it shrinks with the speed, above the fastest it stays.
//! After an impact the detector waits until the stylus is `rearm_m` away.

use crate::{
    Flags,
    arithmetic::{
        Arithmetic, Float, Four, Number, Scalar, Zero as _,
        units::{Hertz, Metre, MetrePerSecond, Ratio, TapAcceleration, Unit},
    },
    lanes::F4,
    resample::{Lanes, Rates, Resampler},
};
use asperity_formats::{Taps, limits::MAX_TAPS, taps::side_by_side};
use heapless::Vec;

/// Places of normal motion that give the impact speed.
pub const WINDOW_TICKS: usize = 8;
/// Parts of a place: the ring's position is a byte.
const PARTS: u8 = (256 / WINDOW_TICKS) as u8;
/// A place lasts at least this long, s, where it is more than one tick.
const PLACE_S: f32 = 1e-3;

/// The tap bank at the servo rate, `K` samples in all.
#[derive(Debug, Clone)]
pub struct TapBank<const K: usize, A: Arithmetic = Float> {
    ticks: usize,
    /// Impact speed of each trace, ascending.
    speeds_m_s: Vec<Number<A, MetrePerSecond>, MAX_TAPS>,
    samples_m_s2: [A::Scalar<TapAcceleration>; K],
}

impl<const K: usize, A: Arithmetic> TapBank<K, A> {
    pub(crate) const EMPTY: Self = Self {
        ticks: 0,
        speeds_m_s: Vec::new(),
        samples_m_s2: [A::Scalar::ZERO; K],
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
        // A format has at most `MAX_TAPS` traces, so there is room.
        let speeds = taps.traces().map(|trace| Number::of(trace.speed_m_s));
        self.speeds_m_s = speeds.take(MAX_TAPS).collect();
        let room = ticks * self.speeds_m_s.len();
        let out = self.samples_m_s2.get_mut(..room).unwrap_or_default();
        if F4::IN_REGISTERS {
            convert::<_, F4, 4>(taps, rates, out);
        } else {
            convert::<_, f32, 1>(taps, rates, out);
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
    pub fn select(&self, impact_speed_m_s: A::Scalar<MetrePerSecond>) -> Selection<A> {
        let impact_speed_m_s = Number(impact_speed_m_s);
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
            None => (first, low),
        };
        let whole = Number::<A, Unit>::whole(1);
        // The fastest trace alone has no way to go.
        let share = if high > low {
            let share: Number<A, Unit> = (impact_speed_m_s - low).over(high - low);
            share.clamp_from_zero(whole)
        } else {
            Number::ZERO
        };
        let shrunk: Number<A, Unit> = impact_speed_m_s.over(low);
        let first_weight = (whole - share).times::<Unit, Unit>(shrunk.clamp_from_zero(whole));
        Selection {
            traces: [first as u8, second as u8],
            weights: [first_weight.0, share.0],
        }
    }

    /// Acceleration of a transient at `tick`, m/s²; 0 beyond its end.
    #[inline]
    #[must_use]
    pub fn accel_m_s2(&self, selection: &Selection<A>, tick: usize) -> A::Scalar<TapAcceleration> {
        let at = |trace: u8| {
            let inside = tick < self.ticks;
            let index = usize::from(trace) * self.ticks + if inside { tick } else { 0 };
            let a = self.samples_m_s2.get(index).copied();
            let a = a.filter(|_| inside).unwrap_or(A::Scalar::ZERO);
            Number::<A, TapAcceleration>(a)
        };
        let weight = Number::<A, Unit>;
        let [slower, faster] = selection.traces.map(at);
        let first = weight(selection.weights[0]).times(slower);
        let second = weight(selection.weights[1]).times(faster);
        (first + second).0
    }
}

/// Every trace, one after the other, `N` side by side.
fn convert<S: Scalar, L: Lanes<N>, const N: usize>(taps: &Taps<'_>, rates: Rates, out: &mut [S]) {
    let mut traces = taps.traces();
    let readers = core::iter::from_fn(|| {
        // A lane without a trace repeats one.
        let mut lanes = [traces.next()?; N];
        for (lane, trace) in lanes.iter_mut().skip(1).zip(traces.by_ref()) {
            *lane = trace;
        }
        Some(move |first| side_by_side(&lanes, first))
    });
    Resampler::<L, N>::new(rates, taps.samples()).convert(readers, out);
}

/// Two traces and their weights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Selection<A: Arithmetic = Float> {
    /// Indices of the slower trace and of the faster one.
    pub traces: [u8; 2],
    /// Their weights.
    pub weights: [A::Scalar<Unit>; 2],
}

impl<A: Arithmetic> Selection<A> {
    /// No trace at all.
    const SILENT: Self = Self {
        traces: [0; 2],
        weights: [A::Scalar::ZERO; 2],
    };
}

/// Twice the slope of the last distances per tick, to m/s: Σ (i − 3.5)² over eight samples is 42.
const SPREAD: f32 = 84.0;
/// Nothing hits faster, m/s, where numbers have a range.
const FASTEST_M_S: f32 = 100.0;

/// What counts as an impact, prepared for a servo rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Detector<A: Arithmetic = Float> {
    rate_hz: Number<A, Hertz>,
    /// Parts of a place that a tick takes.
    step: u8,
    min_speed_m_s: Number<A, MetrePerSecond>,
    rearm_m: Number<A, Metre>,
}

impl<A: Arithmetic> Detector<A> {
    /// Of a configuration.
    #[must_use]
    pub fn new(config: &crate::TapConfig, servo_rate_hz: f32) -> Self {
        let (mut step, mut ticks) = (PARTS, 2.0);
        while step > 2 && ticks <= servo_rate_hz * PLACE_S {
            step /= 2;
            ticks *= 2.0;
        }
        Self {
            rate_hz: Number::of(servo_rate_hz * (1.0 / SPREAD)),
            step,
            min_speed_m_s: Number::of(config.min_speed_m_s),
            rearm_m: Number::of(config.rearm_m),
        }
    }
}

/// The impact detector and the transient under way.
#[derive(Debug, Clone, PartialEq)]
pub struct TapState<A: Arithmetic = Float> {
    /// Signed distances in a ring, m.
    distances_m: [A::Scalar<Metre>; WINDOW_TICKS],
    /// Where the newest stands, in parts of a place; the older ones follow.
    newest: u8,
    armed: bool,
    /// Next tick of the transient; at its length or above when none plays.
    tick: u32,
    // What it plays: a [`Selection`], without its padding.
    traces: [u8; 2],
    weights: [A::Scalar<Unit>; 2],
}

/// What a tick of the tap stage gives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TapOutput<A: Arithmetic = Float> {
    /// Acceleration along the normal, m/s².
    pub accel_m_s2: A::Scalar<TapAcceleration>,
    /// Whether a transient started in this tick, and whether one is under way.
    pub flags: Flags,
}

impl<A: Arithmetic> TapState<A> {
    /// No contact seen yet: the first one is no impact.
    pub const IDLE: Self = Self {
        distances_m: [A::Scalar::ZERO; WINDOW_TICKS],
        newest: 0,
        armed: false,
        tick: u32::MAX,
        traces: [0; 2],
        weights: [A::Scalar::ZERO; 2],
    };

    /// Starts over at `distance_m`; a first sample inside is no impact.
    pub fn restart(&mut self, distance_m: A::Scalar<Metre>) {
        *self = Self::IDLE;
        self.distances_m = [distance_m; WINDOW_TICKS];
    }

    /// Another surface, from which the last position was `distance_m` away: the slope stays,
    /// and a transient plays on. A surface that was already entered is no impact.
    pub(crate) fn cross(&mut self, distance_m: A::Scalar<Metre>) {
        let moved_m = distance_m - self.distances_m[self.place(0)];
        for past in &mut self.distances_m {
            *past = A::plus_within(*past, moved_m);
        }
        // Motion is counted from here: without rounding.
        self.distances_m[self.place(0)] = distance_m;
        self.armed = self.armed && distance_m > A::Scalar::ZERO;
    }

    /// The last distance, m.
    #[inline(always)]
    pub(crate) fn distance_m(&self) -> Number<A, Metre> {
        Number(self.distances_m[self.place(0)])
    }

    /// Where the distance of an age stands.
    #[inline]
    const fn place(&self, age: usize) -> usize {
        ((self.newest / PARTS) as usize + age) % WINDOW_TICKS
    }

    /// Impact speed, m/s: minus the least-squares slope of the last eight distances.
    #[inline(never)]
    fn approach_speed_m_s(&self, detector: &Detector<A>) -> Number<A, MetrePerSecond> {
        let age = |i: usize| self.distances_m[self.place(i)];
        // Age 0 is the newest, so a falling distance gives a positive slope.
        let newer = Four::<A, Metre>::load(&[age(0), age(1), age(2), age(3)]);
        let older = Four::<A, Metre>::load(&[age(4), age(5), age(6), age(7)]);
        let before = Four::<A, Ratio>::whole([-7, -5, -3, -1]);
        let after = Four::<A, Ratio>::whole([1, 3, 5, 7]);
        // Twice the slope, m, with the room of speeds.
        let slope: Four<A, MetrePerSecond> = newer.times(before) + older.times(after);
        let speed_m_s: Number<A, MetrePerSecond> =
            slope.sum().times_within(detector.rate_hz, FASTEST_M_S);
        // Where only a share s of the newest place has passed, a constant speed gives a slope of
        // (11 + s)/12 of it.
        let passed = i32::from(PARTS - self.newest % PARTS);
        let places_a_tick = Number::<A, Ratio>::whole(12 * i32::from(detector.step));
        let share: Number<A, Ratio> =
            places_a_tick.over(Number::<A, Ratio>::whole(11 * i32::from(PARTS) + passed));
        speed_m_s.times(share)
    }

    /// One tick at `distance_m` from the surface (negative inside).
    #[inline]
    pub fn step<const K: usize>(
        &mut self,
        bank: &TapBank<K, A>,
        distance_m: A::Scalar<Metre>,
        detector: &Detector<A>,
    ) -> TapOutput<A> {
        self.newest = self.newest.wrapping_sub(detector.step);
        self.distances_m[self.place(0)] = distance_m;
        let touching = distance_m < A::Scalar::ZERO;
        let mut flags = Flags::NONE;
        if touching {
            if self.armed {
                let speed_m_s = self.approach_speed_m_s(detector);
                if speed_m_s >= detector.min_speed_m_s {
                    let selection = bank.select(speed_m_s.0);
                    self.traces = selection.traces;
                    self.weights = selection.weights;
                    self.tick = 0;
                    flags = Flags::TAP_STARTED;
                }
            }
            self.armed = false;
        } else if distance_m > detector.rearm_m.0 {
            self.armed = true;
        }
        let mut accel_m_s2 = A::Scalar::ZERO;
        if (self.tick as usize) < bank.ticks() {
            flags = flags.and(Flags::TAP_ACTIVE);
            let selection = Selection {
                traces: self.traces,
                weights: self.weights,
            };
            accel_m_s2 = bank.accel_m_s2(&selection, self.tick as usize);
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
        bank.speeds_m_s.extend([0.1, 0.2, 0.4].map(Number));
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

    /// An approach in counts of 0.055 mm, wherever between them it begins: as exact at 10 kHz as
    /// at 1 kHz, and a smooth one exact.
    #[test]
    fn the_impact_speed_does_not_get_worse_with_the_rate() {
        let worst = |rate_hz: f32, counts_m: f32| {
            let speeds = (0..200).map(|n| (0.1 + 0.002 * n as f32, 1.7e-6 * n as f32));
            let errors = speeds.map(|(speed, offset)| {
                let detector = Detector::<Float>::new(&crate::Config::default().tap, rate_hz);
                let mut state = TapState::IDLE;
                state.restart(5e-3);
                let mut n = 0;
                loop {
                    let exact = 5e-3 + offset - speed * n as f32 / rate_hz;
                    let counted = if counts_m > 0.0 {
                        ((exact / counts_m + 1000.5) as i32 - 1000) as f32 * counts_m
                    } else {
                        exact
                    };
                    state.newest = state.newest.wrapping_sub(detector.step);
                    state.distances_m[state.place(0)] = counted;
                    n += 1;
                    if counted < 0.0 {
                        break (state.approach_speed_m_s(&detector).0 / speed - 1.0).abs();
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

    #[test]
    fn an_impact_rearms_only_at_a_distance() {
        let bank = bank();
        let detector = Detector::new(&crate::Config::default().tap, 1000.0);
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
            let output = state.step(&bank, height, &detector);
            if output.flags.contains(Flags::TAP_STARTED) {
                starts.push((n, state.traces[0], state.weights[0]));
            }
        }
        assert_eq!(starts.len(), 2, "{starts:?}");
        assert_eq!(starts[0].0, 31);
        // The trace of 0.2 m/s alone, within the rounding of eight heights.
        assert!(starts[0].1 == 1 && starts[0].2 > 0.999);
    }
}

//! The transient of an impact: two traces, mixed by its speed.
//!
//! a_tap(t) is the linear interpolation of the two traces nearest in impact speed, as in the paper.
//! Below the slowest trace the transient shrinks with the speed; above the fastest it stays the
//! same.

use super::resample::{Lanes, Rates, Resampler, Rows};
use crate::{
    arithmetic::{Arithmetic, Float, Scalar, Zero as _},
    capacity::{Capacity, HostCapacities},
    lanes::F4,
    quantity::{
        Quantity, Raw,
        unit::{Fraction, MetrePerSecond, TapAcceleration},
    },
};
use asperity_formats::{Taps, limits::MAX_TAPS, taps::side_by_side};
use heapless::Vec;

/// The tap bank at the servo rate.
#[derive(Debug, Clone)]
pub struct TapBank<S: Capacity = HostCapacities, A: Arithmetic = Float> {
    ticks: usize,
    /// Impact speed of each trace, ascending.
    speeds: Vec<Quantity<A, MetrePerSecond>, MAX_TAPS>,
    samples: S::TapSamples<Raw<A, TapAcceleration>>,
}

impl<S: Capacity, A: Arithmetic> TapBank<S, A> {
    pub(crate) const EMPTY: Self = Self {
        ticks: 0,
        speeds: Vec::new(),
        samples: S::TapSamples::ZERO,
    };

    /// Samples needed at the servo rate.
    pub(crate) fn needed(taps: &Taps<'_>, servo_rate_hz: f32) -> usize {
        let rates = Rates::new(taps.sample_rate_hz(), servo_rate_hz);
        rates.ticks(taps.samples()) * taps.traces().len()
    }

    /// Converts every trace to the servo rate; [`TapBank::needed`] is at most the capacity.
    pub(crate) fn load(&mut self, taps: &Taps<'_>, servo_rate_hz: f32) {
        let rates = Rates::new(taps.sample_rate_hz(), servo_rate_hz);
        let ticks = rates.ticks(taps.samples());
        // A format has at most `MAX_TAPS` traces, so there is room.
        let speeds = taps.traces().map(|trace| Quantity::of(trace.speed_m_s));
        self.speeds.clear();
        self.speeds.extend(speeds.take(MAX_TAPS));
        let room = ticks * self.speeds.len();
        let out = self.samples.as_mut().get_mut(..room).unwrap_or_default();
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

    /// The two traces that an impact speed plays, and their weights.
    #[must_use]
    pub fn select(&self, impact_speed: Quantity<A, MetrePerSecond>) -> Selection<A> {
        let Some(&slowest) = self.speeds.first() else {
            return Selection::SILENT;
        };
        // The last trace that is not faster. The loop always compares with every trace.
        let (mut first, mut low) = (0, slowest);
        for (index, &speed) in self.speeds.iter().enumerate() {
            let reached = speed <= impact_speed;
            first = if reached { index } else { first };
            low = if reached { speed } else { low };
        }
        let (second, high) = match self.speeds.get(first + 1) {
            Some(&speed) => (first + 1, speed),
            None => (first, low),
        };
        let whole = Quantity::<A, Fraction>::whole(1);
        // Beyond the fastest trace there is no other to go to.
        let fraction = if high > low {
            (impact_speed - low).over(high - low).clamp_from_zero(whole)
        } else {
            Quantity::ZERO
        };
        let shrunk = impact_speed.over(low).clamp_from_zero(whole);
        Selection {
            traces: [first as u8, second as u8],
            weights: [(whole - fraction) * shrunk, fraction],
        }
    }

    /// Acceleration of a transient at `tick`, m/s²; 0 beyond its end.
    #[inline]
    #[must_use]
    pub fn acceleration(
        &self,
        selection: &Selection<A>,
        tick: usize,
    ) -> Quantity<A, TapAcceleration> {
        let at = |trace: u8| {
            let inside = tick < self.ticks;
            let index = usize::from(trace) * self.ticks + if inside { tick } else { 0 };
            let a = self.samples.as_ref().get(index).copied();
            Quantity(a.filter(|_| inside).unwrap_or(A::Scalar::ZERO))
        };
        let [slower, faster] = selection.traces.map(at);
        let [first, second] = selection.weights;
        first * slower + second * faster
    }
}

/// Two traces and their weights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Selection<A: Arithmetic = Float> {
    /// Indices of the slower trace and of the faster one.
    pub traces: [u8; 2],
    /// Their weights.
    pub weights: [Quantity<A, Fraction>; 2],
}

impl<A: Arithmetic> Selection<A> {
    /// No trace at all.
    const SILENT: Self = Self {
        traces: [0; 2],
        weights: [Quantity::ZERO; 2],
    };
}

/// Every trace, one after the other, `N` side by side.
fn convert<S: Scalar, L: Lanes<N>, const N: usize>(taps: &Taps<'_>, rates: Rates, out: &mut [S]) {
    let resampler = Resampler::new(rates, taps.samples());
    let mut traces = taps.traces();
    let mut missing = [0.0; MAX_TAPS];
    let rows = out.chunks_mut(N * resampler.ticks().max(1));
    for (out, missing) in rows.zip(missing.as_chunks_mut().0) {
        // There is room for as many traces as there are.
        let Some(first) = traces.next() else { break };
        // A lane without a trace repeats one.
        let mut lanes = [first; N];
        for (lane, trace) in lanes.iter_mut().skip(1).zip(traces.by_ref()) {
            *lane = trace;
        }
        let read = |first, rows: &mut Rows<N>| side_by_side(&lanes, first, rows);
        *missing = resampler.convert::<S, L, N>(read, out);
    }
    resampler.complete(&missing, out);
}

/// Three traces of two ticks, linear in speed.
#[cfg(test)]
pub(super) fn bank() -> TapBank<crate::capacity::Capacities<0, 0, 0, 0, 8>> {
    let mut bank = TapBank::<crate::capacity::Capacities<0, 0, 0, 0, 8>>::EMPTY;
    bank.ticks = 2;
    bank.speeds.extend([0.1, 0.2, 0.4].map(Quantity));
    bank.samples.as_mut()[..6].copy_from_slice(&[1.0, 0.0, 2.0, 0.0, 4.0, 0.0]);
    bank
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bank is linear in speed, so its interpolation is.
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
            let accel = bank.acceleration(&bank.select(Quantity(speed)), 0).value();
            assert!((accel - peak).abs() < 1e-6, "{speed}: {accel}");
        }
        assert_eq!(
            bank.acceleration(&bank.select(Quantity(0.4)), 2).value(),
            0.0
        );
    }
}

//! Taps at the servo rate. Each sample of a trace excites an analog Chebyshev II low-pass of
//! order 7 with an impulse, and the response is sampled. The stop band begins at half the lower
//! of both rates, 50 dB down.

use asperity_formats::Taps;
use std::f64::consts::PI;

type Complex = (f64, f64);

fn multiply(a: Complex, b: Complex) -> Complex {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

fn divide(a: Complex, b: Complex) -> Complex {
    let square = b.0 * b.0 + b.1 * b.1;
    let product = multiply(a, (b.0, -b.1));
    (product.0 / square, product.1 / square)
}

/// Poles and residues of the prototype with unit gain at 0 and its stop edge at 1 rad/s.
fn prototype() -> Vec<(Complex, Complex)> {
    let (order, stop_db) = (7, 50.0);
    let ripple = 1.0 / (10.0_f64.powf(stop_db / 10.0) - 1.0).sqrt();
    let mu = (1.0 / ripple).asinh() / f64::from(order);
    let angle = |k: i32| PI * f64::from(2 * k - 1) / f64::from(2 * order);
    let poles: Vec<Complex> = (1..=order)
        .map(|k| {
            divide(
                (1.0, 0.0),
                (-mu.sinh() * angle(k).sin(), mu.cosh() * angle(k).cos()),
            )
        })
        .collect();
    // The middle zero of an odd order lies at infinity.
    let zeros: Vec<Complex> = (1..=order)
        .filter(|&k| 2 * k - 1 != order)
        .map(|k| (0.0, 1.0 / angle(k).cos()))
        .collect();
    let difference = |a: Complex, b: Complex| (a.0 - b.0, a.1 - b.1);
    let at = |s: Complex, without: Option<usize>| {
        let top = zeros
            .iter()
            .fold((1.0, 0.0), |p, &z| multiply(p, difference(s, z)));
        let bottom = (0..poles.len())
            .filter(|&i| Some(i) != without)
            .fold((1.0, 0.0), |p, i| multiply(p, difference(s, poles[i])));
        divide(top, bottom)
    };
    let at_zero = at((0.0, 0.0), None);
    (0..poles.len())
        .map(|i| (poles[i], divide(at(poles[i], Some(i)), at_zero)))
        .collect()
}

/// Response of the low-pass to a unit impulse after `age_s`, 1/s.
pub fn impulse_response(lower_rate_hz: f64) -> impl Fn(f64) -> f64 {
    let (parts, stop) = (prototype(), PI * lower_rate_hz);
    move |age_s| {
        let term = |(pole, residue): &(Complex, Complex)| {
            let x = age_s * stop;
            let (size, turn) = ((pole.0 * x).exp(), pole.1 * x);
            size * (residue.0 * turn.cos() - residue.1 * turn.sin())
        };
        stop * parts.iter().map(term).sum::<f64>()
    }
}

/// The tap bank at the servo rate.
#[derive(Debug, Clone)]
pub struct Bank {
    /// Impact speeds, m/s, ascending.
    pub speeds_m_s: Vec<f64>,
    /// Accelerations at the servo rate, m/s².
    pub traces_m_s2: Vec<Vec<f64>>,
}

impl Bank {
    /// Converts the taps of an asset.
    #[must_use]
    pub fn new(taps: &Taps<'_>, servo_hz: f64) -> Self {
        let source_hz = f64::from(taps.sample_rate_hz());
        let convert = |trace: Vec<f64>| {
            if source_hz == servo_hz {
                return trace;
            }
            let lower = source_hz.min(servo_hz);
            let response = impulse_response(lower);
            let span = (trace.len() - 1) as f64 * servo_hz / source_hz;
            let ticks = (span + 16.0 * servo_hz / lower) as usize + 1;
            let filtered = |n: usize| -> f64 {
                let age = |i: usize| n as f64 / servo_hz - i as f64 / source_hz;
                (0..trace.len())
                    .filter(|&i| age(i) > -1e-9)
                    .map(|i| trace[i] / source_hz * response(age(i).max(0.0)))
                    .sum()
            };
            let mut out: Vec<f64> = (0..ticks).map(filtered).collect();
            // The missing part of the impulse is given back along the response.
            let wanted = trace.iter().sum::<f64>() / source_hz * servo_hz;
            let missing = wanted - out.iter().sum::<f64>();
            let shape: Vec<f64> = (0..ticks).map(|n| response(n as f64 / servo_hz)).collect();
            let share = missing / shape.iter().sum::<f64>();
            for (out, shape) in out.iter_mut().zip(&shape) {
                *out += share * shape;
            }
            out
        };
        Self {
            speeds_m_s: taps.traces().map(|t| t.speed_m_s.into()).collect(),
            traces_m_s2: taps
                .traces()
                .map(|t| convert(t.accel_m_s2().map(f64::from).collect()))
                .collect(),
        }
    }

    /// The transient of an impact: interpolated linearly between the two nearest traces. Below
    /// the slowest it is scaled in proportion to the speed; above the fastest it is the fastest.
    #[must_use]
    pub fn transient(&self, speed_m_s: f64) -> Vec<f64> {
        let Some(last) = self.speeds_m_s.len().checked_sub(1) else {
            return vec![];
        };
        let scaled =
            |trace: usize, by: f64| self.traces_m_s2[trace].iter().map(|a| a * by).collect();
        if speed_m_s <= self.speeds_m_s[0] {
            return scaled(0, speed_m_s / self.speeds_m_s[0]);
        }
        if speed_m_s >= self.speeds_m_s[last] {
            return scaled(last, 1.0);
        }
        let above = self.speeds_m_s.partition_point(|&s| s <= speed_m_s);
        let (low, high) = (self.speeds_m_s[above - 1], self.speeds_m_s[above]);
        let share = (speed_m_s - low) / (high - low);
        let (slow, fast) = (&self.traces_m_s2[above - 1], &self.traces_m_s2[above]);
        slow.iter()
            .zip(fast)
            .map(|(a, b)| a + share * (b - a))
            .collect()
    }
}

//! The free oscillation after a tap: frequency and Q by least squares.
//!
//! The signal is e^(−ω0 t/2Q)·(a cos ωd t + b sin ωd t) with ωd = ω0·√(1 − 1/4Q²), on a parabola, which is
//! the hand. The linear parts are eliminated (variable projection; Golub and Pereyra, 1973), which
//! leaves a search over frequency and Q. Under white noise this is the likeliest oscillation.

use crate::{
    channel::Channel,
    signal::resample::{Clock, resample},
};
use std::f64::consts::TAU;

/// Rate at which rings are fitted, Hz, at most.
const RATE_HZ: f64 = 6000.0;
/// Lowest frequency, Hz: three periods in a ring. The highest as a part of the rate.
const BAND: (f64, f64) = (75.0, 0.4);
/// Bounds of Q.
const Q: (f64, f64) = (1.5, 300.0);
/// Grid of the search: ratio of neighbouring frequencies, and values of Q.
const RATIO: f64 = 1.012;
const QS: [f64; 7] = [2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0];
/// Halvings of the step that refine it.
const HALVINGS: usize = 14;
/// The finger is gone so long after the peak, s: the first one after which the fit is good.
const GONE_S: [f64; 4] = [0.0025, 0.004, 0.006, 0.009];
const GOOD: f64 = 0.97;
/// Length of a ring that is fitted, s. A tap is no longer in free air after it.
const LENGTH_S: f64 = 0.04;
/// The peak is looked for within so much of the tap, s.
const AROUND_S: f64 = 0.006;
/// The sensor's noise is taken from before the tap, s.
const NOISE_S: (f64, f64) = (0.045, 0.007);
/// Least part of the energy that a ring explains, over its length and after its first period.
const EXPLAINED: (f64, f64) = (0.8, 0.6);
/// A ring begins this many times above the noise, and is above it by this in its second period.
const OVER_NOISE: (f64, f64) = (10.0, 2.0);

/// A free oscillation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ring {
    /// ω0/2π, Hz.
    pub(super) freq_hz: f64,
    pub(super) q: f64,
    /// When it begins to be fitted, m/s².
    pub(super) amplitude_m_s2: f64,
}

/// The oscillation of an axis after a tap; `None` where the evidence speaks against one.
pub(super) fn after(channel: &Channel, late_s: f64, tap_s: f64) -> Option<Ring> {
    let own = Clock {
        start_s: channel.clock.start_s - late_s,
        ..channel.clock
    };
    let rate_hz = own.rate_hz.min(RATE_HZ);
    let stretch = |start_s: f64, seconds: f64| {
        let clock = Clock { start_s, rate_hz };
        resample(&channel.samples, own, clock, (seconds * rate_hz) as usize)
    };
    let before = stretch(tap_s - NOISE_S.0, NOISE_S.0 - NOISE_S.1);
    let noise = rms(&Parabola::new(before.len()).without(&before));
    let around = stretch(tap_s - AROUND_S, 2.0 * AROUND_S);
    let middle = before.iter().sum::<f64>() / before.len().max(1) as f64;
    let peak = (0..around.len()).max_by(|a, b| {
        (around[*a] - middle)
            .abs()
            .total_cmp(&(around[*b] - middle).abs())
    })?;
    let peak_s = tap_s - AROUND_S + peak as f64 / rate_hz;
    let mut best: Option<(f64, Ring)> = None;
    for gone_s in GONE_S {
        let Some((explained, ring)) = fit(&stretch(peak_s + gone_s, LENGTH_S), rate_hz, noise)
        else {
            continue;
        };
        if best.is_none_or(|(most, _)| explained > most) {
            best = Some((explained, ring));
        }
        if explained >= GOOD {
            break;
        }
    }
    best.map(|(_, ring)| ring)
}

/// The likeliest oscillation of a stretch and the part of the energy that it explains, if the evidence
/// is for it.
fn fit(stretch: &[f64], rate_hz: f64, noise: f64) -> Option<(f64, Ring)> {
    let parabola = Parabola::new(stretch.len());
    let signal = parabola.without(stretch);
    let energy: f64 = signal.iter().map(|x| x * x).sum();
    let projection =
        |freq_hz: f64, q: f64| Projection::new(&signal, &parabola, rate_hz, freq_hz, q);
    let (lowest_hz, highest_hz) = (BAND.0, BAND.1 * rate_hz);
    let steps = (libm::log(highest_hz / lowest_hz) / libm::log(RATIO)) as usize;
    let frequencies = (0..=steps).map(|n| lowest_hz * libm::pow(RATIO, n as f64));
    let mut best = (0.0, lowest_hz, QS[0]);
    for freq_hz in frequencies {
        for q in QS {
            let explained = projection(freq_hz, q).energy;
            if explained > best.0 {
                best = (explained, freq_hz, q);
            }
        }
    }
    let (mut by_hz, mut by_q) = (RATIO, 1.5);
    for _ in 0..HALVINGS {
        // Until no neighbour is better, and no longer than a search could need.
        for _ in 0..8 {
            let (_, freq_hz, q) = best;
            let before = best.0;
            for (freq_hz, q) in [
                (freq_hz * by_hz, q),
                (freq_hz / by_hz, q),
                (freq_hz, q * by_q),
                (freq_hz, q / by_q),
            ] {
                let is_inside =
                    (lowest_hz..=highest_hz).contains(&freq_hz) && (Q.0..=Q.1).contains(&q);
                let explained = if is_inside {
                    projection(freq_hz, q).energy
                } else {
                    0.0
                };
                if explained > best.0 {
                    best = (explained, freq_hz, q);
                }
            }
            if best.0 <= before {
                break;
            }
        }
        (by_hz, by_q) = (by_hz.sqrt(), by_q.sqrt());
    }
    let (explained, freq_hz, q) = best;
    let found = projection(freq_hz, q);
    // A pulse that is not over explains its beginning, and leaves nothing after a period.
    let period = (rate_hz / freq_hz).ceil() as usize;
    let tail = |signal: &[f64]| -> f64 { signal.iter().skip(period).map(|x| x * x).sum() };
    let rest: Vec<f64> = signal.iter().zip(&found.ring).map(|(x, y)| x - y).collect();
    let second = found.ring.get(period..(2 * period).min(found.ring.len()))?;
    let share = explained / energy.max(1e-300);
    let is_there = share >= EXPLAINED.0
        && tail(&rest) <= (1.0 - EXPLAINED.1) * tail(&signal)
        && found.amplitude >= OVER_NOISE.0 * noise
        && rms(second) >= OVER_NOISE.1 * noise
        && q > 1.001 * Q.0
        && freq_hz > 1.01 * lowest_hz
        && freq_hz < highest_hz / 1.01;
    is_there.then_some((
        share,
        Ring {
            freq_hz,
            q,
            amplitude_m_s2: found.amplitude,
        },
    ))
}

/// The oscillation of a frequency and Q that is nearest to a signal.
struct Projection {
    energy: f64,
    amplitude: f64,
    ring: Vec<f64>,
}

impl Projection {
    fn new(signal: &[f64], parabola: &Parabola, rate_hz: f64, freq_hz: f64, q: f64) -> Self {
        let omega = TAU * freq_hz / rate_hz;
        let decay = libm::exp(-0.5 * omega / q);
        let (sin, cos) = libm::sincos(omega * (1.0 - 0.25 / (q * q)).max(0.0).sqrt());
        let (mut re, mut im) = (1.0, 0.0);
        let (mut even, mut odd) = (
            Vec::with_capacity(signal.len()),
            Vec::with_capacity(signal.len()),
        );
        for _ in signal {
            even.push(re);
            odd.push(im);
            (re, im) = (decay * (re * cos - im * sin), decay * (re * sin + im * cos));
        }
        let (even, odd) = (parabola.without(&even), parabola.without(&odd));
        let (ee, oo, eo) = (
            product(&even, &even),
            product(&odd, &odd),
            product(&even, &odd),
        );
        let (es, os) = (product(&even, signal), product(&odd, signal));
        let determinant = ee * oo - eo * eo;
        if determinant <= 1e-9 * ee * oo {
            return Self {
                energy: 0.0,
                amplitude: 0.0,
                ring: vec![0.0; signal.len()],
            };
        }
        let a = (oo * es - eo * os) / determinant;
        let b = (ee * os - eo * es) / determinant;
        Self {
            energy: a * es + b * os,
            amplitude: libm::hypot(a, b),
            ring: even.iter().zip(&odd).map(|(e, o)| a * e + b * o).collect(),
        }
    }
}

/// Orthonormal polynomials of degrees 0 to 2 over a stretch.
struct Parabola([Vec<f64>; 3]);

impl Parabola {
    fn new(length: usize) -> Self {
        let place = |n: usize| 2.0 * (n as f64 + 0.5) / length.max(1) as f64 - 1.0;
        let mut basis: [Vec<f64>; 3] = [0, 1, 2].map(|degree| {
            (0..length)
                .map(|n| libm::pow(place(n), f64::from(degree)))
                .collect()
        });
        for degree in 0..3 {
            let (lower, rest) = basis.split_at_mut(degree);
            let Some(this) = rest.first_mut() else {
                continue;
            };
            for other in lower {
                let part = product(this, other);
                this.iter_mut()
                    .zip(other)
                    .for_each(|(x, y)| *x -= part * *y);
            }
            let size = product(this, this).sqrt().max(1e-300);
            this.iter_mut().for_each(|x| *x /= size);
        }
        Self(basis)
    }

    /// A signal without its parabola.
    fn without(&self, signal: &[f64]) -> Vec<f64> {
        let parts = [0, 1, 2].map(|degree| product(signal, &self.0[degree]));
        signal
            .iter()
            .enumerate()
            .map(|(n, x)| {
                x - (0..3)
                    .map(|degree| parts[degree] * self.0[degree][n])
                    .sum::<f64>()
            })
            .collect()
    }
}

fn product(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(a, b)| a * b).sum()
}

fn rms(signal: &[f64]) -> f64 {
    (product(signal, signal) / signal.len().max(1) as f64).sqrt()
}

#[cfg(test)]
#[path = "ring_tests.rs"]
mod laws;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::noise::white;
    use std::f64::consts::PI;

    const HZ: f64 = 5000.0;
    const NOISE: f64 = 0.04;

    /// An oscillation on a hand that moves, under noise.
    fn stretch(freq_hz: f64, q: f64, amplitude: f64) -> Vec<f64> {
        let noise = white(5, (LENGTH_S * HZ) as usize, 12);
        noise
            .into_iter()
            .enumerate()
            .map(|(n, noise)| {
                let t_s = n as f64 / HZ;
                let decay = libm::exp(-PI * freq_hz * t_s / q);
                let turn = TAU * freq_hz * t_s * (1.0 - 0.25 / (q * q)).sqrt();
                amplitude * decay * libm::sin(turn + 0.4)
                    + 3.0 * libm::sin(30.0 * t_s)
                    + NOISE * noise
            })
            .collect()
    }

    #[test]
    fn frequency_and_q_come_back_within_one_and_five_percent() {
        for freq_hz in [80.0, 150.0, 300.0, 700.0, 1500.0] {
            for q in [3.0, 8.0, 30.0] {
                let (_, ring) = fit(&stretch(freq_hz, q, 20.0), HZ, NOISE).expect("a ring");
                assert!(
                    (ring.freq_hz / freq_hz - 1.0).abs() < 0.01,
                    "{freq_hz} {q}: {ring:?}"
                );
                assert!((ring.q / q - 1.0).abs() < 0.05, "{freq_hz} {q}: {ring:?}");
            }
        }
    }

    #[test]
    fn noise_hands_and_pulses_are_no_ring() {
        assert_eq!(fit(&stretch(300.0, 8.0, 0.1), HZ, NOISE), None);
        // What is left of a finger that is slow to go, by its time after the peak.
        for half_s in [0.002, 0.004, 0.008, 0.02] {
            let tail: Vec<f64> = stretch(300.0, 8.0, 0.0)
                .into_iter()
                .enumerate()
                .map(|(n, x)| {
                    let t_s = n as f64 / HZ;
                    let pulse = if t_s < half_s {
                        libm::cos(0.5 * PI * t_s / half_s)
                    } else {
                        0.0
                    };
                    x + 20.0 * pulse
                })
                .collect();
            assert_eq!(fit(&tail, HZ, NOISE), None, "{half_s}");
        }
    }
}

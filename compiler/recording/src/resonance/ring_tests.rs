//! The parts of a fit, each against what it must do.

use super::*;
use crate::{
    description::{Axis, Quantity},
    signal::noise::white,
    test_recordings::{self, near},
};
use std::f64::consts::PI;

#[test]
fn a_parabola_and_nothing_else_is_taken_away() {
    let parabola = Parabola::new(50);
    for a in 0..3 {
        for b in 0..3 {
            let expected = if a == b { 1.0 } else { 0.0 };
            near(product(&parabola.0[a], &parabola.0[b]), expected, 1e-12);
        }
    }
    let curve: Vec<f64> = (0..50)
        .map(|n| 3.0 - 0.7 * f64::from(n) + 0.02 * f64::from(n * n))
        .collect();
    assert!(parabola.without(&curve).iter().all(|x| x.abs() < 1e-9));
    let noise = white(1, 50, 1);
    let rest = parabola.without(&noise);
    for basis in &parabola.0 {
        near(product(&rest, basis), 0.0, 1e-12);
    }
    for (again, once) in parabola.without(&rest).iter().zip(&rest) {
        near(*again, *once, 1e-12);
    }
    near(rms(&[3.0, -4.0, 0.0, 0.0]), 2.5, 1e-12);
    assert_eq!(rms(&[]), 0.0);
}

/// e^(−ω₀t/2Q)·(a cos ω_d t + b sin ω_d t).
fn oscillation(freq_hz: f64, q: f64, (a, b): (f64, f64), rate_hz: f64, count: usize) -> Vec<f64> {
    let omega = TAU * freq_hz / rate_hz;
    let damped = omega * (1.0 - 1.0 / (4.0 * q * q)).sqrt();
    (0..count)
        .map(|n| {
            let n = n as f64;
            libm::exp(-omega * n / (2.0 * q))
                * (a * libm::cos(damped * n) + b * libm::sin(damped * n))
        })
        .collect()
}

#[test]
fn an_oscillation_is_its_own_projection() {
    for (freq_hz, q) in [(120.0, 2.0), (300.0, 8.0), (900.0, 40.0)] {
        let parabola = Parabola::new(200);
        let signal = parabola.without(&oscillation(freq_hz, q, (3.0, -4.0), 5000.0, 200));
        let found = Projection::new(&signal, &parabola, 5000.0, freq_hz, q);
        let energy = product(&signal, &signal);
        near(found.energy, energy, 1e-9 * energy);
        near(found.amplitude, 5.0, 1e-9);
        for (a, b) in found.ring.iter().zip(&signal) {
            near(*a, *b, 1e-9);
        }
        // Another one explains less, and what is left is at right angles to it.
        let other = Projection::new(&signal, &parabola, 5000.0, 1.2 * freq_hz, q);
        assert!(other.energy < 0.98 * energy);
        near(
            other.energy,
            product(&other.ring, &other.ring),
            1e-9 * energy,
        );
        let rest: Vec<f64> = signal.iter().zip(&other.ring).map(|(x, y)| x - y).collect();
        near(product(&rest, &other.ring), 0.0, 1e-9 * energy);
    }
    let silent = Projection::new(&[1.0, 2.0], &Parabola::new(2), 5000.0, 300.0, 8.0);
    assert_eq!((silent.energy, silent.amplitude), (0.0, 0.0));
}

#[test]
fn a_ring_without_noise_is_found_to_a_thousandth() {
    for (freq_hz, q) in [(90.0, 4.0), (333.0, 9.0), (1234.0, 30.0), (1900.0, 12.0)] {
        let (share, ring) = fit(
            &oscillation(freq_hz, q, (2.0, 1.0), 5000.0, 200),
            5000.0,
            0.0,
        )
        .expect("a ring");
        near(ring.freq_hz / freq_hz, 1.0, 1e-3);
        near(ring.q / q, 1.0, 1e-2);
        near(ring.amplitude_m_s2, 5.0_f64.sqrt(), 0.02);
        near(share, 1.0, 1e-4);
    }
}

#[test]
fn a_ring_stands_ten_times_above_the_noise_and_twice_in_its_second_period() {
    let of = |q: f64, noise: f64| {
        fit(
            &oscillation(400.0, q, (1.0, 0.0), 5000.0, 200),
            5000.0,
            noise,
        )
    };
    assert!(of(20.0, 0.099).is_some() && of(20.0, 0.101).is_none());
    // In its second period, e^(−π·1.5/2) of 1/√2 or so: half of 0.067.
    assert!(of(2.0, 0.025).is_some() && of(2.0, 0.05).is_none());
    // Below 75 Hz, above 0.4 of the rate, damped too much, or never: none.
    for (freq_hz, q) in [(70.0, 8.0), (2050.0, 30.0), (300.0, 1.2)] {
        assert_eq!(
            fit(
                &oscillation(freq_hz, q, (1.0, 0.0), 5000.0, 200),
                5000.0,
                0.0
            ),
            None,
            "{freq_hz}"
        );
    }
}

#[test]
fn a_ring_explains_four_fifths_of_the_energy() {
    let noise = white(2, 200, 12);
    let of = |part: f64| {
        let ring = oscillation(400.0, 30.0, (1.0, 0.0), 5000.0, 200);
        let size = rms(&ring) / rms(&noise) * (part / (1.0 - part)).sqrt();
        let signal: Vec<f64> = ring.iter().zip(&noise).map(|(r, n)| r + size * n).collect();
        fit(&signal, 5000.0, 0.0).map(|(share, _)| share)
    };
    assert!(of(0.12).is_some_and(|share| share > 0.8));
    assert_eq!(of(0.3), None);
}

#[test]
fn a_tap_is_followed_on_the_clock_of_its_channel() {
    let hit_s = 1.0;
    let noise = white(3, 16_000, 12);
    let values: Vec<f64> = (0..16_000)
        .map(|n| {
            let t_s = n as f64 / 8000.0 - hit_s;
            let ring = if t_s < 0.0 {
                0.0
            } else {
                20.0 * libm::exp(-PI * 350.0 * t_s / 12.0) * libm::sin(TAU * 350.0 * t_s)
            };
            9.81 + ring + 0.01 * noise[n]
        })
        .collect();
    let mut channel = test_recordings::channel(Quantity::Acceleration, Axis::Z, 8000.0, &values);
    channel.clock.start_s = 3.0;
    for late_s in [0.0, 0.02] {
        let ring = after(&channel, late_s, 4.0 - late_s).expect("a ring");
        near(ring.freq_hz, 350.0, 2.0);
        near(ring.q, 12.0, 0.3);
        // 2.5 ms after the peak, which comes a quarter of a period after the hit.
        let t_s = 0.0025 + 0.25 / 350.0;
        near(
            ring.amplitude_m_s2,
            20.0 * libm::exp(-PI * 350.0 * t_s / 12.0),
            0.7,
        );
    }
    // A tap that comes 7 ms or more beside the peak misses it.
    assert!(after(&channel, 0.0, 3.5).is_none());
}

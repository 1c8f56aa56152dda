//! Power and autocorrelation against their definitions.

use super::*;
use crate::{signal::noise::white, test_recordings::near};

#[test]
fn a_window_of_hann_is_the_square_of_a_sine_between_the_samples() {
    for length in [1, 4, 9] {
        for (n, w) in hann(length).into_iter().enumerate() {
            near(
                w,
                libm::sin(PI * (n as f64 + 0.5) / length as f64).powi(2),
                1e-12,
            );
        }
    }
}

#[test]
fn a_periodogram_is_the_squared_transform_over_the_energy_of_the_window() {
    let (signal, window) = (white(1, 50, 1), hann(50));
    let omegas = [0.0, 0.1, 1.0, 2.5, PI];
    for (omega, found) in omegas.iter().zip(periodogram(&signal, &window, &omegas)) {
        let (mut re, mut im, mut energy) = (0.0, 0.0, 0.0);
        for n in 0..50 {
            re += signal[n] * window[n] * libm::cos(omega * n as f64);
            im += signal[n] * window[n] * libm::sin(omega * n as f64);
            energy += window[n] * window[n];
        }
        near(found, (re * re + im * im) / energy, 1e-9);
    }
}

#[test]
fn an_autocorrelation_is_divided_by_that_of_its_window() {
    let found = autocorrelation(&[1.0, 2.0, 3.0], &[1.0, 1.0, 2.0], 3);
    // 1, 2, 6 over 1, 1, 2: 41/6, 14/3, 6/2, and nothing beyond.
    for (r, expected) in found.iter().zip([41.0 / 6.0, 14.0 / 3.0, 3.0, 0.0]) {
        near(*r, expected, 1e-12);
    }
    assert_eq!(found.len(), 4);
}

#[test]
fn frequencies_go_in_equal_steps_and_no_higher_than_half_the_rate() {
    let hz = |rate, from, to, count| -> Vec<f64> {
        omegas(rate, from, to, count)
            .iter()
            .map(|w| w * rate / TAU)
            .collect()
    };
    for (found, expected) in hz(1000.0, 20.0, 50.0, 4)
        .iter()
        .zip([20.0, 30.0, 40.0, 50.0])
    {
        near(*found, expected, 1e-9);
    }
    near(hz(400.0, 100.0, 300.0, 3)[2], 200.0, 1e-9);
    near(hz(400.0, 100.0, 300.0, 3)[1], 200.0, 1e-9);
    near(hz(400.0, 100.0, 300.0, 1)[0], 100.0, 1e-9);
    assert!(hz(400.0, 100.0, 300.0, 0).is_empty());
}

//! Filters against their definitions.

use super::*;
use crate::{signal::noise::white, test_recordings::near};
use std::f64::consts::PI;

/// I₀ by its integral, the mean of e^(x cos θ).
fn bessel(x: f64) -> f64 {
    let at = |n: u32| libm::exp(x * libm::cos(PI * (f64::from(n) + 0.5) / 400.0));
    (0..400).map(at).sum::<f64>() / 400.0
}

#[test]
fn the_answer_to_an_impulse_is_a_sinc_under_kaisers_window() {
    let (cut_off, half) = (0.07, 10);
    let mut impulse = vec![0.0; 41];
    impulse[20] = 1.0;
    let tap = |k: usize| {
        let turn = 2.0 * PI * cut_off * k as f64;
        let sinc = if k == 0 { 1.0 } else { libm::sin(turn) / turn };
        sinc * bessel(8.0 * (1.0 - (k as f64 / 11.0).powi(2)).sqrt()) / bessel(8.0)
    };
    let sum = tap(0) + 2.0 * (1..=half).map(tap).sum::<f64>();
    for (n, y) in low_pass(&impulse, cut_off, half).into_iter().enumerate() {
        let away = n.abs_diff(20);
        let expected = if away > half { 0.0 } else { tap(away) / sum };
        near(y, expected, 1e-12);
    }
}

#[test]
fn at_the_ends_a_signal_goes_on_at_its_last_value() {
    for (count, half) in [(25, 10), (5, 10), (1, 4), (21, 10), (20, 10)] {
        let signal = white(1, count, 1);
        let mut padded = vec![signal[0]; half];
        padded.extend(&signal);
        padded.extend(vec![signal[count - 1]; half]);
        let whole = low_pass(&padded, 0.1, half);
        let found = low_pass(&signal, 0.1, half);
        for n in 0..count {
            near(found[n], whole[n + half], 1e-12);
        }
        assert_eq!(found.len(), count);
    }
    assert!(low_pass(&[], 0.1, 5).is_empty());
}

#[test]
fn high_and_low_make_the_whole_and_a_band_lies_between() {
    let signal = white(2, 300, 1);
    let low = low_pass(&signal, 0.05, 40);
    let high = high_pass(&signal, 0.05, 40);
    for n in 0..300 {
        near(low[n] + high[n], signal[n], 1e-12);
    }
    let tone = |f: f64| -> Vec<f64> {
        (0..2000)
            .map(|n| libm::cos(2.0 * PI * f * f64::from(n)))
            .collect()
    };
    let passed = |f: f64| band_pass(&tone(f), (0.05, 0.15), 100)[1000];
    near(passed(0.0), 0.0, 1e-9);
    near(passed(0.1), 1.0, 1e-3);
    near(passed(0.02), 0.0, 1e-3);
    near(passed(0.2), 0.0, 1e-3);
}

#[test]
fn a_derivative_is_central_within_and_one_sided_at_the_ends() {
    assert_eq!(
        derivative(&[0.0, 1.0, 4.0, 9.0, 25.0]),
        [1.0, 2.0, 4.0, 10.5, 16.0]
    );
    assert_eq!(derivative(&[3.0, 5.0]), [2.0, 2.0]);
    assert!(derivative(&[]).is_empty());
}

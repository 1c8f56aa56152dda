//! Energy that a law of friction gives off over periodic motion.

use std::f64::consts::TAU;

use super::law::{Law, TICK_S};
use crate::stability::observer::{Absorber, Observer};

/// Fastest stroke, m/s, and largest acceleration, m/s², that a hand can make. A force of 8.5 N
/// accelerates stylus and light grip by 100 m/s².
const POSSIBLE: (f64, f64) = (0.65, 100.0);
/// Amplitudes, m, from inside the dead zone to far beyond slip.
const AMPLITUDES_M: [f64; 16] = [
    1.0e-4, 1.2e-4, 1.3e-4, 1.5e-4, 1.8e-4, 2.2e-4, 3e-4, 4e-4, 5e-4, 7e-4, 1e-3, 1.5e-3, 2e-3,
    3e-3, 5e-3, 1e-2,
];

/// Largest energy that a law gives off beyond what the device absorbs, J, at any time.
///
/// The motion is a sinusoid of each frequency with every amplitude that a hand can make. It is
/// pressed steadily, or harder at one phase.
#[must_use]
pub fn energy_of_cycles(
    law: impl Fn() -> Law,
    delay_ticks: usize,
    frequencies_hz: &[f64],
    absorber: &Absorber,
) -> f64 {
    let mut worst = 0.0_f64;
    for &frequency_hz in frequencies_hz {
        let turn = TAU * frequency_hz;
        let possible = |a: f64| a * turn <= POSSIBLE.0 && a * turn * turn <= POSSIBLE.1;
        for amplitude_m in AMPLITUDES_M.into_iter().filter(|&a| possible(a)) {
            for (press, phase) in [(0.0, 0.0), (0.4, 0.0), (0.4, 0.25), (0.4, 0.5), (0.4, 0.75)] {
                let ticks = (4.0 / (frequency_hz * TICK_S)).round() as usize;
                let at = |n: usize| n as f64 * TICK_S;
                let x = |n: usize| amplitude_m * (turn * at(n)).sin();
                let mut law = law();
                let force: Vec<f64> = (0..=ticks)
                    .map(|n| law(x(n), 0.6 + press * (turn * at(n) + TAU * phase).cos()))
                    .collect();
                let mut observer = Observer::default();
                for n in delay_ticks..ticks {
                    observer.tick(absorber, force[n - delay_ticks], x(n + 1) - x(n), TICK_S);
                }
                worst = worst.max(observer.worst_j);
            }
        }
    }
    worst
}

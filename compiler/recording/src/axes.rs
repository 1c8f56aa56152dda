//! Three axes of acceleration as one that keeps their spectrum.
//!
//! People do not feel from where a vibration comes. DFT321 (Landin, Romano, McMahan, Kuchenbecker,
//! "Dimensional reduction of high-frequency accelerations for haptic rendering", 2010) adds the
//! energies of the axes at every frequency, with the phase of their sum. The principal component is
//! one direction, and loses what lies across it.
//!
//! ```
//! use asperity_recording::axes::dft321;
//!
//! // A tone along x and another along y.
//! let tone = |cycles: f64| -> Vec<f64> {
//!     (0..256).map(|n| (std::f64::consts::TAU * cycles * f64::from(n) / 256.0).sin()).collect()
//! };
//! let axes = [tone(10.0), tone(25.0)];
//! let energy = |signal: &[f64]| signal.iter().map(|x| x * x).sum::<f64>();
//! let both = energy(&axes[0]) + energy(&axes[1]);
//! assert!((energy(&dft321(&axes)) - both).abs() < 1e-6 * both);
//! ```

use realfft::{RealFftPlanner, num_complex::Complex};

/// One signal whose power at every frequency is the sum of the powers of the axes.
#[must_use]
pub fn dft321(axes: &[Vec<f64>]) -> Vec<f64> {
    match axes {
        [] => return Vec::new(),
        [one] => return one.clone(),
        _ => {}
    }
    let length = axes.iter().map(Vec::len).min().unwrap_or(0);
    let mut planner = RealFftPlanner::<f64>::new();
    let (forward, inverse) = (
        planner.plan_fft_forward(length),
        planner.plan_fft_inverse(length),
    );
    let mut energy = vec![0.0; length / 2 + 1];
    let mut sum = vec![Complex::<f64>::default(); length / 2 + 1];
    for axis in axes {
        let mut signal = axis[..length].to_vec();
        let mut spectrum = forward.make_output_vec();
        // Lengths are those of the plan, so it cannot fail.
        if forward.process(&mut signal, &mut spectrum).is_err() {
            return axes[0].clone();
        }
        for ((energy, sum), x) in energy.iter_mut().zip(&mut sum).zip(&spectrum) {
            *energy += x.norm_sqr();
            *sum += x;
        }
    }
    let mut spectrum: Vec<Complex<f64>> = energy
        .iter()
        .zip(&sum)
        .map(|(energy, sum)| match sum.norm() {
            size if size > 0.0 => sum * (energy.sqrt() / size),
            _ => Complex::new(energy.sqrt(), 0.0),
        })
        .collect();
    // At both ends the spectrum of a real signal is real.
    let ends = if length % 2 == 0 {
        vec![0, length / 2]
    } else {
        vec![0]
    };
    for end in ends {
        if let Some(x) = spectrum.get_mut(end) {
            *x = Complex::new(libm::copysign(x.norm(), x.re), 0.0);
        }
    }
    let mut signal = inverse.make_output_vec();
    if inverse.process(&mut spectrum, &mut signal).is_err() {
        return axes[0].clone();
    }
    signal.into_iter().map(|x| x / length as f64).collect()
}

/// The component along the direction of most variance, and the part of the variance that it holds.
#[must_use]
pub fn principal(axes: &[Vec<f64>]) -> (Vec<f64>, f64) {
    let length = axes.iter().map(Vec::len).min().unwrap_or(0);
    let product = |i: usize, j: usize| -> f64 {
        axes[i][..length]
            .iter()
            .zip(&axes[j])
            .map(|(x, y)| x * y)
            .sum()
    };
    let count = axes.len();
    let covariance: Vec<Vec<f64>> = (0..count)
        .map(|i| (0..count).map(|j| product(i, j)).collect())
        .collect();
    let total: f64 = (0..count).map(|i| covariance[i][i]).sum();
    let mut direction: Vec<f64> = (0..count)
        .map(|i| covariance[i][i].sqrt() + 1e-12)
        .collect();
    // The power iteration. Where two directions hold equal power, any of them will do.
    for _ in 0..200 {
        let next: Vec<f64> = covariance
            .iter()
            .map(|row| row.iter().zip(&direction).map(|(a, b)| a * b).sum())
            .collect();
        let largest = next.iter().map(|x| x * x).sum::<f64>().sqrt();
        if largest <= 0.0 {
            break;
        }
        direction = next.into_iter().map(|x| x / largest).collect();
    }
    let signal: Vec<f64> = (0..length)
        .map(|n| {
            axes.iter()
                .zip(&direction)
                .map(|(axis, d)| axis[n] * d)
                .sum()
        })
        .collect();
    let kept: f64 = signal.iter().map(|x| x * x).sum();
    (signal, if total > 0.0 { kept / total } else { 1.0 })
}

#[cfg(test)]
#[path = "axes_tests.rs"]
mod laws;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::noise::white;

    fn noise(seed: u64, count: usize) -> Vec<f64> {
        white(seed, count, 4)
    }

    fn power(signal: &[f64]) -> f64 {
        signal.iter().map(|x| x * x).sum()
    }

    #[test]
    fn dft321_keeps_the_energy_of_all_axes_and_the_principal_component_does_not() {
        let axes: Vec<Vec<f64>> = (1..=3).map(|seed| noise(seed, 20_000)).collect();
        let all: f64 = axes.iter().map(|axis| power(axis)).sum();
        assert!((power(&dft321(&axes)) / all - 1.0).abs() < 1e-9);
        let (_, share) = principal(&axes);
        assert!(share < 0.4);
    }

    #[test]
    fn one_direction_is_its_own_principal_component() {
        let source = noise(7, 5000);
        let axes: Vec<Vec<f64>> = [0.6, 0.0, 0.8]
            .iter()
            .map(|d| source.iter().map(|x| d * x).collect())
            .collect();
        let (found, share) = principal(&axes);
        assert!((share - 1.0).abs() < 1e-9);
        assert!(found.iter().zip(&source).all(|(a, b)| (a - b).abs() < 1e-9));
        let combined = dft321(&axes);
        assert!(
            combined
                .iter()
                .zip(&source)
                .all(|(a, b)| (a.abs() - b.abs()).abs() < 1e-9)
        );
    }
}

//! One signal of several axes, frequency by frequency.

use super::*;
use crate::{signal::noise::white, test_recordings::near};
use std::f64::consts::TAU;

fn transformed(signal: &[f64], bin: usize) -> Complex<f64> {
    let turn = |n: usize| TAU * (bin * n) as f64 / signal.len() as f64;
    let term = |(n, x): (usize, &f64)| Complex::from_polar(*x, -turn(n));
    signal.iter().enumerate().map(term).sum()
}

#[test]
fn every_frequency_has_the_power_of_all_axes_and_the_phase_of_their_sum() {
    for length in [8, 9, 30] {
        let axes: Vec<Vec<f64>> = (1..=3).map(|seed| white(seed, length, 1)).collect();
        let one = dft321(&axes);
        assert_eq!(one.len(), length);
        for bin in 0..=length / 2 {
            let of: Vec<Complex<f64>> = axes.iter().map(|a| transformed(a, bin)).collect();
            let power: f64 = of.iter().map(Complex::norm_sqr).sum();
            let sum: Complex<f64> = of.iter().sum();
            let found = transformed(&one, bin);
            let expected = sum * (power.sqrt() / sum.norm());
            assert!((found - expected).norm() < 1e-9, "{length} {bin}");
        }
    }
}

#[test]
fn axes_that_cancel_keep_their_power() {
    let x = white(4, 32, 1);
    let against: Vec<f64> = x.iter().map(|x| -x).collect();
    let one = dft321(&[x.clone(), against]);
    for bin in 0..=16 {
        let (found, expected) = (transformed(&one, bin).norm(), transformed(&x, bin).norm());
        near(found, 2.0_f64.sqrt() * expected, 1e-9);
    }
}

#[test]
fn one_axis_is_itself_and_none_is_nothing() {
    assert!(dft321(&[]).is_empty());
    assert_eq!(dft321(&[vec![1.0, -2.0, 5.0]]), [1.0, -2.0, 5.0]);
    assert_eq!(dft321(&[vec![1.0; 9], vec![1.0; 7]]).len(), 7);
}

#[test]
fn the_principal_component_of_two_crossed_signals_is_the_stronger_one() {
    let strong = [3.0, -3.0, 3.0, -3.0];
    let weak = [1.0, 1.0, -1.0, -1.0];
    let mix = |a: f64, b: f64| {
        (0..4)
            .map(|n| a * strong[n] + b * weak[n])
            .collect::<Vec<f64>>()
    };
    let (found, share) = principal(&[mix(0.8, -0.6), mix(0.6, 0.8)]);
    near(share, 0.9, 1e-9);
    for (a, b) in found.iter().zip(&strong) {
        near(*a, *b, 1e-9);
    }
    // Where there is nothing, nothing is lost.
    let (found, share) = principal(&[vec![0.0; 3], vec![0.0; 5]]);
    assert_eq!((found, share), (vec![0.0; 3], 1.0));
    let (found, share) = principal(&[vec![1.0, 2.0, 9.0], vec![0.0, 0.0]]);
    assert_eq!(found.len(), 2);
    near(share, 1.0, 1e-12);
}

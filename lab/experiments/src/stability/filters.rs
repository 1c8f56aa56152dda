//! Filters that rows are tried on.

use std::f64::consts::PI;

use rand_xoshiro::Xoshiro256PlusPlus;

use asperity_sim::random::unit;

/// Random line spectral frequencies of an order, at least `gap` rad apart.
pub(super) fn random_lsf(rng: &mut Xoshiro256PlusPlus, order: usize, gap: f64) -> Vec<f64> {
    // The largest step is up to ten times the smallest.
    let steps: Vec<f64> = (0..=order).map(|_| 0.2 + 1.8 * unit(rng)).collect();
    let room = PI - gap * (order + 1) as f64;
    let total: f64 = steps.iter().sum();
    let mut at = 0.0;
    steps[..order]
        .iter()
        .map(|step| {
            at += gap + room * step / total;
            at
        })
        .collect()
}

/// A filter of order 20 with a pole pair of radius 0.986 at `hz`; its other poles have radius 0.6.
pub(super) fn resonant(hz: f64) -> Vec<f64> {
    let mut monic = vec![1.0];
    let mut pair = |radius: f64, omega: f64| {
        let factor = [1.0, -2.0 * radius * omega.cos(), radius * radius];
        let mut next = vec![0.0; monic.len() + 2];
        for (i, a) in monic.iter().enumerate() {
            for (j, f) in factor.iter().enumerate() {
                next[i + j] += a * f;
            }
        }
        monic = next;
    };
    pair(0.986, PI * hz / 500.0);
    for n in 0..9 {
        pair(0.6, PI * (f64::from(n) + 0.5) / 9.0);
    }
    monic
}

//! All-pole filters given by coefficients, mixed as the paper writes it and run in direct form.

use asperity::{
    model::ModelGrid,
    signal::{lsf, reflection},
};

/// An all-pole filter in direct form. It keeps its past outputs when coefficients change.
#[derive(Debug, Clone, Default)]
pub struct AllPole {
    past: Vec<f64>,
}

impl AllPole {
    /// `y[n] = e[n] − Σ a_k·y[n−k]` with `monic` = [1, a_1, …].
    pub fn step(&mut self, monic: &[f64], e: f64) -> f64 {
        self.past.resize(monic.len() - 1, 0.0);
        let feedback: f64 = monic[1..].iter().zip(&self.past).map(|(a, y)| a * y).sum();
        let y = e - feedback;
        self.past.rotate_right(1);
        if let Some(newest) = self.past.first_mut() {
            *newest = y;
        }
        y
    }
}

/// A(z) of every vertex.
#[must_use]
pub fn polynomials(grid: &ModelGrid) -> Vec<Vec<f64>> {
    grid.vertices
        .iter()
        .map(|vertex| lsf::to_polynomial(&vertex.lsf_rad))
        .collect()
}

/// Σ w_i·A_i(z): the mixture of the paper, y\[n\] = Σ a_k(F_n, v_t)·y\[n−k\] with
/// interpolated a_k.
#[must_use]
pub fn mixed(corners: [&[f64]; 3], weights: [f64; 3]) -> Vec<f64> {
    (0..corners[0].len())
        .map(|k| (0..3).map(|i| weights[i] * corners[i][k]).sum())
        .collect()
}

/// Returns true if a filter is stable: all reflection coefficients are below 1 in magnitude.
#[must_use]
pub fn is_stable(monic: &[f64]) -> bool {
    monic.iter().all(|a| a.is_finite()) && reflection::is_stable(monic)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_impulse_response_of_one_pole_is_geometric() {
        let mut filter = AllPole::default();
        let response: Vec<f64> = (0..4)
            .map(|n| filter.step(&[1.0, -0.5], if n == 0 { 1.0 } else { 0.0 }))
            .collect();
        assert_eq!(response, [1.0, 0.5, 0.25, 0.125]);
    }

    #[test]
    fn mixing_coefficients_of_stable_filters_can_be_unstable() {
        // Triple poles at 0.95 and at −0.95: the mean of the two has a pole outside the circle.
        let cube = |p: f64| vec![1.0, -3.0 * p, 3.0 * p * p, -p * p * p];
        let (a, b) = (cube(0.95), cube(-0.95));
        assert!(is_stable(&a) && is_stable(&b));
        let half = mixed([&a, &b, &b], [0.5, 0.25, 0.25]);
        assert!(!is_stable(&half), "{half:?}");
    }
}

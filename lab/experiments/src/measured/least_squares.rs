//! Nonlinear least squares with a normal prior.

use super::ridge::solve;
use rayon::prelude::*;
use std::array;

/// Step of the forward differences, standard deviations of the prior.
const STEP: f64 = 1e-4;
/// Steps at most.
const MOST_STEPS: usize = 40;
/// Relative fall of the objective that ends the search.
const TOLERANCE: f64 = 1e-7;
/// Damping at the start, and beyond which no step is sought.
const DAMPING: (f64, f64) = (1e-3, 1e6);

/// The point of the least objective `‖r(x)‖² + ‖x‖²`, and the linearisation there.
pub(super) struct Fit<const N: usize> {
    /// The parameters, standard deviations of the prior from its mean.
    pub x: [f64; N],
    /// r(x).
    pub residuals: Vec<f64>,
    /// ∂r/∂x, a row for each residual.
    pub jacobian: Vec<[f64; N]>,
}

/// Minimises from `start` by Levenberg's and Marquardt's method.
pub(super) fn fit<const N: usize>(
    start: [f64; N],
    residuals: impl Fn(&[f64; N]) -> Vec<f64> + Sync,
) -> Fit<N> {
    let (mut damping, most_damping) = DAMPING;
    let mut x = start;
    let mut r = residuals(&x);
    let mut jacobian = jacobian_at(&x, &r, &residuals);
    'search: for _ in 0..MOST_STEPS {
        let before = objective(&x, &r);
        let (normal, gradient) = normal_equations(&x, &r, &jacobian);
        loop {
            let mut damped = normal;
            (0..N).for_each(|i| damped[i][i] *= 1.0 + damping);
            let step = solve(damped, gradient);
            let tried: [f64; N] = array::from_fn(|i| x[i] - step[i]);
            let found = residuals(&tried);
            let after = objective(&tried, &found);
            if after < before {
                (x, r) = (tried, found);
                jacobian = jacobian_at(&x, &r, &residuals);
                damping *= 0.1;
                if before - after < TOLERANCE * before {
                    break 'search;
                }
                continue 'search;
            }
            damping *= 10.0;
            if damping > most_damping {
                break 'search;
            }
        }
    }
    Fit {
        x,
        residuals: r,
        jacobian,
    }
}

impl<const N: usize> Fit<N> {
    /// Standard errors of the parameters, robust to dependence within groups of residuals (Huber's sandwich):
    /// H⁻¹(Σ gᵢgᵢᵀ)H⁻¹ with the gradient gᵢ of a group. `group` has the group of each residual.
    pub(super) fn standard_errors(&self, group: &[usize]) -> [f64; N] {
        let (normal, _) = normal_equations(&self.x, &self.residuals, &self.jacobian);
        let groups = group.iter().max().map_or(0, |last| last + 1);
        let mut gradients = vec![[0.0; N]; groups];
        for ((row, r), &group) in self.jacobian.iter().zip(&self.residuals).zip(group) {
            (0..N).for_each(|i| gradients[group][i] += row[i] * r);
        }
        let mut squares = [0.0; N];
        for gradient in gradients {
            let moved = solve(normal, gradient);
            (0..N).for_each(|i| squares[i] += moved[i] * moved[i]);
        }
        squares.map(f64::sqrt)
    }

    /// Returns each parameter's shift when some residuals are left out, by a single Gauss–Newton step.
    pub(super) fn moved_without(&self, left_out: std::ops::Range<usize>) -> [f64; N] {
        let kept = |n: &usize| !left_out.contains(n);
        let rows: Vec<usize> = (0..self.residuals.len()).filter(kept).collect();
        let jacobian: Vec<[f64; N]> = rows.iter().map(|&n| self.jacobian[n]).collect();
        let residuals: Vec<f64> = rows.iter().map(|&n| self.residuals[n]).collect();
        let (normal, gradient) = normal_equations(&self.x, &residuals, &jacobian);
        solve(normal, gradient).map(f64::abs)
    }
}

fn jacobian_at<const N: usize>(
    x: &[f64; N],
    r: &[f64],
    residuals: &(impl Fn(&[f64; N]) -> Vec<f64> + Sync),
) -> Vec<[f64; N]> {
    let columns: Vec<Vec<f64>> = (0..N)
        .into_par_iter()
        .map(|i| {
            let mut beside = *x;
            beside[i] += STEP;
            residuals(&beside)
        })
        .collect();
    let row = |n: usize| array::from_fn(|i| (columns[i][n] - r[n]) / STEP);
    (0..r.len()).map(row).collect()
}

/// JᵀJ + I and Jᵀr + x.
fn normal_equations<const N: usize>(
    x: &[f64; N],
    residuals: &[f64],
    jacobian: &[[f64; N]],
) -> ([[f64; N]; N], [f64; N]) {
    let mut normal = [[0.0; N]; N];
    let mut gradient = *x;
    for (row, r) in jacobian.iter().zip(residuals) {
        for i in 0..N {
            gradient[i] += row[i] * r;
            (0..N).for_each(|j| normal[i][j] += row[i] * row[j]);
        }
    }
    (0..N).for_each(|i| normal[i][i] += 1.0);
    (normal, gradient)
}

fn objective(x: &[f64], r: &[f64]) -> f64 {
    x.iter().chain(r).map(|v| v * v).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Many exact observations of y = a·exp(b·t).
    fn residuals(x: &[f64; 2]) -> Vec<f64> {
        (0..200)
            .map(|n| f64::from(n % 20) / 20.0)
            .map(|t| 1e3 * (x[0] * (x[1] * t).exp() - 2.0 * (-0.7 * t).exp()))
            .collect()
    }

    #[test]
    fn a_curve_that_is_not_linear_is_found() {
        let found = fit([0.0, 0.0], residuals);
        assert!(
            (found.x[0] - 2.0).abs() < 1e-4 && (found.x[1] + 0.7).abs() < 1e-4,
            "{:?}",
            found.x
        );
    }

    #[test]
    fn the_standard_error_of_a_mean_is_that_of_its_groups() {
        // Residuals y − x of pairs of equal observations; the prior counts little beside a weight of 1000.
        let observed = [1.0, 1.0, 4.0, 4.0, 7.0, 7.0];
        let residuals = |x: &[f64; 1]| observed.iter().map(|y| 1e3 * (x[0] - y)).collect();
        let found = fit([0.0], residuals);
        assert!((found.x[0] - 4.0).abs() < 1e-3);
        // Three groups with deviations −3, 0, 3: √(9 + 9)/3.
        let [error] = found.standard_errors(&[0, 0, 1, 1, 2, 2]);
        assert!((error - 2.0_f64.sqrt()).abs() < 1e-3, "{error}");
        let [moved] = found.moved_without(0..2);
        assert!((moved - 1.5).abs() < 1e-3, "{moved}");
    }
}

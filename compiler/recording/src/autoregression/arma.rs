//! ARMA models: two stages, and the least prediction error.

use super::{Model, ar::burg, least_squares::solve};
use asperity_texture::signal::reflection::is_stable;

/// Order of the AR model whose residual stands for the excitation.
const LONG: usize = 30;
/// Steps of the search.
const STEPS: usize = 12;

/// Hannan and Rissanen: a long AR model gives the excitation, least squares the rest. `None` where
/// the model is not stable or its numerator has no stable inverse.
#[must_use]
pub fn two_stage(signal: &[f64], p: usize, q: usize) -> Option<Model> {
    let e = burg(signal, LONG).residual(signal);
    let y = &signal[signal.len() - e.len()..];
    let reach = p.max(q);
    let row = |n: usize| -> Vec<f64> {
        (1..=p)
            .map(|k| -y[n - k])
            .chain((1..=q).map(|k| e[n - k]))
            .collect()
    };
    let found = regress((reach..y.len()).map(|n| (row(n), y[n])), p + q)?;
    checked(signal, found, p)
}

/// Least prediction error by Gauss–Newton's steps from a first model, each halved until it helps.
#[must_use]
pub fn prediction_error(signal: &[f64], start: &Model) -> Option<Model> {
    let (p, q) = (start.a.len() - 1, start.b.len() - 1);
    let mut best = Model {
        variance: variance(start, signal),
        ..start.clone()
    };
    for _ in 0..STEPS {
        // ∂e/∂a_k = y[n−k]/B, ∂e/∂b_k = −e[n−k]/B.
        let e = full_residual(&best, signal);
        let inverse = |x: &[f64]| -> Vec<f64> {
            let mut out: Vec<f64> = Vec::with_capacity(x.len());
            for n in 0..x.len() {
                let past: f64 = best
                    .b
                    .iter()
                    .enumerate()
                    .skip(1)
                    .take(n)
                    .map(|(k, b)| b * out[n - k])
                    .sum();
                out.push(x[n] - past);
            }
            out
        };
        let (dy, de) = (inverse(signal), inverse(&e));
        let row = |n: usize| -> Vec<f64> {
            (1..=p)
                .map(|k| -dy[n - k])
                .chain((1..=q).map(|k| de[n - k]))
                .collect()
        };
        let step = regress((p.max(q)..signal.len()).map(|n| (row(n), e[n])), p + q)?;
        let tried = (0..6).find_map(|halvings| {
            let share = libm::ldexp(1.0, -halvings);
            let moved = |c: &[f64], step: &[f64]| -> Vec<f64> {
                std::iter::once(1.0)
                    .chain(c[1..].iter().zip(step).map(|(c, s)| c + share * s))
                    .collect()
            };
            let mut next = Model {
                a: moved(&best.a, &step[..p]),
                b: moved(&best.b, &step[p..]),
                variance: 0.0,
            };
            if !is_stable(&next.a) || !is_stable(&next.b) {
                return None;
            }
            next.variance = variance(&next, signal);
            (next.variance < best.variance).then_some(next)
        });
        let Some(next) = tried else {
            break;
        };
        let gain = best.variance / next.variance;
        best = next;
        if gain < 1.0 + 1e-6 {
            break;
        }
    }
    Some(best)
}

fn full_residual(model: &Model, signal: &[f64]) -> Vec<f64> {
    let mut e: Vec<f64> = Vec::with_capacity(signal.len());
    for n in 0..signal.len() {
        let past = |x: &[f64], c: &[f64]| -> f64 {
            c.iter()
                .enumerate()
                .skip(1)
                .take(n)
                .map(|(k, c)| c * x[n - k])
                .sum()
        };
        e.push(signal[n] + past(signal, &model.a) - past(&e, &model.b));
    }
    e
}

fn variance(model: &Model, signal: &[f64]) -> f64 {
    let e = model.residual(signal);
    e.iter().map(|x| x * x).sum::<f64>() / e.len().max(1) as f64
}

/// The coefficients of the least squares.
fn regress(rows: impl Iterator<Item = (Vec<f64>, f64)>, count: usize) -> Option<Vec<f64>> {
    let mut matrix = vec![vec![0.0; count]; count];
    let mut right = vec![0.0; count];
    for (row, y) in rows {
        for i in 0..count {
            right[i] += row[i] * y;
            for j in 0..count {
                matrix[i][j] += row[i] * row[j];
            }
        }
    }
    solve(matrix, right)
}

fn checked(signal: &[f64], found: Vec<f64>, p: usize) -> Option<Model> {
    let monic = |c: &[f64]| -> Vec<f64> { std::iter::once(1.0).chain(c.iter().copied()).collect() };
    let mut model = Model {
        a: monic(&found[..p]),
        b: monic(&found[p..]),
        variance: 0.0,
    };
    if !is_stable(&model.a) || !is_stable(&model.b) {
        return None;
    }
    model.variance = variance(&model, signal);
    Some(model)
}

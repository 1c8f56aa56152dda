//! Models of signals so short that they can be worked out by hand, and laws of the estimates.

use super::{least_squares::solve, *};
use crate::{signal::noise::white, test_recordings::near};
use asperity_texture::signal::reflection::is_stable;

fn all_near(found: &[f64], expected: &[f64], apart: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (a, b) in found.iter().zip(expected) {
        near(*a, *b, apart);
    }
}

/// Noise through A(z) and B(z).
fn made(a: &[f64], b: &[f64], count: usize) -> Vec<f64> {
    let e = white(7, count, 12);
    let mut y = vec![0.0; count];
    for n in 0..count {
        y[n] = (0..b.len().min(n + 1))
            .map(|k| b[k] * e[n - k])
            .sum::<f64>()
            - (1..a.len().min(n + 1))
                .map(|k| a[k] * y[n - k])
                .sum::<f64>();
    }
    y
}

#[test]
fn systems_are_solved_with_and_without_pivots() {
    let rows = |rows: [[f64; 3]; 3]| rows.map(|row| row.to_vec()).to_vec();
    let found = solve(
        rows([[2.0, 1.0, 0.0], [1.0, 3.0, 1.0], [0.0, 1.0, 4.0]]),
        vec![0.0, -2.0, 10.0],
    );
    all_near(&found.expect("regular"), &[1.0, -2.0, 3.0], 1e-12);
    let found = solve(
        rows([[0.0, 1.0, 2.0], [1.0, 0.0, 3.0], [4.0, 5.0, 6.0]]),
        vec![8.0, 10.0, 32.0],
    );
    all_near(&found.expect("regular"), &[1.0, 2.0, 3.0], 1e-12);
    // The largest of a column is the pivot, whatever its sign: 10²⁰ would swallow the rest.
    let found = solve(vec![vec![1e-20, 1.0], vec![-1.0, 1.0]], vec![1.0, 0.0]);
    all_near(&found.expect("regular"), &[1.0, 1.0], 1e-12);
    assert_eq!(
        solve(vec![vec![1.0, 2.0], vec![2.0, 4.0]], vec![1.0, 2.0]),
        None
    );
    assert_eq!(solve(vec![vec![1e-301]], vec![1e-301]), None);
    assert_eq!(solve(vec![vec![1e-299]], vec![1e-299]), Some(vec![1.0]));
    assert_eq!(solve(vec![vec![1e-299]], vec![1e200]), None);
    assert_eq!(solve(Vec::new(), Vec::new()), Some(Vec::new()));
}

#[test]
fn yule_walker_divides_the_lags_of_one_two_three() {
    // r₀ = 14/3, r₁ = 8/3.
    let found = yule_walker(&[1.0, 2.0, 3.0], 1);
    all_near(&found.a, &[1.0, -4.0 / 7.0], 1e-12);
    near(found.variance, 14.0 / 3.0 * (1.0 - 16.0 / 49.0), 1e-12);
    assert_eq!(found.b, [1.0]);
    // Lags beyond the signal are 0.
    assert!(is_stable(&yule_walker(&[1.0, 2.0, 3.0], 6).a));
}

#[test]
fn burg_reflects_one_two_three_by_eight_ninths_and_back() {
    let (k1, k2) = (-8.0 / 9.0, 77.0 / 85.0);
    let variance = |k: f64| 14.0 / 3.0 * (1.0 - 64.0 / 81.0) * (1.0 - k * k);
    let signal = [1.0, 2.0, 3.0];
    near(burg(&signal, 0).variance, 14.0 / 3.0, 1e-12);
    let first = burg(&signal, 1);
    all_near(&first.a, &[1.0, k1], 1e-12);
    near(first.variance, variance(0.0), 1e-12);
    // No order beyond what the samples tell.
    for order in [2, 5] {
        let found = burg(&signal, order);
        all_near(&found.a, &[1.0, k1 + k1 * k2, k2], 1e-12);
        near(found.variance, variance(k2), 1e-12);
    }
    let silent = burg(&[0.0; 5], 2);
    assert_eq!((silent.a, silent.variance), (vec![1.0, 0.0, 0.0], 0.0));
    assert_eq!(burg(&[], 2).a, [1.0]);
}

#[test]
fn burg_and_covariance_of_four_samples_minimise_what_they_say() {
    // Forward 2a+1 … : Σ (y[n] + a·y[n−1])² of 3, 2, 1 is least at −8/13.
    let found = covariance(&[3.0, 2.0, 1.0], 1).expect("stable");
    all_near(&found.a, &[1.0, -8.0 / 13.0], 1e-12);
    near(found.variance, 1.0 / 26.0, 1e-12);
    assert_eq!(covariance(&[1.0, 2.0, 3.0], 1), None, "it grows");
    // What follows an equation of the second order is predicted exactly.
    let mut exact = vec![1.0, 0.5];
    for n in 2..30 {
        exact.push(1.2 * exact[n - 1] - 0.8 * exact[n - 2]);
    }
    let found = covariance(&exact, 2).expect("stable");
    all_near(&found.a, &[1.0, -1.2, 0.8], 1e-9);
    near(found.variance, 0.0, 1e-9);
}

#[test]
fn a_residual_is_what_past_values_and_past_errors_do_not_explain() {
    let model = |a: &[f64], b: &[f64]| Model {
        a: a.to_vec(),
        b: b.to_vec(),
        variance: 1.0,
    };
    let signal = [1.0, 2.0, 3.0, 4.0];
    assert_eq!(model(&[1.0], &[1.0]).residual(&signal), signal);
    assert_eq!(
        model(&[1.0, 0.5, 0.25], &[1.0]).residual(&signal),
        [4.25, 6.0]
    );
    // 1, 2.25, 3.4375, 4.640625.
    assert_eq!(
        model(&[1.0, 0.5], &[1.0, 0.25]).residual(&signal),
        [2.25, 3.4375, 4.640_625]
    );
    // 1, 1.5, 2, 2.625: e − 0.5·e₋₁ − 0.25·e₋₂.
    assert_eq!(
        model(&[1.0], &[1.0, 0.5, 0.25]).residual(&signal),
        [2.0, 2.625]
    );
    assert!(model(&[1.0, 0.5, 0.2], &[1.0]).residual(&[1.0]).is_empty());
    // A signal made of an impulse by the model is explained but for the impulse.
    let (a, b) = ([1.0, -0.9, 0.5], [1.0, 0.4, 0.3]);
    let mut answer = vec![0.0; 20];
    for n in 0..20 {
        let past: f64 = (1..=2.min(n)).map(|k| a[k] * answer[n - k]).sum();
        answer[n] = b.get(n).copied().unwrap_or(0.0) - past;
    }
    let rest = model(&a, &b).residual(&answer);
    assert!(rest.iter().all(|e| e.abs() < 1e-12) && rest.len() == 18);
}

#[test]
fn without_a_numerator_the_least_prediction_error_is_that_of_the_covariance_method() {
    let signal = made(&[1.0, -1.2, 0.8], &[1.0], 400);
    let start = Model {
        a: vec![1.0, 0.0, 0.0],
        b: vec![1.0],
        variance: 0.0,
    };
    let found = prediction_error(&signal, &start).expect("stable");
    let exact = covariance(&signal, 2).expect("stable");
    all_near(&found.a, &exact.a, 1e-9);
    near(found.variance, exact.variance, 1e-9);
    let two = two_stage(&signal, 2, 0).expect("stable");
    near(two.a[1], exact.a[1], 0.05);
    near(two.a[2], exact.a[2], 0.05);
}

#[test]
fn no_small_step_from_the_least_prediction_error_helps() {
    for (a, b) in [
        (vec![1.0, -1.2, 0.8], vec![1.0, 0.5]),
        (vec![1.0, -0.7], vec![1.0, 0.5, 0.3]),
        (vec![1.0, -1.0, 0.6], vec![1.0, -0.4, 0.5]),
    ] {
        let signal = made(&a, &b, 3000);
        let two = two_stage(&signal, a.len() - 1, b.len() - 1).expect("stable");
        all_near(&two.a, &a, 0.12);
        all_near(&two.b, &b, 0.12);
        let flat = |c: &[f64]| -> Vec<f64> {
            (0..c.len())
                .map(|k| if k == 0 { 1.0 } else { 0.0 })
                .collect()
        };
        let mut far = Model {
            a: flat(&a),
            b: flat(&b),
            variance: 0.0,
        };
        // Not where numerator and denominator cancel.
        (far.a[1], far.b[1]) = (-0.3, 0.2);
        let power = |model: &Model| {
            let e = model.residual(&signal);
            e.iter().map(|x| x * x).sum::<f64>() / e.len() as f64
        };
        near(two.variance, power(&two), 1e-12);
        for start in [two, far] {
            let best = prediction_error(&signal, &start).expect("stable");
            near(best.variance, power(&best), 1e-12);
            all_near(&best.a, &a, 0.08);
            all_near(&best.b, &b, 0.08);
            for k in 1..a.len() + b.len() - 1 {
                for step in [0.004, -0.004] {
                    let mut moved = best.clone();
                    match moved.a.get_mut(k) {
                        Some(c) => *c += step,
                        None => moved.b[k + 1 - a.len()] += step,
                    }
                    assert!(power(&moved) > best.variance, "{k} {step}");
                }
            }
        }
    }
}

#[test]
fn the_order_costs_the_logarithm_of_the_samples() {
    // ln 100 = 4.605: a part of the variance of e^(−0.046) is what an order costs.
    assert_eq!(information_order(&[1.0, 0.97], 100.0), 0);
    assert_eq!(information_order(&[1.0, 0.95], 100.0), 1);
    assert_eq!(information_order(&[1.0, 0.95, 0.89], 100.0), 2);
    assert_eq!(information_order(&[1.0, 0.5, 0.49, 0.1], 10.0), 3);
    assert_eq!(information_order(&[1.0, 0.5, 0.49, 0.4], 10.0), 1);
    assert_eq!(information_order(&[], 10.0), 0);
}

#[test]
fn scores_are_the_held_out_errors_of_the_stretches_that_gave_a_model() {
    let one = made(&[1.0, -1.2, 0.8], &[1.0], 400);
    let two = made(&[1.0, 0.6, 0.2], &[1.0], 500);
    // Its first half grows, so that the covariance method gives no stable model.
    let grows: Vec<f64> = (0..60).map(|n| libm::pow(1.2, f64::from(n))).collect();
    let stretches = [&one[..], &two[..], &grows[..]];
    let scores = compare(stretches.iter().copied(), 2);
    let db = |stretch: &[f64], fit: &dyn Fn(&[f64]) -> Model| {
        let (seen, held_out) = stretch.split_at(stretch.len() / 2);
        let power = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64;
        10.0 * (power(&fit(seen).residual(held_out)) / power(held_out)).log10()
    };
    let of = |method| scores.iter().find(|s| s.method == method).expect("scored");
    let burgs: f64 = stretches.iter().map(|s| db(s, &|x| burg(x, 2))).sum();
    near(of(Method::Burg).error_db, burgs / 3.0, 1e-9);
    assert_eq!(of(Method::Burg).stable, 1.0);
    let stable: f64 = [&one, &two]
        .iter()
        .map(|s| db(s, &|x| covariance(x, 2).expect("stable")))
        .sum();
    near(of(Method::Covariance).error_db, stable / 2.0, 1e-9);
    near(of(Method::Covariance).stable, 2.0 / 3.0, 1e-12);
    assert!(of(Method::YuleWalker).error_db < -1.0);
    for score in compare(std::iter::empty(), 2) {
        assert_eq!((score.error_db, score.stable), (0.0, 0.0));
    }
}

#[test]
fn an_arma_model_has_half_the_order_on_each_side() {
    let signal = made(&[1.0, -0.8], &[1.0, 0.4], 2000);
    for (order, half) in [(1, 1), (2, 1), (3, 1), (4, 2)] {
        for method in [Method::TwoStage, Method::PredictionError] {
            let model = method.fit(&signal, order).expect("stable");
            assert_eq!((model.a.len(), model.b.len()), (half + 1, half + 1));
        }
        assert_eq!(
            Method::Burg.fit(&signal, order).expect("a model").a.len(),
            order + 1
        );
    }
}

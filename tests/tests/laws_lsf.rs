//! Convex mixtures of ordered line spectral frequencies are ordered, in ω and in cos ω,
//! and give stable filters; extrapolations do not.

use asperity_tests::oracle::polynomial;
use proptest::{collection::vec, prelude::*};
use std::f64::consts::PI;

/// Ordered frequencies whose neighbours are at least 0.013 rad apart. Closer ones are just as
/// stable, but coefficients in f64 cannot show it.
fn ordered(order: usize) -> impl Strategy<Value = Vec<f64>> {
    vec(prop_oneof![0.1_f64..0.2, 0.2_f64..1.0], order + 1).prop_map(move |steps| {
        let sum: f64 = steps.iter().sum();
        let mut at = 0.0;
        steps[..order]
            .iter()
            .map(|step| {
                at += step / sum * PI;
                at
            })
            .collect()
    })
}

fn three() -> impl Strategy<Value = [Vec<f64>; 3]> {
    (1_usize..=24).prop_flat_map(|order| [ordered(order), ordered(order), ordered(order)])
}

fn weights() -> impl Strategy<Value = [f64; 3]> {
    let edge = prop_oneof![4 => 0.0_f64..1.0, 1 => Just(0.0)];
    (edge.clone(), edge, 1e-9_f64..1.0).prop_map(|(i, j, k)| {
        let w = [i, j, k];
        let sum: f64 = w.iter().sum();
        w.map(|w| w / sum)
    })
}

fn mix(lists: &[Vec<f64>; 3], weights: [f64; 3], map: fn(f64) -> f64) -> Vec<f64> {
    (0..lists[0].len())
        .map(|i| {
            lists
                .iter()
                .zip(weights)
                .map(|(list, w)| w * map(list[i]))
                .sum()
        })
        .collect()
}

fn stable(cosines: &[f64]) -> bool {
    largest_reflection(&polynomial(cosines)) < 1.0
}

fn largest_reflection(a: &[f64]) -> f64 {
    let mut a = a.to_vec();
    let mut largest = 0.0_f64;
    while let Some(k) = a.pop() {
        largest = largest.max(k.abs());
        let above = a.clone();
        for (i, a) in a.iter_mut().enumerate() {
            *a = (*a - k * above[above.len() - 1 - i]) / (1.0 - k * k);
        }
    }
    largest
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mixtures_in_omega_are_ordered_and_stable(lists in three(), weights in weights()) {
        let mixed = mix(&lists, weights, |w| w);
        prop_assert!(mixed.first().is_none_or(|&w| w > 0.0) && mixed.last().is_none_or(|&w| w < PI));
        prop_assert!(mixed.windows(2).all(|pair| pair[0] < pair[1]));
        let cosines: Vec<f64> = mixed.iter().map(|w| w.cos()).collect();
        prop_assert!(stable(&cosines));
    }

    #[test]
    fn mixtures_in_cos_omega_are_ordered_and_stable(lists in three(), weights in weights()) {
        let mixed = mix(&lists, weights, f64::cos);
        prop_assert!(mixed.first().is_none_or(|&x| x < 1.0) && mixed.last().is_none_or(|&x| x > -1.0));
        prop_assert!(mixed.windows(2).all(|pair| pair[0] > pair[1]));
        prop_assert!(stable(&mixed));
    }
}

/// The law needs convexity. It fails for weights outside [0, 1], which shows that the check
/// can fail.
#[test]
fn extrapolation_breaks_the_order_and_the_filter() {
    let lists = [
        vec![0.5, 0.6, 2.0, 2.1],
        vec![0.1, 1.5, 1.6, 3.0],
        vec![0.3, 1.0, 1.8, 2.5],
    ];
    let mixed = mix(&lists, [1.4, -0.3, -0.1], f64::cos);
    assert!(mixed.windows(2).any(|pair| pair[0] <= pair[1]));
    assert!(!stable(&mixed));
}

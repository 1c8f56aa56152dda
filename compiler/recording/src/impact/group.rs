//! Impacts of one speed as a mean transient.

use super::{Impact, TAP_SAMPLES, Transient};
use crate::signal::quantile::{mean, median};

/// Most speeds, each with a transient of its own.
const MOST_SPEEDS: usize = 8;
/// Fewest impacts of a speed.
const FEWEST: usize = 3;
/// Speeds of one group differ by less than this factor.
const GROUP: f64 = 1.35;
/// The end is faded over these samples.
const FADE: usize = 20;
/// Samples by which a trace may be moved to match the others.
const REACH: isize = 5;
/// An impact this many times as far from the others as the middle one is left out: a tool that
/// bounced, or a knock.
const FAR: f64 = 2.5;

/// Transients by speed, in ascending order. Impacts of a group are scaled to its mean speed and
/// moved to where they match best.
#[must_use]
pub fn transients(impacts: &[Impact]) -> Vec<Transient> {
    let mut sorted: Vec<&Impact> = impacts.iter().collect();
    sorted.sort_by(|a, b| a.speed_m_s.total_cmp(&b.speed_m_s));
    let mut groups: Vec<Vec<&Impact>> = Vec::new();
    for impact in sorted {
        match groups.last_mut() {
            Some(group) if impact.speed_m_s < GROUP * group[0].speed_m_s => group.push(impact),
            _ => groups.push(vec![impact]),
        }
    }
    groups.retain(|group| group.len() >= FEWEST);
    while groups.len() > MOST_SPEEDS {
        let least = (0..groups.len())
            .min_by_key(|&n| groups[n].len())
            .unwrap_or(0);
        groups.remove(least);
    }
    groups.into_iter().map(average).collect()
}

fn average(mut group: Vec<&Impact>) -> Transient {
    let mut aligned = aligned(&group);
    let far = distances(&aligned, &middle(&aligned));
    let limit = FAR * median(far.iter().copied());
    if far.iter().filter(|distance| **distance <= limit).count() >= FEWEST {
        let near = || far.iter().map(|distance| *distance <= limit);
        let mut keep = near();
        group.retain(|_| keep.next().unwrap_or(true));
        let mut keep = near();
        aligned.retain(|_| keep.next().unwrap_or(true));
    }
    let mut accel_m_s2 = mean_of(&aligned);
    let apart = mean(
        &distances(&aligned, &accel_m_s2)
            .iter()
            .map(|d| d * d)
            .collect::<Vec<_>>(),
    );
    let spread = (apart / energy(&accel_m_s2).max(1e-300)).sqrt();
    for (n, a) in accel_m_s2.iter_mut().rev().take(FADE).enumerate() {
        *a *= 0.5 - 0.5 * libm::cos(std::f64::consts::PI * n as f64 / FADE as f64);
    }
    Transient {
        speed_m_s: mean_speed(&group),
        impacts: group.len(),
        accel_m_s2,
        spread,
    }
}

fn mean_speed(group: &[&Impact]) -> f64 {
    mean(&group.iter().map(|i| i.speed_m_s).collect::<Vec<_>>())
}

/// The traces of a group, scaled to its mean speed and moved to where they match.
fn aligned(group: &[&Impact]) -> Vec<Vec<f64>> {
    let speed_m_s = mean_speed(group);
    let scaled: Vec<Vec<f64>> = group
        .iter()
        .map(|impact| {
            let factor = speed_m_s / impact.speed_m_s;
            impact.accel_m_s2.iter().map(|a| a * factor).collect()
        })
        .collect();
    let reference = middle(&scaled);
    scaled
        .iter()
        .map(|trace| moved(trace, best_shift(&reference, trace)))
        .collect()
}

fn energy(trace: &[f64]) -> f64 {
    trace.iter().map(|x| x * x).sum()
}

fn distances(traces: &[Vec<f64>], reference: &[f64]) -> Vec<f64> {
    traces
        .iter()
        .map(|trace| {
            let apart: Vec<f64> = trace.iter().zip(reference).map(|(a, b)| a - b).collect();
            energy(&apart).sqrt()
        })
        .collect()
}

fn mean_of(traces: &[Vec<f64>]) -> Vec<f64> {
    (0..TAP_SAMPLES)
        .map(|n| traces.iter().map(|t| t[n]).sum::<f64>() / traces.len() as f64)
        .collect()
}

/// The median of every sample: what most traces share.
fn middle(traces: &[Vec<f64>]) -> Vec<f64> {
    (0..TAP_SAMPLES)
        .map(|n| median(traces.iter().map(|t| t[n])))
        .collect()
}

/// The shift at which a trace matches best.
fn best_shift(reference: &[f64], trace: &[f64]) -> isize {
    let product = |shift: isize| -> f64 {
        moved(trace, shift)
            .iter()
            .zip(reference)
            .map(|(a, b)| a * b)
            .sum()
    };
    (-REACH..=REACH)
        .max_by(|&a, &b| product(a).total_cmp(&product(b)))
        .unwrap_or(0)
}

fn moved(trace: &[f64], shift: isize) -> Vec<f64> {
    (0..trace.len() as isize)
        .map(|n| {
            usize::try_from(n + shift)
                .ok()
                .and_then(|n| trace.get(n))
                .copied()
                .unwrap_or(0.0)
        })
        .collect()
}

#[cfg(test)]
#[path = "group_tests.rs"]
mod laws;

#[cfg(test)]
mod tests {
    use super::*;

    fn impact(speed_m_s: f64, late: usize, sign: f64) -> Impact {
        let accel_m_s2 = (0..TAP_SAMPLES)
            .map(|n| {
                let t = n as f64 - 20.0 - late as f64;
                100.0 * sign * speed_m_s * libm::exp(-(t / 4.0).powi(2))
            })
            .collect();
        Impact {
            at_s: 0.0,
            speed_m_s,
            integrated_m_s: None,
            accel_m_s2,
        }
    }

    #[test]
    fn impacts_of_a_speed_become_one_trace_and_a_knock_is_left_out() {
        let impacts = [
            impact(0.10, 0, 1.0),
            impact(0.11, 2, 1.0),
            impact(0.105, 1, 1.0),
            impact(0.105, 1, -1.0),
            impact(0.3, 0, 1.0),
        ];
        let found = transients(&impacts);
        assert_eq!(found.len(), 1, "one impact at 0.3 m/s is too few");
        assert_eq!(found[0].impacts, 3);
        assert!((found[0].speed_m_s - 0.105).abs() < 1e-9);
        assert!(found[0].spread < 1e-3, "{}", found[0].spread);
        let peak = found[0].accel_m_s2.iter().copied().fold(0.0, f64::max);
        assert!((peak - 10.5).abs() < 0.1, "{peak}");
    }
}

//! Bad samples: NaN, infinity, and positions that stick.

use super::unbounded;
use asperity_runtime::{Renderer, Sample, State};

use super::error::StabilityError;
use super::material::Material;
use super::methods::Regularised;
use super::row::{ScenarioResult, Words};

/// The tick at which the fault comes, in a stroke of 1000 ticks.
const FAULT: usize = 300;

/// A stroke at 120 mm/s and 1 N.
fn stroke(n: usize) -> [f64; 3] {
    [0.12e-3 * n as f64, 0.0, -2e-3]
}

fn fresh(n: usize) -> Sample {
    Sample::at(stroke(n).map(|x| x as f32))
}

/// The stroke with 10 ms at a depth of 50 mm.
#[must_use]
pub fn deep(n: usize) -> Sample {
    let mut sample = fresh(n);
    if (FAULT..FAULT + 10).contains(&n) {
        sample.position_m[2] = -0.05;
    }
    sample
}

/// Forces of the runtime over a second, N.
pub fn ours(material: &Material, samples: impl Fn(usize) -> Sample, seed: u64) -> Vec<[f64; 3]> {
    let renderer = Renderer::new(&unbounded()).expect("the default");
    let mut state = State::new(seed);
    (0..1000)
        .map(|n| {
            renderer
                .tick(&material.slot, &mut state, &samples(n))
                .force_n
                .map(f64::from)
        })
        .collect()
}

/// Forces of a renderer that trusts every sample, N: a wall, and friction by velocity.
pub fn trusting(samples: impl Fn(usize) -> Sample) -> Vec<[f64; 3]> {
    let mut friction = Regularised::new(1000.0);
    (0..1000)
        .map(|n| {
            let [x, _, z] = samples(n).position_m.map(f64::from);
            let normal_n = if z < 0.0 { -500.0 * z } else { 0.0 * z };
            [friction.step(x, 0.7, normal_n), 0.0, normal_n]
        })
        .collect()
}

fn not_finite(forces: &[[f64; 3]]) -> f64 {
    forces
        .iter()
        .filter(|f| f.iter().any(|x| !x.is_finite()))
        .count() as f64
}

/// Largest step of the force from the fault on, N.
fn step_n(forces: &[[f64; 3]]) -> f64 {
    forces[FAULT..]
        .windows(2)
        .map(|w| {
            (0..3)
                .map(|i| (w[1][i] - w[0][i]).powi(2))
                .sum::<f64>()
                .sqrt()
        })
        .fold(0.0, f64::max)
}

/// Largest force from the fault on, N.
fn largest_n(forces: &[[f64; 3]]) -> f64 {
    let magnitude = |force: &[f64; 3]| force.iter().map(|x| x * x).sum::<f64>().sqrt();
    forces[FAULT..].iter().map(magnitude).fold(0.0, f64::max)
}

const NAN: Words = Words {
    theme: "fault",
    quantity: "forces that are not finite (of 1000)",
    fails: "one NaN enters the velocity filter and never leaves it",
    instead: "the gate holds the last good sample twice, then the force goes to zero and comes back \
              by a ramp",
};
const STUCK: Words = Words {
    theme: "fault",
    quantity: "largest step of the force in a tick (N)",
    fails: "a frozen position that jumps is a velocity of metres per second and a depth of \
            centimetres",
    instead: "peak and slew of the total are limited whatever the position does",
};
const PEAK: Words = Words {
    quantity: "largest force (N)",
    ..STUCK
};

/// The rows.
///
/// # Errors
/// None for the built-in texture.
pub fn rows(seed: u64) -> Result<Vec<ScenarioResult>, StabilityError> {
    let material = Material::built_in()?;
    let mut rows = Vec::new();
    for (scenario, value) in [
        ("one NaN in a stroke", f32::NAN),
        ("one infinity", f32::INFINITY),
    ] {
        let samples = |n: usize| {
            let mut sample = fresh(n);
            if n == FAULT {
                sample.position_m[0] = value;
            }
            sample
        };
        rows.push(NAN.row(
            scenario,
            not_finite(&ours(&material, samples, seed)),
            0.0,
            &[("no gate", not_finite(&trusting(samples)))],
        ));
    }
    let stuck = |n: usize| {
        let at = if (FAULT..FAULT + 100).contains(&n) {
            FAULT
        } else {
            n
        };
        let mut sample = fresh(at);
        sample.position_m[2] -= 8e-5 * at.saturating_sub(FAULT).min(100) as f32;
        sample
    };
    // The limits of the device: what holds them is the limiter.
    let cases = [
        (
            "a position stuck for 100 ms while the stylus goes 8 mm deeper",
            ours(&material, stuck, seed),
            trusting(stuck),
        ),
        (
            "a depth of 50 mm for 10 ms",
            ours(&material, deep, seed),
            trusting(deep),
        ),
    ];
    for (scenario, limited, free) in &cases {
        let free = [("no limits", step_n(free))];
        rows.push(STUCK.row(*scenario, step_n(limited), 2.0 + 1e-5, &free));
    }
    for (scenario, limited, free) in &cases {
        let free = [("no limits", largest_n(free))];
        rows.push(PEAK.row(*scenario, largest_n(limited), 3.3 + 1e-5, &free));
    }
    Ok(rows)
}

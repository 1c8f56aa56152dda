//! Friction: rest, ramps, reversal and closed paths, by the law alone and in a hand.

#[cfg(test)]
mod falling;
mod law;
mod ramp;
mod rest;

pub use law::{Law, laws, ours};
pub use ramp::{SETTLE, departure, forces, ramp, steepest};
pub use rest::stroke_and_rest;

use super::unbounded;
use super::{
    error::StabilityError,
    material::Material,
    observer::Absorber,
    row::{ScenarioResult, Words},
};
use crate::stability::observer::Observer;
use asperity_runtime::Renderer;
use asperity_sim::servo::RenderedTexture;
use law::TICK_S;
use ramp::{departure_of_all, lacking, steepest_of_all};
use rest::{flips_at_rest, not_finite_at_rest, rest_in_a_hand, wall_with};
use std::f64::consts::TAU;

/// Coefficient of friction of the rows that do not vary it.
const MU: f64 = 0.7;

/// A device that absorbs nothing, the strictest case.
const NOTHING: Absorber = Absorber {
    damping_n_s_m: 0.0,
    coulomb_n: 0.0,
};
/// The simulated Touch.
const TOUCH: Absorber = Absorber {
    damping_n_s_m: 0.1,
    coulomb_n: 0.26,
};
/// Frequencies, Hz, up to those that no hand reaches by itself. The slow ones test late forces.
const FAST_HZ: [f64; 11] = [
    0.5, 2.0, 5.0, 12.0, 20.0, 35.0, 50.0, 75.0, 100.0, 125.0, 150.0,
];

/// A row whose figure is measured with each law.
fn by_law(
    words: Words,
    scenario: &str,
    limit: f64,
    mu: f64,
    figure: impl Fn(&mut Law) -> f64,
) -> ScenarioResult {
    let [ours, paper, reference] = laws(mu, 0).map(|(name, mut law)| (name, figure(&mut law)));
    words.row(scenario, ours.1, limit, &[paper, reference])
}

const REST: Words = Words {
    theme: "friction",
    quantity: "changes of sign at rest (1/s)",
    fails: "a force against the sign of v follows the noise of the encoder when v is noise",
    instead: "a bristle with a dead zone of two counts: what stays within them has no sign",
};
const ZERO: Words = Words {
    theme: "friction",
    quantity: "forces that are not finite (of 1000)",
    fails: "t̂ = v/|v| at exactly zero speed is 0/0, and one NaN stays in every filter it enters",
    instead: "friction needs no direction of v: the bristle has one only when it is deflected",
};
const RAMP: Words = Words {
    theme: "friction",
    quantity: "|ΔF_t|/F_n per 0.1 mm/s",
    fails: "Coulomb friction reverses by 2μF_n within one count; a holding bristle fills up before \
            a slow ramp has changed speed at all",
    instead: "the bristle leaks with τ = F_n/(k·v_c): steady friction has slope F_n/v_c, and a \
              ramp of any acceleration never exceeds it",
};
const WANDER: Words = Words {
    theme: "friction",
    quantity: "|F_t − F_t(v₀)|/F_n per 0.1 mm/s of largest departure from v₀",
    fails: "a law with memory has no force for a speed; what can be asked is that it stays near",
    instead: "the deflection is a positive average of v·τ that the slip limit only cuts, so the \
              force stays within the slope times the departure",
};
const CYCLE: Words = Words {
    theme: "friction",
    quantity: "largest energy given off to a device that absorbs nothing (µJ)",
    fails: "a velocity filtered at 20 Hz lags by more than a quarter turn above: friction pushes",
    instead: "constant stiffness, leak and slip only lose; the force is taken one tick ahead",
};
const NET: Words = Words {
    quantity: "largest energy given off beyond what the Touch absorbs (µJ)",
    ..CYCLE
};
const FULL: Words = Words {
    theme: "friction",
    quantity: "what friction lacks of μF_n (%)",
    fails: "a viscous part up to v = μ/0.004 mm/s leaves slow strokes without friction",
    instead: "the viscous part ends at a few mm/s: no wider than the step in speed asks",
};
const HAND: Words = Words {
    theme: "friction",
    quantity: "speed of the stylus about its mean of 50 ms (mm/s RMS)",
    fails: "a sign that flips drives device and hand into a limit cycle",
    instead: "the bristle holds, then lets go slowly: it creeps, and nothing drives it",
};

/// The rows.
///
/// # Errors
/// None for the built-in files.
pub fn rows(seed: u64) -> Result<Vec<ScenarioResult>, StabilityError> {
    let each = |figure: &dyn Fn(usize) -> f64| {
        let [(_, _), (paper, _), (reference, _)] = laws(MU, 0);
        (figure(0), [(paper, figure(1)), (reference, figure(2))])
    };
    let nth = |n: usize, mu: f64| {
        let [a, b, c] = laws(mu, 0);
        [a, b, c]
            .into_iter()
            .nth(n)
            .map_or_else(|| ours(mu, 0), |(_, law)| law)
    };
    let mut rows = vec![by_law(
        REST,
        "10 s of rest with noise of ±1 count (0.055 mm) after a stroke, 1 N",
        0.0,
        MU,
        |law| flips_at_rest(law, seed),
    )];

    let mut bristle = ours(MU, 0);
    let mut last = 0.0;
    let direction = move |x: f64| {
        let v = (x - std::mem::replace(&mut last, x)) / TICK_S;
        -MU * v / v.abs()
    };
    rows.push(ZERO.row(
        "exactly zero speed in contact",
        not_finite_at_rest(|x| bristle(x, 1.0)),
        0.0,
        &[("paper's t̂ = v/|v|", not_finite_at_rest(direction))],
    ));

    for (scenario, mu) in [
        (
            "ramps through zero, 0.1 mm/s² to 10 m/s², 0.05–3 N, μ = 0.1",
            0.1,
        ),
        ("the same, μ = 0.7", 0.7),
        ("the same, μ = 1.4", 1.4),
    ] {
        let (ours, others) = each(&|n| steepest_of_all(|| nth(n, mu)));
        rows.push(RAMP.row(scenario, ours, 0.03, &others));
    }
    let (ours_far, others) = each(&|n| departure_of_all(|| nth(n, MU), seed));
    rows.push(WANDER.row(
        "speed wandering at random by 0.1–5 mm/s about 0–100 mm/s, 0.05–2 N",
        ours_far,
        0.03,
        &others,
    ));

    let (ours_lacks, others) = each(&|n| lacking(MU, || nth(n, MU)));
    rows.push(FULL.row(
        "steady stroke at 10 mm/s, 0.1–3 N, μ = 0.7",
        ours_lacks,
        1.0,
        &others,
    ));
    for (words, scenario, delay, frequencies, absorber) in [
        (
            CYCLE,
            "strokes to and fro, 0.5–10 Hz, 0.1–10 mm, pressed steadily or harder one way",
            0,
            &[0.5, 1.0, 2.0, 5.0, 10.0][..],
            &NOTHING,
        ),
        (
            NET,
            "0.5–150 Hz, as far as a hand can move",
            0,
            &FAST_HZ,
            &TOUCH,
        ),
        (NET, "0.5–150 Hz, 1 tick of delay", 1, &FAST_HZ, &TOUCH),
        (NET, "0.5–150 Hz, 2 ticks of delay", 2, &FAST_HZ, &TOUCH),
    ] {
        let energy =
            |law: &dyn Fn() -> Law| 1e6 * energy_of_cycles(law, delay, frequencies, absorber);
        rows.push(words.row(
            scenario,
            energy(&|| ours(MU, delay as u32)),
            1e-3,
            &[
                ("paper's sign of v", energy(&|| nth(1, MU))),
                ("reference's viscous", energy(&|| nth(2, MU))),
            ],
        ));
    }

    let silent = Material::silent(500.0, 0.1)?;
    let renderer = Renderer::new(&unbounded()).expect("the default");
    let [_, paper, reference] = laws(silent.model.friction.mu, 0);
    let runtime = RenderedTexture::new(renderer, &silent.slot, seed);
    rows.push(HAND.row(
        "stroke at 80 mm/s and 1.5 N, then 6 s of rest; Touch, light grip, counts of 0.055 mm",
        rest_in_a_hand(runtime)?,
        0.1,
        &[
            (paper.0, rest_in_a_hand(wall_with(paper.1))?),
            (reference.0, rest_in_a_hand(wall_with(reference.1))?),
        ],
    ));
    Ok(rows)
}

// Energy that a law of friction gives off over periodic motion.

/// Fastest stroke, m/s, and largest acceleration, m/s², that a hand can make. A force of 8.5 N
/// accelerates stylus and light grip by 100 m/s².
const POSSIBLE: (f64, f64) = (0.65, 100.0);
/// Amplitudes, m, from inside the dead zone to far beyond slip.
const AMPLITUDES_M: [f64; 16] = [
    1.0e-4, 1.2e-4, 1.3e-4, 1.5e-4, 1.8e-4, 2.2e-4, 3e-4, 4e-4, 5e-4, 7e-4, 1e-3, 1.5e-3, 2e-3,
    3e-3, 5e-3, 1e-2,
];

/// Largest energy that a law gives off beyond what the device absorbs, J, at any time.
///
/// The motion is a sinusoid of each frequency with every amplitude that a hand can make. It is
/// pressed steadily, or harder at one phase.
#[must_use]
pub fn energy_of_cycles(
    law: impl Fn() -> Law,
    delay_ticks: usize,
    frequencies_hz: &[f64],
    absorber: &Absorber,
) -> f64 {
    let mut worst = 0.0_f64;
    for &frequency_hz in frequencies_hz {
        let turn = TAU * frequency_hz;
        let possible = |a: f64| a * turn <= POSSIBLE.0 && a * turn * turn <= POSSIBLE.1;
        for amplitude_m in AMPLITUDES_M.into_iter().filter(|&a| possible(a)) {
            for (press, phase) in [(0.0, 0.0), (0.4, 0.0), (0.4, 0.25), (0.4, 0.5), (0.4, 0.75)] {
                let ticks = (4.0 / (frequency_hz * TICK_S)).round() as usize;
                let at = |n: usize| n as f64 * TICK_S;
                let x = |n: usize| amplitude_m * (turn * at(n)).sin();
                let mut law = law();
                let force: Vec<f64> = (0..=ticks)
                    .map(|n| law(x(n), 0.6 + press * (turn * at(n) + TAU * phase).cos()))
                    .collect();
                let mut observer = Observer::default();
                for n in delay_ticks..ticks {
                    observer.tick(absorber, force[n - delay_ticks], x(n + 1) - x(n), TICK_S);
                }
                worst = worst.max(observer.worst_j);
            }
        }
    }
    worst
}

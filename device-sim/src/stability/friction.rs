//! Friction: rest, ramps, reversal, closed paths, by law and in a hand.

use std::f64::consts::TAU;

use asperity_runtime::friction::{Bristle, FrictionState};
use asperity_runtime::{Config, Output, Renderer, Sample};
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::methods::{Regularised, Sign};
use super::observer::{Absorber, Observer};
use super::{Material, Row, StabilityError, Words};
use crate::device::DeviceConfig;
use crate::hand::{Grip, GripPreset, Motion, Script};
use crate::servo::{RenderedTexture, Servo, silence};
use crate::session::Session;

/// Servo period, s.
const TICK_S: f64 = 1e-3;
/// One count of position, m.
const COUNT_M: f64 = 0.055e-3;
/// Coefficient of friction of the rows that vary nothing.
const MU: f64 = 0.7;

/// A device that absorbs nothing: the strictest.
const NOTHING: Absorber = Absorber {
    damping_n_s_m: 0.0,
    coulomb_n: 0.0,
};
/// The simulated Touch.
const TOUCH: Absorber = Absorber {
    damping_n_s_m: 0.1,
    coulomb_n: 0.26,
};
/// Frequencies that no hand reaches by itself, and slower ones for late forces, Hz.
const FAST_HZ: [f64; 11] = [
    0.5, 2.0, 5.0, 12.0, 20.0, 35.0, 50.0, 75.0, 100.0, 125.0, 150.0,
];

/// Position along an axis and normal force in, friction force out.
pub type Law = Box<dyn FnMut(f64, f64) -> f64>;

/// The three laws, ours first, at rest.
#[must_use]
pub fn laws(mu: f64, delay_ticks: u32) -> [(&'static str, Law); 3] {
    [
        ("ours", ours(mu, delay_ticks)),
        ("paper's sign of v", {
            let mut law = Sign::new(1.0 / TICK_S);
            Box::new(move |x, normal_n| law.step(x, mu, normal_n))
        }),
        ("reference's viscous", {
            let mut law = Regularised::new(1.0 / TICK_S);
            Box::new(move |x, normal_n| law.step(x, mu, normal_n))
        }),
    ]
}

/// The runtime's bristle along one axis.
#[must_use]
pub fn ours(mu: f64, delay_ticks: u32) -> Law {
    let rate_hz = (1.0 / TICK_S) as f32;
    let bristle: Bristle = Bristle::new(&Config::default().friction, delay_ticks, rate_hz);
    let mut state = FrictionState::default();
    let mut last_m = None;
    Box::new(move |x, normal_n| {
        let motion_m = x - last_m.replace(x).unwrap_or(x);
        let (force, _) = state.step(
            &bristle,
            [motion_m as f32, 0.0, 0.0],
            [0.0, 0.0, 1.0],
            normal_n as f32,
            mu as f32,
        );
        f64::from(force[0])
    })
}

/// Runs a row's figure with each law.
fn by_law(
    words: Words,
    scenario: &str,
    limit: f64,
    mu: f64,
    figure: impl Fn(&mut Law) -> f64,
) -> Row {
    let [ours, paper, reference] = laws(mu, 0).map(|(name, mut law)| (name, figure(&mut law)));
    words.row(scenario, ours.1, limit, &[paper, reference])
}

/// Positions, m: a stroke at 100 mm/s for 200 ms, then rest with noise of ±1 count.
pub fn stroke_and_rest(seed: u64, ticks: usize) -> impl Iterator<Item = f64> {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut base_m = 0.0;
    (0..ticks).map(move |n| {
        base_m += if n < 200 { 0.1e-3 } else { 0.0 };
        base_m + ((rng.next_u64() % 3) as f64 - 1.0) * COUNT_M
    })
}

/// Changes of sign a second over 10 s of rest with noise of ±1 count, after a stroke.
fn flips_at_rest(law: &mut Law, seed: u64) -> f64 {
    let (mut sign, mut flips) = (0.0, 0);
    for (n, x) in stroke_and_rest(seed, 10_500).enumerate() {
        let force = law(x, 1.0);
        if force != 0.0 {
            flips += u32::from(n >= 500 && force * sign < 0.0);
            sign = force;
        }
    }
    f64::from(flips) / 10.0
}

/// Force at each tick of a motion whose speed is `speed(n)`, m/s.
pub fn forces(
    law: &mut Law,
    ticks: usize,
    normal_n: f64,
    speed: impl Fn(usize) -> f64,
) -> Vec<f64> {
    let mut x = 0.0;
    (0..ticks)
        .map(|n| {
            x += speed(n) * TICK_S;
            law(x, normal_n)
        })
        .collect()
}

/// Ticks of steady speed before a ramp.
pub const SETTLE: usize = 15_000;

/// Speeds, m/s, a tick each: steady at −`top`, then a ramp at `accel`, m/s², to `top`.
#[must_use]
pub fn ramp(accel: f64, top: f64) -> Vec<f64> {
    let ticks = (2.0 * top / (accel * TICK_S)).ceil() as usize;
    (0..SETTLE + ticks)
        .map(|n| (-top + accel * TICK_S * n.saturating_sub(SETTLE) as f64).min(top))
        .collect()
}

/// Largest change of F_t/F_n per 0.1 mm/s in a [`ramp`].
#[must_use]
pub fn steepest(law: &mut Law, normal_n: f64, accel: f64, top: f64) -> f64 {
    let speeds = ramp(accel, top);
    let force = forces(law, speeds.len(), normal_n, |n| speeds[n]);
    let force = &force[SETTLE..];
    let per_tick = accel * TICK_S;
    let window =
        ((0.1e-3 / per_tick).round() as usize).clamp(1, force.len().saturating_sub(1).max(1));
    let scale = 0.1e-3 / (per_tick * window as f64);
    force
        .windows(window + 1)
        .map(|w| (w[window] - w[0]).abs() / normal_n * scale)
        .fold(0.0, f64::max)
}

/// The steepest over forces and accelerations.
fn steepest_of_all(law: impl Fn() -> Law) -> f64 {
    let mut worst = 0.0_f64;
    for normal_n in [0.05, 0.2, 1.0, 3.0] {
        for (accel, top) in [
            (1e-4, 8e-3),
            (3e-4, 8e-3),
            (1e-3, 8e-3),
            (1e-2, 8e-3),
            (0.1, 0.1),
            (1.0, 0.3),
            (10.0, 0.3),
        ] {
            worst = worst.max(steepest(&mut law(), normal_n, accel, top));
        }
    }
    worst
}

/// Largest departure of F_t/F_n from its steady value, per 0.1 mm/s of the largest departure
/// of the speed, while the speed wanders at random.
#[must_use]
pub fn departure(law: &mut Law, normal_n: f64, steady: f64, within: f64, seed: u64) -> f64 {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let settle = 8000;
    // Jumps at random times, so that slow and fast wandering both occur.
    let mut speeds = Vec::with_capacity(settle + 8000);
    speeds.resize(settle, steady);
    while speeds.len() < settle + 8000 {
        let unit = (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        let stretch = 1 + rng.next_u64() as usize % 400;
        speeds.extend(std::iter::repeat_n(
            steady + within * (2.0 * unit - 1.0),
            stretch,
        ));
    }
    let largest = speeds
        .iter()
        .map(|v| (v - steady).abs())
        .fold(0.0, f64::max);
    let force = forces(law, speeds.len(), normal_n, |n| speeds[n]);
    let before = force[settle - 1];
    let far = force[settle..]
        .iter()
        .map(|f| (f - before).abs() / normal_n)
        .fold(0.0, f64::max);
    far * 0.1e-3 / largest
}

fn departure_of_all(law: impl Fn() -> Law, seed: u64) -> f64 {
    let mut worst = 0.0_f64;
    for normal_n in [0.05, 0.3, 2.0] {
        for steady in [0.0, 1e-3, 3e-3, 0.01, 0.1] {
            for within in [0.1e-3, 1e-3, 5e-3] {
                worst = worst.max(departure(&mut law(), normal_n, steady, within, seed));
            }
        }
    }
    worst
}

/// Largest lack of μF_n in a steady stroke at 10 mm/s, %.
fn lacking(law: impl Fn() -> Law) -> f64 {
    [0.1, 0.3, 1.0, 3.0]
        .into_iter()
        .map(|normal_n| {
            let force = forces(&mut law(), 15_000, normal_n, |_| 0.01);
            100.0 * (1.0 - force[14_999].abs() / (MU * normal_n))
        })
        .fold(0.0, f64::max)
}

/// Fastest stroke, m/s, and largest acceleration, m/s², that count: 100 m/s² is what 8.5 N
/// give to stylus and light grip.
const POSSIBLE: (f64, f64) = (0.65, 100.0);
/// Half the strokes, m: from below the dead zone to far beyond slip.
const AMPLITUDES_M: [f64; 16] = [
    1.0e-4, 1.2e-4, 1.3e-4, 1.5e-4, 1.8e-4, 2.2e-4, 3e-4, 4e-4, 5e-4, 7e-4, 1e-3, 1.5e-3, 2e-3,
    3e-3, 5e-3, 1e-2,
];

/// Largest energy that a law gives off over cycles of a sinusoid beyond what the device
/// absorbs, J, at any time: pressed steadily or harder at one phase, all amplitudes that a
/// hand can make at these frequencies.
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

/// Root mean square of the stylus's speed along the stroke about its mean over 50 ms, mm/s,
/// while a light grip rests after a stroke.
fn rest_in_a_hand<S: Servo>(servo: S) -> Result<f64, StabilityError> {
    let device = DeviceConfig::touch()?;
    let grip = Grip::preset(GripPreset::Light)?;
    let script = Script::new(vec![
        Motion::Stroke {
            to_m: [0.02, 0.0],
            speed_m_s: 0.08,
            force_n: 1.5,
        },
        Motion::Rest {
            force_n: 1.5,
            duration_s: 6.0,
        },
    ]);
    let mut session = Session::new(&device, grip, script, servo);
    let records = session.run(20_000);
    let late = &records[records.len() - 1500..];
    let speeds: Vec<f64> = late.iter().map(|r| 1e3 * r.true_m_s[0]).collect();
    let about_mean = |block: &[f64]| {
        let mean = block.iter().sum::<f64>() / block.len() as f64;
        block.iter().map(|v| (v - mean).powi(2)).sum::<f64>()
    };
    let square: f64 = speeds.chunks_exact(50).map(about_mean).sum();
    Ok((square / speeds.len() as f64).sqrt())
}

/// A wall of 500 N/m with a friction law along x.
fn wall_with(mut law: Law) -> impl FnMut(&Sample) -> Output {
    move |sample| {
        let [x, _, z] = sample.position_m.map(f64::from);
        let normal_n = 500.0 * (-z).max(0.0);
        let friction_n = law(x, normal_n);
        Output {
            force_n: [friction_n as f32, 0.0, normal_n as f32],
            ..silence()
        }
    }
}

/// Forces that are not finite over a second of rest at exactly zero speed.
fn not_finite_at_rest(mut law: impl FnMut(f64) -> f64) -> f64 {
    (0..1000).filter(|_| !law(0.0).is_finite()).count() as f64
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
pub fn rows(seed: u64) -> Result<Vec<Row>, StabilityError> {
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

    let (ours_lacks, others) = each(&|n| lacking(|| nth(n, MU)));
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
    let renderer = Renderer::new(&Config::default()).expect("the default");
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

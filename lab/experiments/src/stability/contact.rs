//! Contact laws against random strokes: what each part gives off, on devices that absorb little and
//! answer late.

use super::{
    error::StabilityError,
    friction::ours,
    material::Material,
    observer::{Absorber, Observer},
    row::{ScenarioResult, Words},
    wall::{Bench, DAMPINGS_N_S_M, ROUNDING_J, TICK_S},
};
use asperity::model::{Adhesion, ContactLaw, Drag, Imprint, Relaxation, SpringPoint};
use asperity_runtime::{Config, Renderer, Sample, State};
use asperity_sim::random::unit;
use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::{collections::VecDeque, f64::consts::TAU};

const STROKES: Words = Words {
    theme: "contact",
    quantity: "net energy given off to the worst of the random strokes (mJ)",
    fails: "stiffness that is not counted is rendered stiffer than the device can bear; what yields \
            and comes back by itself lifts the hand",
    instead: "every part is a spring in series with what only loses, counted in the wall's bound; an \
              imprint heals only as friction pays for it",
};
/// Strokes on each device; `LAWS` × devices × this many in all.
const EACH: usize = 40;
/// Ticks of a stroke.
const TICKS: usize = 400;
/// The wall below the laws, N/m and N·s/m.
const WALL: (f64, f64) = (300.0, 0.05);
/// The strongest drag, N: at 0.3 m/s in 5 mm.
const DRAG_N: f64 = 1.65;

/// The laws, part by part and all together.
fn laws() -> [(&'static str, ContactLaw); 7] {
    let none = ContactLaw::default();
    let point = |depth_mm, force_n| SpringPoint { depth_mm, force_n };
    let spring = vec![point(2.0, 0.1), point(4.0, 0.2), point(5.0, 0.6)];
    let relaxation = Some(Relaxation {
        stiffness_n_m: 250.0,
        time_s: 0.05,
    });
    let imprint = Some(Imprint {
        yield_mm: 0.3,
        share: 0.8,
        heal: 0.3,
        recovery_s: 0.1,
    });
    let drag = Some(Drag {
        viscous_n_s_m2: 900.0,
        plough_n_m: 60.0,
    });
    let adhesion = Some(Adhesion {
        pull_n: 0.4,
        stiffness_n_m: 200.0,
    });
    [
        (
            "a spring with a shape",
            ContactLaw {
                spring: spring.clone(),
                ..none.clone()
            },
        ),
        (
            "damping over the load",
            ContactLaw {
                damping_s_m: 1.0,
                ..none.clone()
            },
        ),
        (
            "relaxation",
            ContactLaw {
                relaxation,
                ..none.clone()
            },
        ),
        (
            "an imprint",
            ContactLaw {
                imprint,
                ..none.clone()
            },
        ),
        (
            "drag",
            ContactLaw {
                drag,
                ..none.clone()
            },
        ),
        ("adhesion", ContactLaw { adhesion, ..none }),
        (
            "all parts",
            ContactLaw {
                spring,
                damping_s_m: 1.0,
                relaxation,
                imprint,
                drag,
                adhesion,
            },
        ),
    ]
}

/// The rows: each law on devices of nine dampings, without and with delay, beside a linear wall; drag also
/// beside Coulomb friction as strong, of which it may give off a quarter more, since a device that bears no wall still feels it.
///
/// # Errors
/// None for the built-in texture.
pub fn rows(seed: u64) -> Result<Vec<ScenarioResult>, StabilityError> {
    rows_of(seed, EACH)
}

/// [`rows`] of so many strokes on each of the 27 devices of each of the seven laws.
///
/// # Errors
/// None for the built-in texture.
pub fn rows_of(seed: u64, each: usize) -> Result<Vec<ScenarioResult>, StabilityError> {
    let wall = Material::giving_way(WALL, None)?;
    let worst = |material: &Material| [0, 1, 2].map(|delay| worst_mj(material, delay, seed, each));
    let walls = worst(&wall);
    let frictions = [0, 1, 2].map(|delay| friction_mj(delay, seed, each));
    let mut rows = Vec::new();
    for (name, law) in laws() {
        let drags = law.drag.is_some();
        let material = Material::giving_way(WALL, Some(law))?;
        for (delay, ours) in (0..).zip(worst(&material)) {
            let (wall, friction) = (walls[delay], frictions[delay]);
            rows.push(STROKES.row(
                format!("{name}, damping 0.005–1 N·s/m, {delay} ticks of delay"),
                ours,
                (1e3 * ROUNDING_J).max(if drags { wall + 1.25 * friction } else { wall }),
                &[("a linear wall", wall), ("1.65 N of friction", friction)],
            ));
        }
    }
    Ok(rows)
}

/// Largest energy that any of `each` random strokes on each of nine devices gets out of a material, less
/// what the device absorbed, mJ.
#[must_use]
pub fn worst_mj(material: &Material, delay_ticks: u32, seed: u64, each: usize) -> f64 {
    over_devices(delay_ticks, seed, each, |bench| {
        let renderer = renderer(bench);
        move || {
            let (renderer, mut state) = (renderer.clone(), State::new(1));
            move |[x, z]: [f64; 2]| {
                let sample = Sample::at([x as f32, 0.0, z as f32]);
                let output = renderer.tick(&material.slot, &mut state, &sample);
                [output.force_n[0], output.force_n[2]].map(f64::from)
            }
        }
    })
}

/// The same of the bristle alone, at the strongest drag's force wherever there is contact.
fn friction_mj(delay_ticks: u32, seed: u64, each: usize) -> f64 {
    over_devices(delay_ticks, seed, each, |_| {
        move || {
            let mut bristle = ours(1.0, delay_ticks);
            move |[x, z]: [f64; 2]| [bristle(x, if z < 0.0 { DRAG_N } else { 0.0 }), 0.0]
        }
    })
}

/// The worst stroke, mJ. `servo` makes what answers the strokes on a device with forces, N.
fn over_devices<M, S>(delay_ticks: u32, seed: u64, each: usize, servo: impl Fn(&Bench) -> M) -> f64
where
    M: Fn() -> S,
    S: FnMut([f64; 2]) -> [f64; 2],
{
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed + 97 * u64::from(delay_ticks));
    let mut worst = 0.0_f64;
    for damping_n_s_m in DAMPINGS_N_S_M {
        let bench = Bench::viscous(damping_n_s_m, delay_ticks);
        let fresh = servo(&bench);
        for _ in 0..each {
            worst = worst.max(1e3 * given_j(fresh(), &bench, &stroke(&mut rng)));
        }
    }
    worst
}

/// A renderer that knows the device and has no limits of its own.
fn renderer(bench: &Bench) -> Renderer {
    let mut config = Config {
        mechanics: bench.mechanics(),
        ..Config::default()
    };
    config.limits.slew_n_s = 1e6;
    Renderer::new(&config).expect("in range")
}

/// Positions, m, along and away from the surface: from the open into the material and back.
fn stroke(rng: &mut Xoshiro256PlusPlus) -> Vec<[f64; 2]> {
    let mut range = |low: f64, high: f64| low + (high - low) * unit(rng);
    let mut wave = |most_m: f64, fastest_m_s: f64, hz: (f64, f64)| {
        let hz = range(hz.0.ln(), hz.1.ln()).exp();
        let phase = range(0.0, TAU);
        let amplitude = most_m.min(fastest_m_s / (TAU * hz)) * range(0.0, 1.0);
        move |t: f64| amplitude * ((TAU * hz * t + phase).sin() - phase.sin())
    };
    let x = [wave(0.02, 0.3, (0.5, 8.0)), wave(2e-3, 0.1, (4.0, 60.0))];
    let z = [wave(4e-3, 0.3, (0.5, 8.0)), wave(1e-3, 0.3, (8.0, 200.0))];
    let depth = range(0.5e-3, 5e-3);
    let span = TICKS as f64 * TICK_S;
    (0..TICKS)
        .map(|n| {
            let t = n as f64 * TICK_S;
            let envelope = (2.0 * (std::f64::consts::PI * t / span).sin()).min(1.0);
            [
                envelope * (x[0](t) + x[1](t)),
                1e-3 + envelope * (z[0](t) + z[1](t) - depth - 1e-3),
            ]
        })
        .collect()
}

/// Largest energy on the way, J. Nothing is stored at the beginning.
fn given_j(mut servo: impl FnMut([f64; 2]) -> [f64; 2], bench: &Bench, path: &[[f64; 2]]) -> f64 {
    let absorber = Absorber {
        damping_n_s_m: bench.damping_n_s_m,
        coulomb_n: bench.coulomb_n,
    };
    let mut late: VecDeque<[f64; 2]> = vec![[0.0; 2]; bench.delay_ticks as usize].into();
    let (mut sum, mut worst) = (0.0, 0.0_f64);
    for pair in path.windows(2) {
        late.push_back(servo(pair[0]));
        let held = late.pop_front().unwrap_or_default();
        for axis in 0..2 {
            let mut observer = Observer::default();
            observer.tick(&absorber, held[axis], pair[1][axis] - pair[0][axis], TICK_S);
            sum += observer.given_j - observer.absorbed_j;
        }
        worst = worst.max(sum);
    }
    worst
}

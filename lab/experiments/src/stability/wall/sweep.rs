//! Energy that a wall gives off to the worst of many hands, along closed paths.

use std::collections::VecDeque;
use std::f64::consts::TAU;

use asperity_runtime::quantity::Quantity;
use asperity_runtime::{Config, Passivity, Renderer, Sample, State, Wall};

use super::bench::{Bench, DAMPINGS_N_S_M, REPORTED, ROUNDING_J, TICK_S, as_given, told};
use crate::stability::material::Material;
use crate::stability::observer::Observer;
use asperity_sim::device::to_step;

/// Frequencies at which the worst hand moves, Hz.
const FREQUENCIES_HZ: [f64; 12] = [
    1.0, 3.0, 10.0, 20.0, 40.0, 70.0, 110.0, 170.0, 230.0, 300.0, 380.0, 460.0,
];
/// Depths about which it moves, m. About 0 it leaves the surface and comes back.
const DEPTHS_M: [f64; 2] = [2.5e-3, 0.0];
/// Moves the stylus along `path` whatever the force, and observes the energy.
///
/// `path` gives the height at a tick, m. `servo` answers a measured height with a normal force.
fn observe(
    bench: &Bench,
    ticks: usize,
    path: impl Fn(usize) -> f64,
    mut servo: impl FnMut(f64) -> f64,
) -> Observer {
    let mut queue: VecDeque<f64> = vec![0.0; bench.delay_ticks as usize].into();
    let (absorber, mut observer) = (bench.absorber(), Observer::default());
    for n in 0..ticks {
        queue.push_back(servo(to_step(path(n), bench.position_step_m)));
        let held_n = queue.pop_front().unwrap_or(0.0);
        observer.tick(&absorber, held_n, path(n + 1) - path(n), TICK_S);
    }
    observer
}

/// A closed path: down from 1 mm above the surface, a second of sinusoid about `-depth_m`, and
/// up again. Returns its ticks and its height at a tick, m.
fn sinusoid(depth_m: f64, frequency_hz: f64, fastest_m_s: f64) -> (usize, impl Fn(usize) -> f64) {
    let amplitude_m = (0.9 * fastest_m_s / (TAU * frequency_hz)).min(2.4e-3);
    let (approach, cycles) = (200, 1000);
    let (above_m, blend) = (1e-3, move |n: usize| {
        let t = (n as f64 / approach as f64).min(1.0);
        t * t * (3.0 - 2.0 * t)
    });
    let height = move |n: usize| {
        let down = if n < approach + cycles {
            blend(n)
        } else {
            blend((2 * approach + cycles).saturating_sub(n))
        };
        let in_cycle = (approach..approach + cycles).contains(&n);
        let turn = frequency_hz * TICK_S * n.saturating_sub(approach) as f64;
        let swing = if in_cycle {
            amplitude_m * (TAU * turn).sin()
        } else {
            0.0
        };
        above_m + down * (-depth_m - above_m) + swing
    };
    (2 * approach + cycles + 1, height)
}

/// Largest energy that any of the hands gets out of the wall, less what the device absorbed, J.
///
/// `servo` makes a new servo for every path.
fn worst_j<S: FnMut(f64) -> f64>(bench: &Bench, servo: impl Fn() -> S) -> f64 {
    let fastest = f64::from(Config::default().mechanics.fastest_m_s);
    let mut worst = 0.0_f64;
    for depth_m in DEPTHS_M {
        for frequency_hz in FREQUENCIES_HZ {
            let (ticks, path) = sinusoid(depth_m, frequency_hz, fastest);
            worst = worst.max(observe(bench, ticks, path, servo()).worst_j);
        }
    }
    worst
}

/// The whole runtime as a servo along z.
pub(super) fn rendered<'a>(
    renderer: &'a Renderer,
    material: &'a Material,
) -> impl FnMut(f64) -> f64 + 'a {
    let mut state = State::new(1);
    move |z| {
        let sample = Sample::at([0.0, 0.0, z as f32]);
        f64::from(renderer.tick(&material.slot, &mut state, &sample).force_n[2])
    }
}

/// The law of the wall alone, without the filters and limits of the tick.
fn law(wall: Wall) -> impl FnMut(f64) -> f64 {
    let mut last = None;
    move |z| {
        let outward_m_s = (z - last.replace(z).unwrap_or(z)) / TICK_S;
        let depth = Quantity::of((-z).max(0.0) as f32);
        let forces = wall.step(depth, Quantity::of(outward_m_s as f32));
        f64::from(forces.total.value())
    }
}

/// Worst net energy of our wall on a device, J.
#[must_use]
pub fn ours_j(bench: &Bench, material: &Material) -> f64 {
    let renderer = told(bench.mechanics());
    worst_j(bench, || rendered(&renderer, material))
}

/// Worst net energy of the wall as the asset gives it, J.
#[must_use]
pub fn given_j(bench: &Bench, material: &Material) -> f64 {
    let renderer = as_given();
    worst_j(bench, || rendered(&renderer, material))
}

/// Worst net energy of a wall's law alone, J.
#[must_use]
pub fn law_j(bench: &Bench, wall: Wall) -> f64 {
    worst_j(bench, || law(wall))
}

/// Returns the number of lowered walls in the viscous sweep, and of those that would stay passive if 5 % stiffer.
#[must_use]
pub fn lowered_walls() -> (usize, usize) {
    let (mut lowered, mut slack) = (0, 0);
    for delay in 0..=3 {
        for b in DAMPINGS_N_S_M {
            let bench = Bench::viscous(b, delay);
            let passivity = Passivity::new(&bench.mechanics(), 3.3, 1000.0);
            let mut wall = passivity.bear(Wall::of(REPORTED.0 as f32, REPORTED.1 as f32));
            if f64::from(wall.stiffness.value()) < REPORTED.0 {
                wall.stiffness = Quantity::of(1.05 * wall.stiffness.value());
                lowered += 1;
                slack += usize::from(law_j(&bench, wall) <= ROUNDING_J);
            }
        }
    }
    (lowered, slack)
}

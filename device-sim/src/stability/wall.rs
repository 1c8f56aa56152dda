//! Stiff walls: against the passivity bound, late, with samples lost, by counts, in hands.

use std::collections::VecDeque;
use std::f64::consts::TAU;

use asperity_runtime::{Config, MechanicsConfig, Passivity, Renderer, Sample, State, Wall};

use super::observer::{Absorber, Observer};
use super::{Material, Row, StabilityError, Words};
use crate::axis::Coupling;
use crate::device::{Device, DeviceConfig, to_step};
use crate::fault::{Fault, FaultInjector, FaultPlan};
use crate::hand::{Grip, GripPreset, Motion, Script};
use crate::servo::{RenderedTexture, Servo};
use crate::session::{Record, Session};

/// Servo period, s.
pub const TICK_S: f64 = 1e-3;
/// The wall that the driver of the Touch reports, N/m, and our default damping, N·s/m.
pub const REPORTED: (f64, f64) = (500.0, 0.1);
/// Physical damping over which walls are tried, N·s/m.
pub const DAMPINGS_N_S_M: [f64; 9] = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 1.0];
/// Frequencies at which the worst hand moves, Hz.
const FREQUENCIES_HZ: [f64; 12] = [
    1.0, 3.0, 10.0, 20.0, 40.0, 70.0, 110.0, 170.0, 230.0, 300.0, 380.0, 460.0,
];
/// Depth about which it moves, m; at the surface it leaves and enters.
const DEPTHS_M: [f64; 2] = [2.5e-3, 0.0];
/// Rounding of f32 forces over a second of motion, J.
pub const ROUNDING_J: f64 = 2e-8;

/// A device as the sweeps vary it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bench {
    /// Physical damping, N·s/m.
    pub damping_n_s_m: f64,
    /// Coulomb friction, N.
    pub coulomb_n: f64,
    /// One count of position, m; 0 for a perfect sensor.
    pub position_step_m: f64,
    /// Ticks of delay on top of the hold.
    pub delay_ticks: u32,
}

impl Bench {
    /// Viscous damping alone: the strictest case.
    #[must_use]
    pub fn viscous(damping_n_s_m: f64, delay_ticks: u32) -> Self {
        Self {
            damping_n_s_m,
            coulomb_n: 0.0,
            position_step_m: 0.0,
            delay_ticks,
        }
    }

    /// What the runtime is told.
    #[must_use]
    pub fn mechanics(&self) -> MechanicsConfig {
        MechanicsConfig {
            damping_n_s_m: self.damping_n_s_m as f32,
            coulomb_n: self.coulomb_n as f32,
            position_step_m: self.position_step_m as f32,
            delay_ticks: self.delay_ticks,
            ..Config::default().mechanics
        }
    }

    fn absorber(&self) -> Absorber {
        Absorber {
            damping_n_s_m: self.damping_n_s_m,
            coulomb_n: self.coulomb_n,
        }
    }
}

/// A renderer that is told nothing of limits: the wall as the asset gives it.
fn as_given() -> Renderer {
    let mut config = Config::default();
    config.mechanics.damping_n_s_m = 1000.0;
    config.mechanics.coulomb_n = 1000.0;
    config.mechanics.delay_ticks = 0;
    Renderer::new(&config).expect("in range")
}

/// A renderer that knows the device.
fn told(mechanics: MechanicsConfig) -> Renderer {
    let config = Config {
        mechanics,
        ..Config::default()
    };
    Renderer::new(&config).expect("in range")
}

/// Lets a hand move the stylus along `path` (height in m at a tick) whatever the force, and
/// observes the energy. `servo` answers a measured height with a normal force.
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

/// Down from 1 mm above, a second of sinusoid about `-depth_m`, and up again: a closed path.
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

/// Largest energy that the worst of the hands gets out of the wall, net of what the device
/// absorbed, J; `servo` makes a fresh one for every path.
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
fn rendered<'a>(renderer: &'a Renderer, material: &'a Material) -> impl FnMut(f64) -> f64 + 'a {
    let mut state = State::new(1);
    move |z| {
        let sample = Sample::at([0.0, 0.0, z as f32]);
        f64::from(renderer.tick(&material.slot, &mut state, &sample).force_n[2])
    }
}

/// The law of the wall alone, without filters and limits around it.
fn law(wall: Wall) -> impl FnMut(f64) -> f64 {
    let mut last = None;
    move |z| {
        let outward_m_s = (z - last.replace(z).unwrap_or(z)) / TICK_S;
        let spring_n = f64::from(wall.stiffness_n_m) * (-z).max(0.0);
        f64::from(wall.force_n(spring_n as f32, outward_m_s as f32))
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

/// Height from which the stylus is dropped, m.
const DROP_M: f64 = 2e-3;

/// Heights, m, of a stylus of the Touch's mass that nobody holds, dropped onto the wall under a
/// constant 0.5 N, a tick each for 5 s.
///
/// # Errors
/// None for the built-in device.
pub fn dropped(
    bench: &Bench,
    material: &Material,
    lowered: bool,
) -> Result<Vec<f64>, StabilityError> {
    let mut device = DeviceConfig::touch()?;
    device.mechanics.damping_n_s_m = [bench.damping_n_s_m; 3];
    device.mechanics.coulomb_n = [bench.coulomb_n; 3];
    device.sensor.position_step_mm = 1e3 * bench.position_step_m;
    device.timing.transport_delay_ticks = bench.delay_ticks as usize;
    let renderer = if lowered {
        told(bench.mechanics())
    } else {
        as_given()
    };
    let mut servo = rendered(&renderer, material);
    let mut stylus = Device::new(&device, 0.0, [0.0, 0.0, DROP_M]);
    let mut press = [Coupling::default(); 3];
    press[2].force_n = -0.5;
    Ok((0..5000)
        .map(|_| {
            let height_m = stylus.position_m()[2];
            let force_n = servo(stylus.measured_m()[2]);
            stylus.command([0.0, 0.0, force_n]);
            stylus.advance(TICK_S, |_, _| press);
            height_m
        })
        .collect())
}

/// Highest rebound over the height of the drop.
fn rebound(height_m: &[f64]) -> f64 {
    let met = height_m.iter().position(|&z| z < 0.0).unwrap_or(0);
    height_m[met..].iter().copied().fold(0.0, f64::max) / DROP_M
}

/// Net energy along z of a recorded session, J: the device's force against its motion.
fn net_j(device: &DeviceConfig, records: &[Record]) -> f64 {
    let absorber = Absorber {
        damping_n_s_m: device.mechanics.damping_n_s_m[2],
        coulomb_n: device.mechanics.coulomb_n[2],
    };
    let mut observer = Observer::default();
    for pair in records.windows(2) {
        let motion_m = pair[1].true_m[2] - pair[0].true_m[2];
        observer.tick(&absorber, pair[0].device_n[2], motion_m, TICK_S);
    }
    observer.worst_j
}

/// The Touch's mass on a device that absorbs next to nothing, with a perfect sensor.
fn frictionless() -> Result<DeviceConfig, StabilityError> {
    let mut device = DeviceConfig::touch()?;
    device.mechanics.damping_n_s_m = [0.02; 3];
    device.mechanics.coulomb_n = [0.0; 3];
    device.sensor.position_step_mm = 0.0;
    Ok(device)
}

/// Taps, a press and a rest of a hand on the simulated Touch, behind faults.
fn in_a_hand<S: Servo>(
    device: &DeviceConfig,
    preset: GripPreset,
    servo: S,
    plan: FaultPlan,
    seed: u64,
) -> Result<f64, StabilityError> {
    let script = Script::new(vec![
        Motion::Tap { speed_m_s: 0.1 },
        Motion::Tap { speed_m_s: 0.3 },
        Motion::Press {
            force_n: 2.0,
            duration_s: 1.0,
        },
        Motion::Rest {
            force_n: 1.0,
            duration_s: 1.0,
        },
    ]);
    let servo = FaultInjector::new(servo, plan, seed).expect("a plan that makes sense");
    let mut session = Session::new(device, Grip::preset(preset)?, script, servo);
    let records = session.run(8000);
    Ok(net_j(device, &records))
}

const SWEEP: Words = Words {
    theme: "wall",
    quantity: "net energy given off to the worst hand (mJ)",
    fails: "a force held for a tick is late on the way out: b ≥ K·T/2·(1 + 2n) + |B| or it gives \
            off energy",
    instead: "the runtime knows damping, friction and delay of the device: it takes back rendered \
              damping, then stiffness, as far as the bound asks",
};
const TIGHT: Words = Words {
    quantity: "walls that could have been 5 % stiffer",
    fails: "a wall lowered more than the bound asks is softer than it need be",
    instead: "the bound is met with equality: 5 % more gives off energy to some hand",
    ..SWEEP
};
const DROP: Words = Words {
    quantity: "highest rebound over the height of the drop",
    fails: "no hand damps it: what the wall gives off makes it bounce higher",
    ..SWEEP
};
const HANDS: Words = Words {
    quantity: "net energy given off along the normal (mJ)",
    fails: "a firm grip adds mass, not only damping; delay and lost samples lengthen the hold",
    ..SWEEP
};
const LOST: Words = Words {
    instead: "a loop that may lose two samples in a row counts as two ticks later",
    ..HANDS
};

/// The rows.
///
/// # Errors
/// None for the built-in files.
pub fn rows(seed: u64) -> Result<Vec<Row>, StabilityError> {
    let silent = Material::silent(REPORTED.0, REPORTED.1)?;
    let mut rows = Vec::new();
    for delay in 0..=3 {
        let worst = |figure: fn(&Bench, &Material) -> f64| {
            DAMPINGS_N_S_M
                .iter()
                .map(|&b| 1e3 * figure(&Bench::viscous(b, delay), &silent))
                .fold(0.0, f64::max)
        };
        rows.push(SWEEP.row(
            format!("damping 0.005–1 N·s/m, no friction, {delay} ticks of delay, 1–460 Hz"),
            worst(ours_j),
            1e3 * ROUNDING_J,
            &[("500 N/m as given", worst(given_j))],
        ));
    }
    let (lowered, slack) = lowered_walls();
    rows.push(TIGHT.row(
        format!("the {lowered} walls of the four rows above that are lowered"),
        slack as f64,
        0.0,
        &[],
    ));
    for delay in [0, 2] {
        let worst = |figure: fn(&Bench, &Material) -> f64| {
            DAMPINGS_N_S_M
                .iter()
                .map(|&damping_n_s_m| {
                    let bench = Bench {
                        damping_n_s_m,
                        coulomb_n: 0.26,
                        position_step_m: 0.055e-3,
                        delay_ticks: delay,
                    };
                    1e3 * figure(&bench, &silent)
                })
                .fold(0.0, f64::max)
        };
        rows.push(SWEEP.row(
            format!("the same with 0.26 N of friction and counts of 0.055 mm, {delay} ticks"),
            worst(ours_j),
            1e3 * ROUNDING_J,
            &[("500 N/m as given", worst(given_j))],
        ));
    }
    for delay in [0, 1, 2] {
        let bench = Bench::viscous(0.1, delay);
        let ratio = |lowered| dropped(&bench, &silent, lowered).map(|z| rebound(&z));
        rows.push(DROP.row(
            format!("45 g dropped from 2 mm with 0.5 N, b = 0.1 N·s/m, {delay} ticks of delay"),
            ratio(true)?,
            1.0,
            &[("500 N/m as given", ratio(false)?)],
        ));
    }
    for (grip, preset) in [("light", GripPreset::Light), ("firm", GripPreset::Firm)] {
        for delay in [0, 2] {
            let mut device = frictionless()?;
            device.timing.transport_delay_ticks = delay;
            let energy = |renderer| {
                let servo = RenderedTexture::new(renderer, &silent.slot, seed);
                in_a_hand(&device, preset, servo, FaultPlan::default(), seed).map(|j| 1e3 * j)
            };
            rows.push(HANDS.row(
                format!(
                    "taps, press and rest, b = 0.02 N·s/m, {grip} grip, {delay} ticks of delay"
                ),
                energy(told(device.mechanics_config()))?,
                1e3 * ROUNDING_J,
                &[("500 N/m as given", energy(as_given())?)],
            ));
        }
    }
    for (name, fault) in [("dropped", Fault::Dropped), ("late", Fault::Late)] {
        let device = frictionless()?;
        let plan = FaultPlan::default().with(fault, 0.05, 2);
        let energy = |renderer| {
            let servo = RenderedTexture::new(renderer, &silent.slot, seed);
            in_a_hand(&device, GripPreset::Firm, servo, plan, seed).map(|j| 1e3 * j)
        };
        let told_of_two = MechanicsConfig {
            delay_ticks: 2,
            ..device.mechanics_config()
        };
        rows.push(LOST.row(
            format!("the same, firm, one tick in 20 starts a run of up to 2 {name} samples"),
            energy(told(told_of_two))?,
            1e3 * ROUNDING_J,
            &[("500 N/m as given", energy(as_given())?)],
        ));
    }
    Ok(rows)
}

/// How many walls of the viscous sweep are lowered, and how many of these stay passive if made
/// 5 % stiffer.
#[must_use]
pub fn lowered_walls() -> (usize, usize) {
    let (mut lowered, mut slack) = (0, 0);
    for delay in 0..=3 {
        for b in DAMPINGS_N_S_M {
            let bench = Bench::viscous(b, delay);
            let passivity = Passivity::new(&bench.mechanics(), 1000.0);
            let mut wall = passivity.wall(REPORTED.0 as f32, REPORTED.1 as f32);
            if f64::from(wall.stiffness_n_m) < REPORTED.0 {
                wall.stiffness_n_m *= 1.05;
                lowered += 1;
                slack += usize::from(law_j(&bench, wall) <= ROUNDING_J);
            }
        }
    }
    (lowered, slack)
}

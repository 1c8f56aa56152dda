//! Stiff walls against the passivity bound: with delay, lost samples, counts of position, and in
//! a hand.

mod bench;
mod sweep;

pub use bench::{Bench, DAMPINGS_N_S_M, REPORTED, ROUNDING_J, TICK_S};
pub use sweep::{given_j, law_j, lowered_walls, ours_j};

use super::{
    error::StabilityError,
    material::Material,
    row::{ScenarioResult, Words},
};
use crate::stability::observer::{Absorber, Observer};
use asperity_runtime::MechanicsConfig;
use asperity_sim::{
    axis::Pull,
    device::{Device, DeviceConfig},
    fault::{FaultInjector, FaultPlan, SampleFault},
    hand::{Grip, GripPreset, Motion, Script},
    servo::{RenderedTexture, Servo},
    session::{Record, Session},
};
use bench::{as_given, told};
use sweep::rendered;

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
pub fn rows(seed: u64) -> Result<Vec<ScenarioResult>, StabilityError> {
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
    for (name, fault) in [
        ("dropped", SampleFault::Dropped),
        ("late", SampleFault::Late),
    ] {
        let device = frictionless()?;
        let plan = FaultPlan::default().with(fault, 0.05, 2);
        let energy = |renderer| {
            let servo = RenderedTexture::new(renderer, &silent.slot, seed);
            in_a_hand(&device, GripPreset::Firm, servo, plan.clone(), seed).map(|j| 1e3 * j)
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

// A stylus that nobody holds, dropped onto the wall.

/// Height from which the stylus is dropped, m.
const DROP_M: f64 = 2e-3;

/// Heights at each tick, m, of a stylus of the Touch's mass that nobody holds. It is dropped onto
/// the wall under a constant 0.5 N, for 5 s.
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
    let mut press = [Pull::default(); 3];
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

/// Highest rebound divided by the height of the drop.
fn rebound(height_m: &[f64]) -> f64 {
    let met = height_m.iter().position(|&z| z < 0.0).unwrap_or(0);
    height_m[met..].iter().copied().fold(0.0, f64::max) / DROP_M
}

// A hand on the simulated Touch against the wall, behind faults.

/// Largest net energy that the device's force gave off along z in a session, J.
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

/// A device of the Touch's mass with almost no damping, no friction and a perfect sensor.
fn frictionless() -> Result<DeviceConfig, StabilityError> {
    let mut device = DeviceConfig::touch()?;
    device.mechanics.damping_n_s_m = [0.02; 3];
    device.mechanics.coulomb_n = [0.0; 3];
    device.sensor.position_step_mm = 0.0;
    Ok(device)
}

/// Largest net energy, J, over taps, a press and a rest of a hand, with faults.
fn in_a_hand<S: Servo>(
    device: &DeviceConfig,
    preset: GripPreset,
    servo: S,
    plan: FaultPlan<SampleFault>,
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
    let servo = FaultInjector::new(servo, plan, seed);
    let mut session = Session::new(device, Grip::preset(preset)?, script, servo);
    let records = session.run(8000);
    Ok(net_j(device, &records))
}

//! Stiff walls against the passivity bound: with delay, lost samples, counts of position, and in
//! a hand.

mod bench;
mod drop;
mod hold;
mod sweep;

pub use bench::{Bench, DAMPINGS_N_S_M, REPORTED, ROUNDING_J, TICK_S};
pub use drop::dropped;
pub use sweep::{given_j, law_j, lowered_walls, ours_j};

use asperity_runtime::MechanicsConfig;

use super::error::StabilityError;
use super::material::Material;
use super::row::{Row, Words};
use asperity_sim::fault::{FaultPlan, SampleFault};
use asperity_sim::hand::GripPreset;
use asperity_sim::servo::RenderedTexture;
use bench::{as_given, told};
use drop::rebound;
use hold::{frictionless, in_a_hand};

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
    for (name, fault) in [
        ("dropped", SampleFault::Dropped),
        ("late", SampleFault::Late),
    ] {
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

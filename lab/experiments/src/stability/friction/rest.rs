//! Friction laws at rest: sign changes, non-finite forces, and a hand that rests after a stroke.

use asperity_runtime::{Output, Sample};
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::law::Law;
use crate::stability::error::StabilityError;
use asperity_sim::device::DeviceConfig;
use asperity_sim::hand::{Grip, GripPreset, Motion, Script};
use asperity_sim::servo::{Servo, silence};
use asperity_sim::session::Session;

/// Position resolution (a count), m.
const COUNT_M: f64 = 0.055e-3;

/// Positions, m: a stroke at 100 mm/s for 200 ms, then rest with noise of ±1 count.
pub fn stroke_and_rest(seed: u64, ticks: usize) -> impl Iterator<Item = f64> {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut base_m = 0.0;
    (0..ticks).map(move |n| {
        base_m += if n < 200 { 0.1e-3 } else { 0.0 };
        base_m + ((rng.next_u64() % 3) as f64 - 1.0) * COUNT_M
    })
}

/// Changes of sign per second over 10 s of rest with noise of ±1 count, after a stroke.
pub(super) fn flips_at_rest(law: &mut Law, seed: u64) -> f64 {
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

/// Returns the number of non-finite forces out of 1000 at exactly zero speed.
pub(super) fn not_finite_at_rest(mut law: impl FnMut(f64) -> f64) -> f64 {
    (0..1000).filter(|_| !law(0.0).is_finite()).count() as f64
}

/// RMS of the stylus's speed along the stroke about its mean over 50 ms, mm/s, while a light
/// grip rests after a stroke.
pub(super) fn rest_in_a_hand<S: Servo>(servo: S) -> Result<f64, StabilityError> {
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
pub(super) fn wall_with(mut law: Law) -> impl FnMut(&Sample) -> Output {
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

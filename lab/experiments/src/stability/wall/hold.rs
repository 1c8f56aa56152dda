//! A hand on the simulated Touch against the wall, behind faults.

use super::bench::TICK_S;
use crate::stability::error::StabilityError;
use crate::stability::observer::{Absorber, Observer};
use asperity_sim::device::DeviceConfig;
use asperity_sim::fault::{FaultInjector, FaultPlan};
use asperity_sim::hand::{Grip, GripPreset, Motion, Script};
use asperity_sim::servo::Servo;
use asperity_sim::session::{Record, Session};

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
pub(super) fn frictionless() -> Result<DeviceConfig, StabilityError> {
    let mut device = DeviceConfig::touch()?;
    device.mechanics.damping_n_s_m = [0.02; 3];
    device.mechanics.coulomb_n = [0.0; 3];
    device.sensor.position_step_mm = 0.0;
    Ok(device)
}

/// Largest net energy, J, over taps, a press and a rest of a hand, with faults.
pub(super) fn in_a_hand<S: Servo>(
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

//! A stylus that nobody holds, dropped onto the wall.

use super::bench::{Bench, TICK_S, as_given, told};
use super::sweep::rendered;
use crate::stability::error::StabilityError;
use crate::stability::material::Material;
use asperity_sim::axis::Pull;
use asperity_sim::device::{Device, DeviceConfig};

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
pub(super) fn rebound(height_m: &[f64]) -> f64 {
    let met = height_m.iter().position(|&z| z < 0.0).unwrap_or(0);
    height_m[met..].iter().copied().fold(0.0, f64::max) / DROP_M
}

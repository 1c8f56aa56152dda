//! A simulated haptic device: the positions that a servo reads, and what its forces do.

mod config;
mod delay;
mod quantise;

pub use config::{Actuator, DeviceConfig, Mechanics, Sensor, Timing, Workspace};
pub use delay::Delay;
pub use quantise::{converter_step, to_step};

use crate::axis::{AxisParams, AxisState, Pull};

/// Integration steps in a servo tick. At 16 kHz the integrator does not limit stability; the
/// contact does, since the servo holds its force for a whole tick.
pub const SUBSTEPS: u32 = 16;

/// Counts of altered commands and of hits of a workspace stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DeviceCounts {
    /// Commands scaled down to the peak force.
    pub clipped: u64,
    /// Commands that were NaN or infinite and became zero.
    pub not_finite: u64,
    /// Ticks in which a workspace stop was hit.
    pub at_stop: u64,
}

/// A device in virtual time: it moves only when told to.
#[derive(Debug, Clone)]
pub struct Device {
    axes: [AxisParams; 3],
    states: [AxisState; 3],
    half_extents_m: [f64; 3],
    position_step_m: f64,
    peak_force_n: f64,
    force_step_n: f64,
    delay: Delay<[f64; 3]>,
    force_n: [f64; 3],
    counts: DeviceCounts,
}

impl Device {
    /// A device at rest at `position_m`, with `carried_kg` of a hand's mass moving
    /// rigidly with the stylus (0 when nobody holds it).
    #[must_use]
    pub fn new(config: &DeviceConfig, carried_kg: f64, position_m: [f64; 3]) -> Self {
        let mechanics = &config.mechanics;
        let peak_force_n = config.actuator.peak_force_n;
        Self {
            axes: std::array::from_fn(|i| AxisParams {
                mass_kg: mechanics.mass_kg[i] + carried_kg,
                damping_n_s_m: mechanics.damping_n_s_m[i],
                coulomb_n: mechanics.coulomb_n[i],
            }),
            states: position_m.map(|position_m| AxisState {
                position_m,
                velocity_m_s: 0.0,
            }),
            half_extents_m: config.half_extents_m(),
            position_step_m: config.sensor.position_step_mm * 1e-3,
            peak_force_n,
            force_step_n: converter_step(peak_force_n, config.actuator.dac_bits),
            delay: Delay::new(config.timing.transport_delay_ticks, [0.0; 3]),
            force_n: [0.0; 3],
            counts: DeviceCounts::default(),
        }
    }

    /// True position, m.
    #[must_use]
    pub fn position_m(&self) -> [f64; 3] {
        self.states.map(|state| state.position_m)
    }

    /// True velocity, m/s.
    #[must_use]
    pub fn velocity_m_s(&self) -> [f64; 3] {
        self.states.map(|state| state.velocity_m_s)
    }

    /// Position as the encoders measure it, m.
    #[must_use]
    pub fn measured_m(&self) -> [f64; 3] {
        self.position_m()
            .map(|value| to_step(value, self.position_step_m))
    }

    /// Force that the actuators hold now, N.
    #[must_use]
    pub fn force_n(&self) -> [f64; 3] {
        self.force_n
    }

    /// Mass, damping and friction of each axis, the hand's mass included.
    #[must_use]
    pub fn axes(&self) -> &[AxisParams; 3] {
        &self.axes
    }

    /// The counts so far.
    #[must_use]
    pub fn counts(&self) -> DeviceCounts {
        self.counts
    }

    /// Takes one tick's force command, N. The force is limited to the peak in magnitude, rounded
    /// to the converter's step, and delayed.
    pub fn command(&mut self, force_n: [f64; 3]) {
        let mut accepted = force_n;
        let magnitude = norm(force_n);
        if !magnitude.is_finite() {
            self.counts.not_finite += 1;
            accepted = [0.0; 3];
        } else if magnitude > self.peak_force_n * (1.0 + 1e-6) {
            // The margin covers rounding of a command that was limited in single precision.
            self.counts.clipped += 1;
            accepted = force_n.map(|f| f * self.peak_force_n / magnitude);
        }
        let rounded = accepted.map(|f| to_step(f, self.force_step_n));
        self.force_n = self.delay.push(rounded);
    }

    /// Lets `tick_s` seconds pass under the held force.
    ///
    /// `hand` gives its pull at every sub-step, from the time within the tick in seconds and the
    /// states of the axes.
    pub fn advance(
        &mut self,
        tick_s: f64,
        mut hand: impl FnMut(f64, &[AxisState; 3]) -> [Pull; 3],
    ) {
        let step_s = tick_s / f64::from(SUBSTEPS);
        let mut stopped = false;
        for n in 1..=SUBSTEPS {
            let pull = hand(f64::from(n) * step_s, &self.states);
            for (axis, pull_axis) in pull.iter().enumerate() {
                let state = &mut self.states[axis];
                *state = state.step(&self.axes[axis], self.force_n[axis], pull_axis, step_s);
                stopped |= state.stop_at(self.half_extents_m[axis]);
            }
        }
        self.counts.at_stop += u64::from(stopped);
    }
}

/// Euclidean length.
#[must_use]
pub fn norm(v: [f64; 3]) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn touch() -> DeviceConfig {
        DeviceConfig::touch().expect("built-in file")
    }

    fn nobody(_: f64, _: &[AxisState; 3]) -> [Pull; 3] {
        [Pull::default(); 3]
    }

    #[test]
    fn a_command_acts_after_exactly_the_transport_delay() {
        for ticks in [0, 1, 5] {
            let mut config = touch();
            config.timing.transport_delay_ticks = ticks;
            let mut device = Device::new(&config, 0.0, [0.0; 3]);
            for n in 0..20 {
                device.command([1.0, 0.0, 0.0]);
                device.advance(1e-3, nobody);
                assert_eq!(
                    device.velocity_m_s()[0] > 0.0,
                    n >= ticks,
                    "delay {ticks}, tick {n}"
                );
            }
        }
    }

    #[test]
    fn commands_are_limited_in_magnitude_and_never_poison_the_motion() {
        let mut device = Device::new(&touch(), 0.0, [0.0; 3]);
        device.command([30.0, 40.0, 0.0]);
        let step = converter_step(3.3, 12);
        assert!((norm(device.force_n()) - 3.3).abs() <= step);
        assert!((device.force_n()[1] / device.force_n()[0] - 4.0 / 3.0).abs() < 0.01);
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            device.command([bad, 0.0, 1.0]);
            assert_eq!(device.force_n(), [0.0; 3]);
            device.advance(1e-3, nobody);
            assert!(device.position_m().iter().all(|x| x.is_finite()));
        }
        assert_eq!(device.counts().clipped, 1);
        assert_eq!(device.counts().not_finite, 3);
    }

    #[test]
    fn the_workspace_holds_the_stylus_and_counts_it() {
        let mut device = Device::new(&touch(), 0.0, [0.0; 3]);
        for _ in 0..2000 {
            device.command([0.0, 0.0, 3.0]);
            device.advance(1e-3, nobody);
        }
        assert_eq!(device.position_m()[2], 0.035);
        assert!(device.counts().at_stop > 1000);
    }

    #[test]
    fn a_spring_wall_rendered_on_the_device_does_not_blow_up() {
        // The force is held for a tick and quantised, but the damping of a light grip,
        // b = 4 N·s/m, exceeds K·T/2 (Colgate), so the contact must settle.
        for stiffness_n_m in [500.0, 1000.0, 2000.0] {
            let mut device = Device::new(&touch(), 0.04, [0.0, 0.0, 0.005]);
            let mut late_peak = 0.0_f64;
            for n in 0..3000 {
                let depth_m = (-device.measured_m()[2]).max(0.0);
                device.command([0.0, 0.0, stiffness_n_m * depth_m]);
                device.advance(1e-3, |_, _| {
                    let mut pull = [Pull::default(); 3];
                    pull[2] = Pull {
                        damping_n_s_m: 4.0,
                        force_n: -1.0,
                        ..pull[2]
                    };
                    pull
                });
                if n > 2000 {
                    late_peak = late_peak.max(device.velocity_m_s()[2].abs());
                }
            }
            let depth_m = -device.position_m()[2];
            assert!(
                late_peak < 0.01,
                "k = {stiffness_n_m}: still moving at {late_peak} m/s"
            );
            let slack_n = 0.26 + stiffness_n_m * 5.5e-5;
            assert!(
                (depth_m * stiffness_n_m - 1.0).abs() <= slack_n,
                "{depth_m}"
            );
        }
    }
}

//! The loop of device, servo and hand in virtual time, and the record of each tick.

use asperity_runtime::{Output, Sample};

use crate::device::{Device, DeviceConfig, DeviceCounts};
use crate::hand::{Grip, HOVER_M, Hand, Intent, Script};
use crate::servo::Servo;

/// Everything about one tick.
///
/// Positions and the output belong to the start of the tick; the device's force is the one held
/// during the tick.
#[derive(Debug, Clone, Copy)]
pub struct Record {
    /// Virtual time, s.
    pub t_s: f64,
    /// True position, m.
    pub true_m: [f64; 3],
    /// True velocity, m/s.
    pub true_m_s: [f64; 3],
    /// Position as measured, m.
    pub measured_m: [f64; 3],
    /// Output of the servo.
    pub output: Output,
    /// Force that the actuators held, after limit, rounding and delay, N.
    pub device_n: [f64; 3],
    /// Intent of the hand.
    pub intent: Intent,
}

/// Device, servo and hand.
#[derive(Debug)]
pub struct Session<S> {
    device: Device,
    hand: Hand,
    servo: S,
    servo_rate_hz: f64,
    tick: u64,
}

impl<S: Servo> Session<S> {
    /// A session that starts at rest, hovering over the middle of the surface.
    pub fn new(config: &DeviceConfig, grip: Grip, script: Script, servo: S) -> Self {
        let start_m = [0.0, 0.0, HOVER_M.min(0.5 * config.half_extents_m()[2])];
        Self {
            device: Device::new(config, grip.mass_kg, start_m),
            hand: Hand::new(grip, script, start_m),
            servo,
            servo_rate_hz: config.timing.servo_rate_hz,
            tick: 0,
        }
    }

    /// Lets one tick pass; `None` once the script has ended.
    pub fn tick(&mut self) -> Option<Record> {
        let tick_s = 1.0 / self.servo_rate_hz;
        let t_s = self.tick as f64 / self.servo_rate_hz;
        let true_m = self.device.position_m();
        let true_m_s = self.device.velocity_m_s();
        let stylus_z = crate::axis::AxisState {
            position_m: true_m[2],
            velocity_m_s: true_m_s[2],
        };
        let held_n = self.device.force_n();
        let intent = self
            .hand
            .plan(tick_s, &stylus_z, self.device.axes(), held_n[2])?;
        let measured_m = self.device.measured_m();
        let output = self.servo.tick(&Sample::at(measured_m.map(|x| x as f32)));
        self.device.command(output.force_n.map(f64::from));
        let device_n = self.device.force_n();
        let grip = self.hand.grip();
        self.device.advance(tick_s, |t_s, _| intent.pull(grip, t_s));
        self.tick += 1;
        Some(Record {
            t_s,
            true_m,
            true_m_s,
            measured_m,
            output,
            device_n,
            intent,
        })
    }

    /// Runs to the end of the script or for `ticks`, whichever comes first.
    pub fn run(&mut self, ticks: u64) -> Vec<Record> {
        let mut records = Vec::new();
        while self.tick < ticks {
            match self.tick() {
                Some(record) => records.push(record),
                None => break,
            }
        }
        records
    }

    /// Returns the counts of altered commands and of hits of a workspace stop.
    pub fn device_counts(&self) -> DeviceCounts {
        self.device.counts()
    }

    /// The script being worked through.
    pub fn script(&self) -> &Script {
        self.hand.script()
    }

    /// The servo.
    pub fn servo(&self) -> &S {
        &self.servo
    }

    /// The servo, for example to start a fault.
    pub fn servo_mut(&mut self) -> &mut S {
        &mut self.servo
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hand::{GripPreset, Motion, StrokePath};
    use crate::servo::silence;

    /// A wall with viscous-regularised friction of μ = 0.5.
    fn wall(stiffness_n_m: f32) -> impl FnMut(&Sample) -> Output {
        let mut last_x = 0.0_f32;
        let mut speed_m_s = 0.0_f32;
        move |sample| {
            let [x, _, z] = sample.position_m;
            speed_m_s += 0.1 * ((x - last_x) * 1000.0 - speed_m_s);
            last_x = x;
            let normal_n = stiffness_n_m * (-z).max(0.0);
            let friction_n = 0.5 * normal_n * (speed_m_s / 0.02).clamp(-1.0, 1.0);
            Output {
                force_n: [-friction_n, 0.0, normal_n],
                ..silence()
            }
        }
    }

    fn explore(preset: GripPreset, seed: u64, stiffness_n_m: f32) -> (Script, Vec<Record>) {
        let config = DeviceConfig::touch().expect("built-in file");
        let script = Script::exploration(seed, 1, config.half_extents_m());
        let grip = Grip::preset(preset).expect("built-in file");
        let mut session = Session::new(&config, grip, script.clone(), wall(stiffness_n_m));
        let records = session.run(30_000);
        assert_eq!(
            session.device_counts().at_stop,
            0,
            "the hand stays in the workspace"
        );
        (script, records)
    }

    fn mean(values: impl Iterator<Item = f64>) -> f64 {
        let (sum, count) = values.fold((0.0, 0.0), |(s, n), v| (s + v, n + 1.0));
        sum / count
    }

    /// Calls `check` for every motion of a script with its records, for both grips, soft and
    /// stiff walls and some seeds.
    fn each_motion(mut check: impl FnMut(&Motion, &[Record], f64)) {
        for preset in [GripPreset::Light, GripPreset::Firm] {
            for seed in 1..=6 {
                let stiffness_n_m = [500.0, 1000.0, 2000.0][seed as usize % 3];
                let (script, records) = explore(preset, seed, stiffness_n_m);
                for (index, motion) in script.motions().iter().enumerate() {
                    let of_motion: Vec<Record> = records
                        .iter()
                        .filter(|r| r.intent.motion == index)
                        .copied()
                        .collect();
                    assert!(!of_motion.is_empty(), "{motion} never ran");
                    check(motion, &of_motion, f64::from(stiffness_n_m));
                }
            }
        }
    }

    #[test]
    fn the_hand_meets_the_surface_at_the_scripted_speed() {
        each_motion(|motion, records, _| {
            if let Motion::Tap { speed_m_s } = *motion {
                let meets = |w: &&[Record]| w[0].true_m[2] > 0.0 && w[1].true_m[2] <= 0.0;
                let impact = records.windows(2).find(meets).expect("an impact");
                let error = -impact[0].true_m_s[2] / speed_m_s - 1.0;
                assert!(error.abs() < 0.03, "{motion}: {error:+.3}");
            }
        });
    }

    #[test]
    fn a_stroke_runs_at_its_speed_and_force() {
        each_motion(|motion, records, _| {
            if let Motion::Stroke {
                to_m,
                speed_m_s,
                force_n,
            } = *motion
            {
                let body: Vec<&Record> = records.iter().filter(|r| r.intent.in_body).collect();
                let from_m = body[0].intent.target_m;
                let distance_m = (to_m[0] - from_m[0]).hypot(to_m[1] - from_m[1]);
                let (start_s, end_s) = StrokePath::new(distance_m, speed_m_s).steady_s();
                // The hand lags by its damping over its stiffness, then is steady.
                let steady = body.iter().filter(|r| {
                    let t_s = r.t_s - body[0].t_s;
                    t_s > start_s + 0.1 && t_s < end_s
                });
                let speed = mean(steady.clone().map(|r| r.true_m_s[0].hypot(r.true_m_s[1])));
                let force = mean(steady.map(|r| r.device_n[2]));
                assert!((speed / speed_m_s - 1.0).abs() < 0.05, "{motion}: {speed}");
                assert!((force / force_n - 1.0).abs() < 0.1, "{motion}: {force}");
            }
        });
    }

    #[test]
    fn a_press_and_a_rest_reach_their_force() {
        each_motion(|motion, records, stiffness_n_m| match *motion {
            Motion::Press { force_n, .. } => {
                let peak = records.iter().map(|r| r.device_n[2]).fold(0.0, f64::max);
                assert!((peak / force_n - 1.0).abs() < 0.1, "{motion}: {peak}");
            }
            Motion::Rest { force_n, .. } => {
                let late = &records[records.len() - 100..];
                let held = mean(late.iter().map(|r| r.device_n[2]));
                // One count of position is k·Δ of force, and the hand leaves 0.02 N uncorrected.
                let grain_n = stiffness_n_m * 0.055e-3 + 0.02;
                assert!((held - force_n).abs() <= grain_n, "{motion}: {held}");
            }
            _ => {}
        });
    }

    #[test]
    fn the_same_seed_gives_the_same_bits_and_another_does_not() {
        let bits = |seed| -> Vec<u64> {
            let (_, records) = explore(GripPreset::Light, seed, 1000.0);
            records
                .iter()
                .flat_map(|r| r.true_m.map(f64::to_bits))
                .collect()
        };
        assert_eq!(bits(1), bits(1));
        assert_ne!(bits(1), bits(2));
    }

    #[test]
    fn a_hand_over_nothing_gives_up_landing_and_ends() {
        let config = DeviceConfig::touch().expect("built-in file");
        let script = Script::exploration(1, 1, config.half_extents_m());
        let grip = Grip::preset(GripPreset::Light).expect("built-in file");
        let nothing = |_: &Sample| silence();
        let mut session = Session::new(&config, grip, script, nothing);
        let records = session.run(60_000);
        assert!(records.len() < 20_000, "{}", records.len());
    }
}

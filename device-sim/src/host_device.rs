//! The simulated device, held by a simulated hand, behind the host's trait.

use crate::axis::{AxisState, Pull};
use crate::device::{Device as Mechanism, DeviceConfig};
use crate::hand::{Grip, HOVER_M, Hand, Intent, Script, recording};
use asperity_host::device::{Description, Device, DeviceError, Reading};
use asperity_host::servo::{Clock, Monotonic};

/// Explorations of about eleven seconds that the hand goes through: more than ten hours.
const CYCLES: usize = 4000;
/// Longest time that is simulated at once, s; a loop that pauses for longer loses the rest.
const LONGEST_S: f64 = 0.1;

/// Time base of a simulated device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pace {
    /// A fixed servo period per reading, independent of the clock: the same seed gives the same forces.
    Stepped,
    /// Real time, by the monotonic clock.
    RealTime,
}

/// Behaviour of a simulated hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hands {
    /// Exploration: taps, a press, a few strokes, a rest.
    Explore,
    /// Recording: taps, and strokes at all speeds and forces.
    Record,
}

/// Seconds of strokes that a hand which records has planned.
const RECORDED_S: f64 = 36_000.0;
/// Speed, mm/s, and force, N, up to which it strokes.
const RECORDED_TO: (f64, f64) = (300.0, 3.0);

/// A simulated device with a hand that explores the plane z = 0, cycle after cycle.
#[derive(Debug)]
pub struct SimDevice {
    mechanism: Mechanism,
    hand: Hand,
    description: Description,
    pace: Pace,
    tick_s: f64,
    /// Intent until the next reading; `None` before the first one and after the last cycle.
    intent: Option<Intent>,
    last_ns: Option<u64>,
}

impl SimDevice {
    /// A device at rest, hovering over the middle of the surface, for a servo loop at `rate_hz`.
    #[must_use]
    pub fn new(config: &DeviceConfig, grip: Grip, seed: u64, rate_hz: u32, pace: Pace) -> Self {
        Self::with(config, grip, seed, rate_hz, pace, Hands::Explore)
    }

    /// The same with a hand that does something else.
    #[must_use]
    pub fn with(
        config: &DeviceConfig,
        grip: Grip,
        seed: u64,
        rate_hz: u32,
        pace: Pace,
        hand: Hands,
    ) -> Self {
        let half_extents_m = config.half_extents_m();
        let start_m = [0.0, 0.0, HOVER_M.min(0.5 * half_extents_m[2])];
        let script = match hand {
            Hands::Explore => Script::exploration(seed, CYCLES, half_extents_m),
            Hands::Record => recording::script(seed, RECORDED_S, RECORDED_TO),
        };
        Self {
            mechanism: Mechanism::new(config, grip.mass_kg, start_m),
            hand: Hand::new(grip, script, start_m),
            description: Description {
                name: format!("simulated {}", config.name),
                serial: None,
                peak_force_n: config.actuator.peak_force_n as f32,
                continuous_force_n: config.actuator.continuous_force_n as f32,
                unconfirmed: unconfirmed(config),
            },
            pace,
            tick_s: 1.0 / f64::from(rate_hz),
            intent: None,
            last_ns: None,
        }
    }

    /// Lets time pass under the held force and the hand's pull.
    fn pass(&mut self, passed_s: f64) {
        let grip = self.hand.grip();
        let intent = self.intent;
        self.mechanism.advance(passed_s, |t_s, _| {
            intent.map_or([Pull::default(); 3], |intent| intent.pull(grip, t_s))
        });
    }

    /// Asks the hand what it wants for the next time.
    fn plan(&mut self, next_s: f64) {
        let stylus_z = AxisState {
            position_m: self.mechanism.position_m()[2],
            velocity_m_s: self.mechanism.velocity_m_s()[2],
        };
        let held_n = self.mechanism.force_n()[2];
        self.intent = self
            .hand
            .plan(next_s, &stylus_z, self.mechanism.axes(), held_n);
    }

    /// Steps of at most a period, up to now.
    fn catch_up(&mut self) {
        let now_ns = Monotonic::default().now_ns();
        let last_ns = self.last_ns.replace(now_ns).unwrap_or(now_ns);
        let mut left_s = (1e-9 * (now_ns - last_ns) as f64).min(LONGEST_S);
        while left_s > 0.0 {
            let step_s = left_s.min(self.tick_s);
            self.plan(step_s);
            self.pass(step_s);
            left_s -= step_s;
        }
    }
}

/// Lists all unconfirmed fields in a single sentence.
fn unconfirmed(config: &DeviceConfig) -> Vec<String> {
    if config.unconfirmed.is_empty() {
        return Vec::new();
    }
    let fields = config.unconfirmed.join(", ");
    vec![format!("nobody has confirmed on a device: {fields}")]
}

impl Device for SimDevice {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        match self.pace {
            Pace::RealTime => self.catch_up(),
            Pace::Stepped => {
                if self.last_ns.replace(0).is_some() {
                    self.pass(self.tick_s);
                }
                self.plan(self.tick_s);
            }
        }
        Ok(Reading {
            position_m: self.mechanism.measured_m().map(|x| x as f32),
            fresh: true,
            buttons: 0,
        })
    }

    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        self.mechanism.command(force_n.map(f64::from));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hand::GripPreset;
    use crate::servo::RenderedTexture;
    use crate::session::Session;
    use asperity_formats::Asset;
    use asperity_host::servo::{
        Event, Observer, Record, ServoLoop, Settings, SingleTexture, Virtual,
    };
    use asperity_runtime::{Config, HostTexture, Renderer, State};
    use std::sync::atomic::AtomicBool;

    /// Keeps every force.
    #[derive(Default)]
    struct Forces(Vec<[u32; 3]>);

    impl Observer for Forces {
        fn tick(&mut self, record: &Record) {
            self.0.push(record.output.force_n.map(f32::to_bits));
        }

        fn event(&mut self, event: Event) {
            panic!("{event:?}");
        }
    }

    /// The servo loop on the stepped device gives, bit for bit, what a session in virtual time
    /// gives.
    #[test]
    fn a_servo_loop_on_the_stepped_device_gives_the_forces_of_a_session() {
        const TICKS: u64 = 12_000;
        let config = DeviceConfig::touch().expect("built-in file");
        let grip = Grip::preset(GripPreset::Light).expect("built-in file");
        let built_in = asperity::emit::lower::lower(&asperity::sources::builtin::texture(), None)
            .expect("built in");
        let mut texture = Box::new(HostTexture::new());
        let asset = Asset::parse(&built_in.bytes).expect("built in");
        texture.load(&asset, 1000.0).expect("it fits");
        let renderer = Renderer::new(&Config::default()).expect("the default");

        let script = Script::exploration(3, CYCLES, config.half_extents_m());
        let servo = RenderedTexture::new(renderer.clone(), &texture, 5);
        let mut session = Session::new(&config, grip.clone(), script, servo);
        let expected: Vec<_> = session
            .run(TICKS)
            .iter()
            .map(|record| record.output.force_n.map(f32::to_bits))
            .collect();

        let mut device = SimDevice::new(&config, grip, 3, 1000, Pace::Stepped);
        let render = SingleTexture {
            renderer: &renderer,
            texture: &texture,
            state: State::new(5),
        };
        let mut forces = Forces::default();
        let settings = Settings {
            periods: Some(TICKS),
            ..Settings::at(1000)
        };
        let clock = Virtual::new();
        let stop = AtomicBool::new(false);
        ServoLoop::new(&mut device, render, clock, &mut forces, settings).run(&stop);
        assert!(expected.iter().any(|force| *force != [0; 3]));
        assert_eq!(forces.0[..TICKS as usize], expected);
    }
}

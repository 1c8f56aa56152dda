//! The simulated Touch in a simulated hand as a device, in virtual time: a reading is a period.

use asperity_host::device::{Description, Device, DeviceError, Reading};
use asperity_sim::axis::AxisState;
use asperity_sim::device::{Device as Mechanism, DeviceConfig};
use asperity_sim::hand::{Grip, GripPreset, HOVER_M, Hand, Intent, Script};

pub(crate) struct Simulated {
    description: Description,
    mechanism: Mechanism,
    hand: Hand,
    tick_s: f64,
    /// Intent of the hand in the current period.
    intent: Option<Intent>,
    periods: u64,
    buttons: u32,
}

impl Simulated {
    pub(crate) fn new(seed: u64, cycles: usize) -> Self {
        let config = DeviceConfig::touch().expect("built-in file");
        let grip = Grip::preset(GripPreset::Light).expect("built-in file");
        let script = Script::exploration(seed, cycles, config.half_extents_m());
        let start_m = [0.0, 0.0, HOVER_M.min(0.5 * config.half_extents_m()[2])];
        Self {
            description: Description {
                name: "simulated Touch".into(),
                serial: None,
                peak_force_n: config.actuator.peak_force_n as f32,
                continuous_force_n: config.actuator.continuous_force_n as f32,
                unconfirmed: Vec::new(),
            },
            mechanism: Mechanism::new(&config, grip.mass_kg, start_m),
            hand: Hand::new(grip, script, start_m),
            tick_s: 1.0 / config.timing.servo_rate_hz,
            intent: None,
            periods: 0,
            buttons: 0,
        }
    }

    /// Force that the actuators hold, N.
    pub(crate) fn force_n(&self) -> [f64; 3] {
        self.mechanism.force_n()
    }

    /// Lets the period pass that runs.
    fn pass(&mut self) {
        if let Some(intent) = self.intent.take() {
            let grip = self.hand.grip();
            self.mechanism
                .advance(self.tick_s, |t_s, _| intent.pull(grip, t_s));
        }
    }
}

impl Device for Simulated {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        self.pass();
        let stylus_z = AxisState {
            position_m: self.mechanism.position_m()[2],
            velocity_m_s: self.mechanism.velocity_m_s()[2],
        };
        let held_n = self.mechanism.force_n()[2];
        let intent = self
            .hand
            .plan(self.tick_s, &stylus_z, self.mechanism.axes(), held_n);
        // The script is over: the hand has gone, and so has the device.
        self.intent = Some(intent.ok_or(DeviceError::Disconnected)?);
        self.periods += 1;
        self.buttons = u32::from(self.periods % 1000 < 100);
        Ok(Reading {
            position_m: self.mechanism.measured_m().map(|x| x as f32),
            fresh: true,
            buttons: self.buttons,
        })
    }

    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        self.mechanism.command(force_n.map(f64::from));
        Ok(())
    }
}

//! A session that has run.

use asperity::model::FrictionLaw;
use asperity_runtime::Counters;

use asperity_sim::device::{DeviceConfig, DeviceCounts};
use asperity_sim::hand::{Grip, Motion};
use asperity_sim::session::Record;

/// Every tick of a session, and what the reports say about it.
#[derive(Debug, Clone)]
pub struct Recording {
    /// The texture that was touched.
    pub texture: TextureFacts,
    /// The device.
    pub device: DeviceConfig,
    /// The grip.
    pub grip: Grip,
    /// Seed of script and excitation.
    pub seed: u64,
    /// The motions of the script; a record names its motion by index.
    pub motions: Vec<Motion>,
    /// Every tick.
    pub records: Vec<Record>,
    /// The renderer's counters.
    pub counters: Counters,
    /// The device's counters.
    pub device_counts: DeviceCounts,
    /// Slew limit of the renderer, N/s.
    pub slew_limit_n_s: f64,
}

/// Facts about a texture, for the reports.
#[derive(Debug, Clone, PartialEq)]
pub struct TextureFacts {
    /// Its name.
    pub name: String,
    /// Where it came from: a file's name, or `built in`.
    pub origin: String,
    /// Coefficient of friction.
    pub mu: f64,
    /// Its law over speed, if it has one.
    pub law: Option<FrictionLaw>,
    /// Wall stiffness, N/m.
    pub stiffness_n_m: f64,
    /// Force per vibration, N per m/s².
    pub vib_n_per_m_s2: f64,
    /// Fastest speed and largest force of its grid, mm/s and N.
    pub grid: (f64, f64),
    /// Remarks that a reader must know: synthetic parts, unconfirmed defaults.
    pub caveats: Vec<String>,
}

impl TextureFacts {
    /// Coefficient of friction at a speed, mm/s.
    #[must_use]
    pub fn mu_at(&self, speed_mm_s: f64) -> f64 {
        self.mu * FrictionLaw::factor_of(self.law.as_ref(), speed_mm_s)
    }
}

/// The ticks of one motion of the script.
#[derive(Debug, Clone, Copy)]
pub struct Span<'a> {
    /// Index in the script.
    pub index: usize,
    /// The motion.
    pub motion: Motion,
    /// Its records.
    pub records: &'a [Record],
}

impl Recording {
    /// Servo period, s.
    #[must_use]
    pub fn tick_s(&self) -> f64 {
        1.0 / self.device.timing.servo_rate_hz
    }

    /// Virtual time that passed, s.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.records.len() as f64 * self.tick_s()
    }

    /// Vibration before device gain, m/s².
    #[must_use]
    pub fn vibration_m_s2(&self) -> Vec<f64> {
        self.records
            .iter()
            .map(|r| f64::from(r.output.vib_m_s2))
            .collect()
    }

    /// The motions that ran, each with its records.
    #[must_use]
    pub fn spans(&self) -> Vec<Span<'_>> {
        self.records
            .chunk_by(|a, b| a.intent.motion == b.intent.motion)
            .filter_map(|records| {
                let index = records.first()?.intent.motion;
                Some(Span {
                    index,
                    motion: *self.motions.get(index)?,
                    records,
                })
            })
            .collect()
    }
}

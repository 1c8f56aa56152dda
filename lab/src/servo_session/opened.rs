//! An open device, and what a recording in its place says of its session.

use asperity_host::device::Device;
use asperity_host::profile::Profile;
use asperity_host::servo::Pace as LoopPace;
use asperity_host::session_log::Conditions;
use asperity_runtime::{Config, Limits, MechanicsConfig};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// An open device, and what the runtime must know of it.
pub struct OpenDevice {
    /// The device.
    pub device: Box<dyn Device>,
    /// Damping and friction of its mechanism; a Touch's where unknown.
    pub mechanics: MechanicsConfig,
    /// Its profile, if one was given; takes precedence over `mechanics`.
    pub profile: Option<Profile>,
    /// Pacing of its readings.
    pub pace: LoopPace,
    /// The recorded session, for a recording.
    pub replayed: Option<Replayed>,
}

impl OpenDevice {
    /// The configuration of a renderer for this device; for a recording, the recorded one.
    #[must_use]
    pub fn config(&self, rate_hz: u32) -> Config {
        if let Some(replayed) = &self.replayed {
            return replayed.conditions.config.clone();
        }
        let config = Config {
            servo_rate_hz: rate_hz as f32,
            limits: Limits {
                peak_n: self.device.description().peak_force_n,
                ..Config::default().limits
            },
            mechanics: self.mechanics,
            ..Config::default()
        };
        let Some(profile) = &self.profile else {
            return config;
        };
        let mut ours = profile.apply(&config);
        // A profile cannot make a device stronger than it says it is.
        ours.limits.peak_n = if ours.limits.peak_n < config.limits.peak_n {
            ours.limits.peak_n
        } else {
            config.limits.peak_n
        };
        ours
    }
}

/// The session held by a recording.
#[derive(Debug, Clone)]
pub struct Replayed {
    /// Its conditions.
    pub conditions: Conditions,
    /// Number of texture changes after the first texture.
    pub exchanges: usize,
    /// Ticks that were not recorded.
    pub lost: u64,
    /// Forces that repeat.
    pub repeated: Arc<Repeated>,
}

/// Forces of a replay compared with those of the recording.
#[derive(Debug, Default)]
pub struct Repeated {
    pub(super) forces: AtomicU64,
    pub(super) different: AtomicU64,
}

impl Repeated {
    /// Forces that were compared, and how many of them differ in a bit.
    #[must_use]
    pub fn counts(&self) -> (u64, u64) {
        (self.forces.load(Relaxed), self.different.load(Relaxed))
    }
}

//! Runs a session of a hand on a texture and returns its recording.

use asperity_formats::Asset;
use asperity_runtime::{Config, HostTexture, Limits, Renderer};

use super::error::FeelError;
use super::recording::{Recording, TextureFacts};
use asperity_sim::device::DeviceConfig;
use asperity_sim::hand::{Grip, Script};
use asperity_sim::servo::RenderedTexture;
use asperity_sim::session::Session;

/// Shortest time that one cycle of the exploration takes, s. It bounds how many cycles a given
/// time can need.
const CYCLE_S: f64 = 6.0;

/// The device, the grip, the seed and the length of a session.
#[derive(Debug, Clone)]
pub struct FeelOptions {
    /// The device.
    pub device: DeviceConfig,
    /// The grip.
    pub grip: Grip,
    /// Seed of the script's variations and of the texture's excitation.
    pub seed: u64,
    /// Virtual time to run, s; `None` for one whole exploration.
    pub seconds: Option<f64>,
}

/// Lets a hand explore a texture on the plane z = 0.
///
/// The renderer is given the limits, the rate and the mechanics of the device. `origin` says
/// where the asset came from.
///
/// # Errors
/// [`FeelError::Load`] for a texture that does not fit the slot or the device's
/// servo rate, [`FeelError::Config`] for a device that no renderer can serve.
pub fn record(
    asset: &Asset<'_>,
    origin: &str,
    options: &FeelOptions,
) -> Result<Recording, FeelError> {
    let FeelOptions {
        device,
        grip,
        seed,
        seconds,
    } = options;
    let rate_hz = device.timing.servo_rate_hz;
    let mut texture = Box::new(HostTexture::new());
    texture.load(asset, rate_hz as f32)?;
    let config = Config {
        servo_rate_hz: rate_hz as f32,
        limits: Limits {
            peak_n: device.actuator.peak_force_n as f32,
            ..Config::default().limits
        },
        mechanics: device.mechanics_config(),
        ..Config::default()
    };
    let slew_limit_n_s = f64::from(config.limits.slew_n_s);
    let renderer = Renderer::new(&config)?;
    let mut facts = facts(asset, origin);
    let wall = renderer.wall(asset.coupling());
    if wall.stiffness.value() < asset.coupling().stiffness_n_m {
        facts.stiffness_n_m = f64::from(wall.stiffness.value());
        facts.caveats.push(format!(
            "the wall is lowered from {:.0} to {:.0} N/m, what the device can bear",
            asset.coupling().stiffness_n_m,
            wall.stiffness.value()
        ));
    }
    let servo = RenderedTexture::new(renderer, &texture, *seed);

    let cycles = seconds.map_or(1, |seconds| (seconds / CYCLE_S).ceil() as usize + 1);
    let ticks = seconds.map_or(u64::MAX, |seconds| (seconds * rate_hz).round() as u64);
    let script = Script::exploration(*seed, cycles, device.half_extents_m());
    let motions = script.motions().to_vec();
    let mut session = Session::new(device, grip.clone(), script, servo);
    let records = session.run(ticks);
    Ok(Recording {
        texture: facts,
        device: device.clone(),
        grip: grip.clone(),
        seed: *seed,
        motions,
        records,
        counters: *session.servo().state().counters(),
        device_counts: session.device_counts(),
        slew_limit_n_s,
    })
}

fn facts(asset: &Asset<'_>, origin: &str) -> TextureFacts {
    let coupling = asset.coupling();
    let mut caveats = Vec::new();
    if let Some(provenance) = asset.provenance() {
        if provenance.taps_synthetic {
            caveats.push("taps of the texture are synthetic".to_owned());
        }
        if !provenance.notes.is_empty() {
            caveats.push(format!("of the texture: {}", provenance.notes));
        }
    }
    TextureFacts {
        name: asset.name().to_owned(),
        origin: origin.to_owned(),
        mu: f64::from(asset.friction().mu()),
        law: asperity::emit::raise::law(asset),
        stiffness_n_m: f64::from(coupling.stiffness_n_m),
        vib_n_per_m_s2: f64::from(coupling.vib_s2_m) * f64::from(coupling.f_max_n),
        grid: (
            f64::from(asset.grid().max_speed_mm_s()),
            f64::from(asset.grid().max_force_n()),
        ),
        caveats,
    }
}

//! A hand strokes and taps a texture on the simulated Touch.

use asperity::{lower, model::TextureModel};
use asperity_formats::Asset;
use asperity_runtime::{Config, HostTexture, Limits, Renderer};

use super::{
    error::BenchError,
    script::{script, sine},
};
use crate::{
    device::DeviceConfig,
    hand::{Grip, GripPreset, Script},
    servo::RenderedTexture,
    session::{Record, Session},
};

/// What happened, tick by tick.
#[derive(Debug)]
pub struct Performance {
    /// Every tick, 1 ms apart.
    pub records: Vec<Record>,
    /// Impacts: tick and speed, m/s.
    pub impacts: Vec<(usize, f64)>,
}

/// Lets a hand explore a texture for some time.
///
/// # Errors
/// [`BenchError::Texture`] for a texture that the runtime cannot render.
pub fn perform(texture: &TextureModel, seconds: f64, seed: u64) -> Result<Performance, BenchError> {
    follow(texture, seconds, seed, script)
}

/// Lets a hand stroke to and fro as evenly as a machine, after a few taps.
///
/// # Errors
/// [`BenchError::Texture`] for a texture that the runtime cannot render.
pub fn perform_sine(
    texture: &TextureModel,
    seconds: f64,
    seed: u64,
) -> Result<Performance, BenchError> {
    follow(texture, seconds, seed, sine)
}

fn follow(
    texture: &TextureModel,
    seconds: f64,
    seed: u64,
    script: fn(u64, f64, (f64, f64)) -> Script,
) -> Result<Performance, BenchError> {
    let fail = |what: String| BenchError::Texture {
        name: texture.name.clone(),
        what,
    };
    let device = DeviceConfig::touch().map_err(|error| fail(error.to_string()))?;
    let grip = Grip::preset(GripPreset::Firm).map_err(|error| fail(error.to_string()))?;
    let lowered = lower::lower(texture, None).map_err(|error| fail(error.to_string()))?;
    let asset = Asset::parse(&lowered.bytes).map_err(|error| fail(error.to_string()))?;
    let rate_hz = device.timing.servo_rate_hz;
    let mut slot = Box::new(HostTexture::new());
    slot.load(&asset, rate_hz as f32)
        .map_err(|error| fail(error.to_string()))?;
    let config = Config {
        servo_rate_hz: rate_hz as f32,
        limits: Limits {
            peak_n: device.actuator.peak_force_n as f32,
            ..Config::default().limits
        },
        mechanics: device.mechanics_config(),
        ..Config::default()
    };
    let renderer = Renderer::new(&config).map_err(|error| fail(error.to_string()))?;
    let servo = RenderedTexture::new(renderer, &slot, seed);
    let corner = (
        f64::from(asset.grid().max_speed_mm_s()),
        f64::from(asset.grid().max_force_n()),
    );
    let mut session = Session::new(&device, grip, script(seed, seconds, corner), servo);
    let records = session.run((seconds * rate_hz) as u64);
    let mut impacts = Vec::new();
    for (tick, pair) in records.windows(2).enumerate() {
        let (before, now) = (&pair[0], &pair[1]);
        if before.output.depth_m <= 0.0 && now.output.depth_m > 0.0 && now.output.tap_n != 0.0 {
            impacts.push((tick + 1, -before.true_m_s[2]));
        }
    }
    Ok(Performance { records, impacts })
}

//! A hand strokes and taps a texture on the simulated Touch.

use asperity::{emit::lower, model::TextureModel};
use asperity_formats::Asset;
use asperity_runtime::{Config, HostTexture, Limits, Renderer};

use super::error::ImportAccuracyError;
use asperity_sim::{
    device::DeviceConfig,
    hand::{
        Grip, GripPreset, Script,
        recording::{free, script},
    },
    servo::RenderedTexture,
    session::{Record, Session},
};

/// Slowest motion in touch that is a stroke, mm/s.
const SLOWEST_STROKE_MM_S: f64 = 10.0;
/// Seconds of motions for a second of strokes, and for the first air and taps: more than it takes.
const PLANNED_S: (f64, f64) = (3.0, 30.0);

/// When a performance ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Until {
    /// After so many seconds of everything.
    Seconds(f64),
    /// After so many seconds of strokes; air, taps and turns come in addition.
    Strokes(f64),
}

/// Style of the strokes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Strokes {
    /// At one speed and force each.
    #[default]
    Steady,
    /// With speed and force changing all the time.
    Free,
}

/// A performance, tick by tick.
#[derive(Debug)]
pub struct Performance {
    /// Every tick, 1 ms apart.
    pub records: Vec<Record>,
    /// Impacts: tick and speed, m/s.
    pub impacts: Vec<(usize, f64)>,
}

/// Lets a hand tap and stroke a texture.
///
/// # Errors
/// [`ImportAccuracyError::Texture`] for a texture that the runtime cannot render.
pub fn perform(
    texture: &TextureModel,
    strokes: Strokes,
    until: Until,
    seed: u64,
) -> Result<Performance, ImportAccuracyError> {
    let script: fn(u64, f64, (f64, f64)) -> Script = match strokes {
        Strokes::Steady => script,
        Strokes::Free => free,
    };
    let fail = |what: String| ImportAccuracyError::Texture {
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
    let planned_s = match until {
        Until::Seconds(seconds) => seconds,
        Until::Strokes(seconds) => PLANNED_S.0 * seconds + PLANNED_S.1,
    };
    let mut session = Session::new(&device, grip, script(seed, planned_s, corner), servo);
    let records = match until {
        Until::Seconds(seconds) => session.run((seconds * rate_hz) as u64),
        Until::Strokes(seconds) => until_stroked(&mut session, (seconds * rate_hz) as usize),
    };
    let mut impacts = Vec::new();
    for (tick, pair) in records.windows(2).enumerate() {
        let (before, now) = (&pair[0], &pair[1]);
        if before.output.depth_m <= 0.0 && now.output.depth_m > 0.0 && now.output.tap_n != 0.0 {
            impacts.push((tick + 1, -before.true_m_s[2]));
        }
    }
    Ok(Performance { records, impacts })
}

/// All ticks until so many of them were strokes.
fn until_stroked(session: &mut Session<RenderedTexture<'_>>, ticks: usize) -> Vec<Record> {
    let mut records = Vec::new();
    let mut stroked = 0;
    while stroked < ticks
        && let Some(record) = session.tick()
    {
        let output = &record.output;
        let is_stroke =
            output.normal_force_n > 0.0 && f64::from(output.speed_mm_s) >= SLOWEST_STROKE_MM_S;
        stroked += usize::from(is_stroke);
        records.push(record);
    }
    records
}

//! Devices by name.

use super::error::ServoSessionError;
use super::opened::OpenDevice;
use super::replay;
use asperity_host::device::{self, OpenError, Scheme, Uri};
use asperity_host::servo::Pace as LoopPace;
use asperity_runtime::Config;
use asperity_sim::device::DeviceConfig;
use asperity_sim::hand::{Grip, GripPreset};
use asperity_sim::host_device::{Hands, Pace, SimDevice};
use std::path::Path;

/// Settings of `sim:`.
const SETTINGS: [&str; 4] = ["grip", "hand", "seed", "time"];

/// Opens a device by its name for a servo loop at `rate_hz`: what the host has, and
/// `sim:FILE.toml?grip=light&seed=1&time=real`, where everything after the colon may be left out.
/// `grip` is `light`, `firm` or a file, `hand` is `explore` or `record`, `time` is `real` or `stepped`. The simulated device takes a
/// period of the loop as its own, whatever its file says.
///
/// # Errors
/// [`ServoSessionError::Open`] and [`ServoSessionError::Simulated`].
pub fn open(uri: &Uri, rate_hz: u32) -> Result<OpenDevice, ServoSessionError> {
    match uri.scheme {
        Scheme::Sim => simulated(uri, rate_hz),
        Scheme::Replay => replay::open(uri),
        Scheme::Touch => Err(ServoSessionError::IdentifiedOnly(uri.to_string())),
        _ => Ok(OpenDevice {
            device: device::open(uri, rate_hz)?,
            mechanics: Config::default().mechanics,
            profile: None,
            pace: LoopPace::Clock,
            replayed: None,
        }),
    }
}

fn simulated(uri: &Uri, rate_hz: u32) -> Result<OpenDevice, ServoSessionError> {
    uri.allow(&SETTINGS).map_err(OpenError::from)?;
    let config = match uri.which.as_str() {
        "" => DeviceConfig::touch()?,
        path => DeviceConfig::load(Path::new(path))?,
    };
    let grip = match uri.setting("grip").unwrap_or("light") {
        "light" => Grip::preset(GripPreset::Light)?,
        "firm" => Grip::preset(GripPreset::Firm)?,
        path => Grip::load(Path::new(path))?,
    };
    let seed = uri.setting("seed").unwrap_or("1").parse();
    let seed = seed.map_err(|_| OpenError::setting(uri, "seed", "a whole number"))?;
    let pace = match uri.setting("time").unwrap_or("real") {
        "real" => Pace::RealTime,
        "stepped" => Pace::Stepped,
        _ => return Err(OpenError::setting(uri, "time", "real or stepped").into()),
    };
    let hand = match uri.setting("hand").unwrap_or("explore") {
        "explore" => Hands::Explore,
        "record" => Hands::Record,
        _ => return Err(OpenError::setting(uri, "hand", "explore or record").into()),
    };
    let device = SimDevice::with(&config, grip, seed, rate_hz, pace, hand);
    Ok(OpenDevice {
        device: Box::new(device),
        mechanics: config.mechanics_config(),
        profile: None,
        pace: match pace {
            Pace::RealTime => LoopPace::Clock,
            Pace::Stepped => LoopPace::Stepped,
        },
        replayed: None,
    })
}

//! Visual and audible views: an asset's contents, its sheet, a picture of the surface, strokes and taps, a rendered
//! trajectory.

pub mod diffusion;
pub mod inspect;
pub mod listen;
pub mod plot;
pub mod preview;
pub mod render;

use asperity_runtime::{Config, SafetyConfig};

/// The configuration of a rendering without a device, at a servo rate. A trajectory may lead as far as
/// the runtime counts, 10 km.
pub(crate) fn offline_config(servo_rate_hz: f32) -> Config {
    let default = Config::default();
    Config {
        servo_rate_hz,
        safety: SafetyConfig {
            reach_m: 1.0e4,
            ..default.safety
        },
        ..default
    }
}

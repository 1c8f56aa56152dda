//! A loop that renders nothing: the tool touches a real surface.

use super::error::ServoSessionError;
use super::run::{Attended, Setup, spawn};
use asperity_host::device::Device;
use asperity_host::servo::{Observer, Render, Report};
use asperity_runtime::{Config, Counters, Output, Renderer, Sample};
use asperity_sim::servo::silence;

/// Renders no force.
struct Passive {
    config: Config,
}

impl Render for Passive {
    fn tick(&mut self, _: &Sample) -> Output {
        silence()
    }

    fn config(&self) -> &Config {
        &self.config
    }

    fn counters(&self) -> Counters {
        Counters::default()
    }
}

/// Runs a loop that renders no force, as [`run`](super::run()) runs one on a texture.
///
/// # Errors
/// [`ServoSessionError`] for a device or a rate that do not fit.
pub fn run_passive<O: Observer + Send>(
    setup: Setup<'_>,
    device: &mut dyn Device,
    observer: O,
    attend: impl FnOnce(Attended<'_, '_, '_, '_>),
) -> Result<Report, ServoSessionError> {
    // What no renderer takes is refused here as well.
    Renderer::new(&setup.config)?;
    setup.settings.check(setup.config.servo_rate_hz)?;
    let render = Passive {
        config: setup.config.clone(),
    };
    spawn(setup, render, device, observer, None, attend)
}

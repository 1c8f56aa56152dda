//! Runs a servo loop on its thread.

use super::error::ServoSessionError;
use super::surface::Surface;
use asperity_formats::{Asset, Library};
use asperity_host::device::Device;
use asperity_host::latency::{Delayed, Injection};
use asperity_host::servo::privileges::{Grant, PrivilegeRequest};
use asperity_host::servo::{
    Monotonic, Observer, Render, Report, SceneRender, Servo, Settings, Start, SwappableTexture,
};
use asperity_runtime::{
    Config, Exchange, HostScene, HostTexture, Preparer, Renderer, SceneState, Texture,
};
use std::sync::atomic::AtomicBool;
use std::thread;
use std::time::Duration;

/// Setup of a loop.
pub struct Setup<'s> {
    /// Configuration of the renderer.
    pub config: Config,
    /// The loop.
    pub settings: Settings,
    /// The clock, which may spin.
    pub clock: Monotonic,
    /// Privileges requested from the system.
    pub privileges: PrivilegeRequest,
    /// A delay that is put in on purpose.
    pub injection: Option<Injection>,
    /// Seed of the excitation.
    pub seed: u64,
    /// Set to end the loop.
    pub stop: &'s AtomicBool,
}

/// Arguments of the function that attends to a running loop.
pub struct Attended<'r, 'q, 'a, 'scope> {
    /// The loop.
    pub servo: &'r Servo<'scope>,
    /// Privileges that the system granted and refused.
    pub grants: &'r [Grant],
    /// Takes other textures; a scene stays what it is.
    pub preparer: Option<&'r mut Preparer<'q, 'a>>,
}

/// Runs a loop on a thread of its own until it ends. Meanwhile `attend` is called on this thread;
/// it may come back early.
///
/// # Errors
/// [`ServoSessionError`] for a surface, a device or a rate that do not fit.
pub fn run<O: Observer + Send>(
    setup: Setup<'_>,
    surface: &Surface,
    device: &mut dyn Device,
    observer: O,
    attend: impl FnOnce(Attended<'_, '_, '_, '_>),
) -> Result<Report, ServoSessionError> {
    let renderer = Renderer::new(&setup.config)?;
    setup.settings.check(setup.config.servo_rate_hz)?;
    let format = |cause| ServoSessionError::Format {
        origin: surface.origin.clone(),
        cause,
    };
    if surface.is_scene {
        let library = Library::parse(&surface.bytes).map_err(format)?;
        let mut slots = vec![Texture::EMPTY; library.index().len()];
        let scene = HostScene::load(&library, &setup.config, &mut slots);
        let scene = scene.map_err(|cause| ServoSessionError::Scene {
            origin: surface.origin.clone(),
            cause,
        })?;
        let render = SceneRender {
            renderer: &renderer,
            scene: &scene,
            state: SceneState::new(setup.seed),
        };
        return spawn(setup, render, device, observer, None, attend);
    }
    let asset = Asset::parse(&surface.bytes).map_err(format)?;
    let [mut playing, mut a, mut b] = [(); 3].map(|()| Box::new(HostTexture::new()));
    let loaded = playing.load(&asset, setup.config.servo_rate_hz);
    loaded.map_err(|cause| ServoSessionError::Load {
        origin: surface.origin.clone(),
        cause,
    })?;
    let mut exchange = Exchange::new();
    let (mut preparer, player) = exchange.split(&mut playing, [&mut a, &mut b], setup.seed);
    let render = SwappableTexture::new(&renderer, player);
    spawn(setup, render, device, observer, Some(&mut preparer), attend)
}

pub(super) fn spawn<'q, 'a, R: Render + Send, O: Observer + Send>(
    setup: Setup<'_>,
    render: R,
    device: &mut dyn Device,
    observer: O,
    preparer: Option<&mut Preparer<'q, 'a>>,
    attend: impl FnOnce(Attended<'_, 'q, 'a, '_>),
) -> Result<Report, ServoSessionError> {
    // Delays are waited for without sleeping, so that they are as long as they should be.
    let waiting = Monotonic::spinning(Duration::from_secs(1));
    let mut device = Delayed::new(device, waiting, setup.injection);
    let render = Delayed::new(render, waiting, setup.injection);
    thread::scope(|scope| {
        let start = Start {
            device: &mut device,
            render,
            observer,
            settings: setup.settings,
            clock: setup.clock,
            privileges: setup.privileges,
            stop: setup.stop,
        };
        let servo = Servo::spawn(scope, start).map_err(ServoSessionError::Thread)?;
        let grants = servo.grants();
        attend(Attended {
            servo: &servo,
            grants: &grants,
            preparer,
        });
        servo.join().ok_or(ServoSessionError::Bug)
    })
}

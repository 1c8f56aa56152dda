//! A servo loop in virtual time: a device behind faults, supervised, with the runtime between.

use asperity_formats::Asset;
use asperity_host::device::Device;
use asperity_host::device::fault_injection::{DeviceFaultInjector, InjectedFault};
use asperity_host::device::supervised::{Plausible, Report, Supervised};
use asperity_host::fault_plan::FaultPlan;
use asperity_host::session_log::{Conditions, Entry, TextureInfo};
use asperity_runtime::{Config, HostTexture, Output, Renderer, State};

pub(crate) const SEED: u64 = 11;

/// The bytes of the built-in texture.
pub(crate) fn asset() -> Vec<u8> {
    let lowered = asperity::emit::lower::lower(&asperity::sources::builtin::texture(), None);
    lowered.expect("the built-in texture").bytes
}

pub(crate) fn load(bytes: &[u8]) -> Box<HostTexture> {
    let mut texture = Box::new(HostTexture::new());
    let asset = Asset::parse(bytes).expect("an asset");
    texture
        .load(&asset, Config::default().servo_rate_hz)
        .expect("it fits");
    texture
}

pub(crate) fn conditions(bytes: &[u8], device: &str) -> Conditions {
    Conditions {
        program: "test".into(),
        device: device.into(),
        texture: Some(TextureInfo::of("built in", bytes)),
        scene: None,
        seed: SEED,
        config: Config::default(),
    }
}

/// Result of a servo period.
pub(crate) struct Period {
    pub(crate) entry: Entry,
    pub(crate) output: Output,
    pub(crate) report: Option<Report>,
}

/// The loop.
pub(crate) struct Servo<'a, D> {
    pub(crate) device: Supervised<DeviceFaultInjector<D>>,
    renderer: Renderer,
    texture: &'a HostTexture,
    pub(crate) state: State,
}

impl<'a, D: Device> Servo<'a, D> {
    pub(crate) fn new(
        device: D,
        texture: &'a HostTexture,
        plan: FaultPlan<InjectedFault>,
        seed: u64,
    ) -> Self {
        let config = Config::default();
        let faulty = DeviceFaultInjector::new(device, plan, seed);
        Self {
            device: Supervised::new(faulty, &config, Plausible::default()),
            renderer: Renderer::new(&config).expect("a configuration"),
            texture,
            state: State::new(SEED),
        }
    }

    pub(crate) fn faulty(&self) -> &DeviceFaultInjector<D> {
        self.device.device()
    }

    pub(crate) fn period(&mut self) -> Period {
        // A clock that jumps in this reading shows up in the next period.
        let periods = 1 + self.device.device_mut().take_clock_step();
        let seen = self.device.read(periods);
        let output = self
            .renderer
            .tick(self.texture, &mut self.state, &seen.sample);
        let wrote = self.device.write(output.force_n);
        if self.device.wants_recovery() {
            // A device that is still away is asked again in the next period.
            let _ = self.device.recover();
        }
        Period {
            entry: Entry {
                buttons: seen.buttons,
                read_fault: seen.fault,
                write_fault: wrote.err(),
                ..Entry::new(seen.sample, &output)
            },
            output,
            report: seen.report,
        }
    }
}

//! A texture, and a device that does what a test says, in virtual time.

#![allow(dead_code, reason = "every test uses another part")]

use asperity_formats::Asset;
use asperity_host::device::{Description, Device, DeviceError, Reading};
use asperity_host::servo::{Event, Observer, Record, Virtual};
use asperity_runtime::{Config, HostTexture, Renderer};

/// The built-in texture in a slot, and a renderer for it.
pub(crate) fn texture(rate_hz: f32) -> (Box<HostTexture>, Renderer) {
    let bytes = include_bytes!("../../../runtime/tests/data/builtin-v1.asp");
    let mut texture = Box::new(HostTexture::new());
    let asset = Asset::parse(bytes).expect("a committed asset");
    texture.load(&asset, rate_hz).expect("it fits");
    let config = Config {
        servo_rate_hz: rate_hz,
        ..Config::default()
    };
    (texture, Renderer::new(&config).expect("the default"))
}

/// Behaviour of a device in a call of `read` or `write`.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Act {
    /// Time that the call takes, ns.
    pub(crate) takes_ns: u64,
    /// Error of the call.
    pub(crate) fault: Option<DeviceError>,
    /// Nothing new.
    pub(crate) old: bool,
}

/// A stylus that strokes 1.5 mm deep, and a script of calls by their number.
pub(crate) struct Scripted<F, G> {
    pub(crate) clock: Virtual,
    pub(crate) read: F,
    pub(crate) write: G,
    pub(crate) reads: u64,
    pub(crate) writes: u64,
    pub(crate) forces: Vec<[f32; 3]>,
    pub(crate) recoveries: Vec<Result<(), DeviceError>>,
    /// Time that a recovery takes, ns.
    pub(crate) recovery_ns: u64,
    /// True if a recovery succeeds.
    pub(crate) recovers: bool,
    description: Description,
}

impl<F: FnMut(u64) -> Act, G: FnMut(u64) -> Act> Scripted<F, G> {
    pub(crate) fn new(clock: &Virtual, read: F, write: G) -> Self {
        Self {
            clock: clock.clone(),
            read,
            write,
            reads: 0,
            writes: 0,
            forces: Vec::new(),
            recoveries: Vec::new(),
            recovery_ns: 0,
            recovers: false,
            description: Description {
                name: "scripted".into(),
                serial: None,
                peak_force_n: 3.3,
                continuous_force_n: 3.3,
                unconfirmed: Vec::new(),
            },
        }
    }
}

impl<F: FnMut(u64) -> Act + Send, G: FnMut(u64) -> Act + Send> Device for Scripted<F, G> {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        let act = (self.read)(self.reads);
        self.reads += 1;
        self.clock.pass(act.takes_ns);
        // There and back, since a hand does not jump.
        let phase = self.reads % 400;
        let x_m = 1e-4 * phase.min(400 - phase) as f32;
        match act.fault {
            Some(fault) => Err(fault),
            None => Ok(Reading {
                position_m: [x_m, 0.0, -0.0015],
                fresh: !act.old,
                buttons: 0,
            }),
        }
    }

    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        let act = (self.write)(self.writes);
        self.writes += 1;
        self.clock.pass(act.takes_ns);
        self.forces.push(force_n);
        act.fault.map_or(Ok(()), Err)
    }

    fn recover(&mut self) -> Result<(), DeviceError> {
        self.clock.pass(self.recovery_ns);
        let result = if self.recovers {
            Ok(())
        } else {
            Err(DeviceError::Disconnected)
        };
        self.recoveries.push(result);
        result
    }
}

/// Keeps everything.
#[derive(Debug, Default)]
pub(crate) struct ObserverLog {
    pub(crate) records: Vec<Record>,
    pub(crate) events: Vec<Event>,
}

impl Observer for ObserverLog {
    fn tick(&mut self, record: &Record) {
        self.records.push(*record);
    }

    fn event(&mut self, event: Event) {
        self.events.push(event);
    }
}

/// Length of a vector.
pub(crate) fn length(v: [f32; 3]) -> f32 {
    asperity_runtime::math::norm(v)
}

//! What a tick leaves behind, and who takes it.

use super::{event::Event, times::Times};
use crate::device::{DeviceError, Reading};
use asperity_runtime::{Output, Sample};

/// Everything about one tick.
#[derive(Debug, Clone, Copy)]
pub struct Record {
    /// Ticks since the loop began; a record that is lost on the way leaves a gap.
    pub tick: u64,
    /// Period since the loop began; ticks that were missed leave gaps.
    pub period: u64,
    /// Periods that were missed just before this tick.
    pub missed: u64,
    /// When each stage ended.
    pub times: Times,
    /// What the device said; a position that no hand can have is [`DeviceError::Garbled`].
    pub reading: Result<Reading, DeviceError>,
    /// What the runtime was given.
    pub sample: Sample,
    /// What the runtime answered.
    pub output: Output,
    /// How often another texture has begun to play, up to this tick.
    pub exchanges: u32,
    /// Whether the force reached the device.
    pub written: Result<(), DeviceError>,
}

/// Takes records and events on the servo thread. It neither allocates, locks, prints nor waits.
pub trait Observer {
    /// A tick has ended.
    fn tick(&mut self, record: &Record);

    /// Something happened that is reported once.
    fn event(&mut self, event: Event);
}

/// Nobody looks.
impl Observer for () {
    fn tick(&mut self, _: &Record) {}

    fn event(&mut self, _: Event) {}
}

impl<O: Observer + ?Sized> Observer for &mut O {
    fn tick(&mut self, record: &Record) {
        (**self).tick(record);
    }

    fn event(&mut self, event: Event) {
        (**self).event(event);
    }
}

//! Record of a tick, and its observer.

use super::{event::Event, times::Times};
use crate::device::{DeviceError, Reading};
use asperity_runtime::{Output, Sample};

/// Everything about one tick.
#[derive(Debug, Clone, Copy)]
pub struct Record {
    /// Ticks since the loop began; a lost record leaves a gap.
    pub tick: u64,
    /// Periods since the loop began; missed ticks leave gaps.
    pub period: u64,
    /// Periods missed just before this tick.
    pub missed: u64,
    /// When each stage ended.
    pub times: Times,
    /// Reading of the device; an implausible position is [`DeviceError::Garbled`].
    pub reading: Result<Reading, DeviceError>,
    /// Input to the runtime.
    pub sample: Sample,
    /// Output of the runtime.
    pub output: Output,
    /// Texture exchanges up to this tick.
    pub exchanges: u32,
    /// Result of writing the force.
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

//! Device wrapper that keeps the last reading for the records: supervision passes on samples alone.

use crate::device::{Description, Device, DeviceError, Reading};

/// A device and its last reading.
#[derive(Debug)]
pub(super) struct LastReading<'d, D: ?Sized> {
    device: &'d mut D,
    last: Result<Reading, DeviceError>,
}

impl<'d, D: ?Sized> LastReading<'d, D> {
    pub(super) fn new(device: &'d mut D) -> Self {
        Self {
            device,
            last: Err(DeviceError::TimedOut),
        }
    }

    /// Returns the last reading.
    pub(super) fn last(&self) -> Result<Reading, DeviceError> {
        self.last
    }
}

impl<D: Device + ?Sized> Device for LastReading<'_, D> {
    fn description(&self) -> &Description {
        self.device.description()
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        self.last = self.device.read();
        self.last
    }

    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        self.device.write(force_n)
    }

    fn recover(&mut self) -> Result<(), DeviceError> {
        self.device.recover()
    }
}

//! Any of the virtual devices.

use super::descriptor::Descriptors;
use super::falcon::Falcon;
use super::touch::Touch;
use super::{Answer, Device, Setup};

/// Any of the virtual devices.
#[derive(Debug, Clone)]
pub enum AnyDevice {
    /// A Novint Falcon.
    Falcon(Box<Falcon>),
    /// A 3D Systems Touch.
    Touch(Touch),
}

impl AnyDevice {
    fn device(&self) -> &dyn Device {
        match self {
            Self::Falcon(device) => &**device,
            Self::Touch(device) => device,
        }
    }

    fn device_mut(&mut self) -> &mut dyn Device {
        match self {
            Self::Falcon(device) => &mut **device,
            Self::Touch(device) => device,
        }
    }
}

impl Device for AnyDevice {
    fn descriptors(&self) -> &Descriptors {
        self.device().descriptors()
    }

    fn control(&mut self, setup: &Setup, data: &[u8]) -> Answer {
        self.device_mut().control(setup, data)
    }

    fn write(&mut self, endpoint: u8, bytes: &[u8]) -> Answer {
        self.device_mut().write(endpoint, bytes)
    }

    fn read(&mut self, endpoint: u8, most: usize) -> Answer {
        self.device_mut().read(endpoint, most)
    }

    fn advance(&mut self, seconds: f64) {
        self.device_mut().advance(seconds);
    }

    fn plugged_in(&mut self) {
        self.device_mut().plugged_in();
    }
}

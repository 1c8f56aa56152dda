//! USB devices that do not exist, for programs that open them through libusb.
//!
//! A [`Device`] is a state machine that knows no transport and no clock. A [`Port`] is the socket
//! that it is plugged into: it answers the standard requests, injects faults, and is unplugged and
//! plugged in again. [`usbip`] serves it over TCP: a Linux kernel attaches it as a real device
//! (`vhci-hcd`), and the bridge in `umockdev/` hands it to libusb where there is no kernel for it.
//!
//! | module | holds |
//! |---|---|
//! | [`descriptor`] | device, configuration and string descriptors as bytes |
//! | [`transfer_fault`] | stalls, short transfers, time-outs and unplugging at a rate |
//! | [`falcon`] | a Novint Falcon with a grip in a hand |
//! | [`touch`] | a 3D Systems Touch, as far as it identifies itself |

#![forbid(unsafe_code)]

pub mod descriptor;
pub mod falcon;
mod port;
pub mod touch;
pub mod transfer_fault;
pub mod usbip;

pub use port::{Port, Reply, Setup, Socket};

use descriptor::Descriptors;
use falcon::Falcon;
use touch::Touch;

/// Response of an endpoint to a transfer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Answer {
    /// Completed; bytes of an IN transfer, none for OUT.
    Done(Vec<u8>),
    /// No data yet.
    Pending,
    /// Refused.
    Stall,
}

/// A device without a bus.
pub trait Device: Send {
    /// Returns its descriptors.
    fn descriptors(&self) -> &descriptor::Descriptors;

    /// Handles a class or vendor control request with its data stage, `data`.
    fn control(&mut self, setup: &Setup, data: &[u8]) -> Answer;

    /// Writes bytes to an endpoint.
    fn write(&mut self, endpoint: u8, bytes: &[u8]) -> Answer;

    /// Reads at most `most` bytes from an endpoint.
    fn read(&mut self, endpoint: u8, most: usize) -> Answer;

    /// Advances time.
    fn advance(&mut self, seconds: f64);

    /// Called when it is plugged in again. A self-powered device keeps its state.
    fn plugged_in(&mut self) {}
}

// Any of the virtual devices.

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

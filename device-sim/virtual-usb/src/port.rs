//! The socket that a virtual device is plugged into.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::transfer_fault::{FaultCounts, Faults, Rates, TransferFault};
use super::{Answer, Device};

/// The eight bytes that begin a control transfer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Setup {
    /// Direction (bit 7), type (bits 5 and 6), recipient.
    pub request_type: u8,
    /// Which request.
    pub request: u8,
    /// Its value.
    pub value: u16,
    /// Its index.
    pub index: u16,
    /// Bytes of its data.
    pub length: u16,
}

impl Setup {
    /// From bytes.
    #[must_use]
    pub const fn of(bytes: [u8; 8]) -> Self {
        let [request_type, request, v0, v1, i0, i1, l0, l1] = bytes;
        Self {
            request_type,
            request,
            value: u16::from_le_bytes([v0, v1]),
            index: u16::from_le_bytes([i0, i1]),
            length: u16::from_le_bytes([l0, l1]),
        }
    }

    /// As bytes.
    #[must_use]
    pub const fn bytes(&self) -> [u8; 8] {
        let [v0, v1] = self.value.to_le_bytes();
        let [i0, i1] = self.index.to_le_bytes();
        let [l0, l1] = self.length.to_le_bytes();
        [self.request_type, self.request, v0, v1, i0, i1, l0, l1]
    }
}

/// Outcome of a transfer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Reply {
    /// Completed: `count` bytes out, or `bytes` in.
    Done {
        /// Bytes transferred.
        count: usize,
        /// Bytes from the device.
        bytes: Vec<u8>,
    },
    /// No data yet: retry.
    Pending,
    /// No response will come: the transfer must be cancelled.
    Never,
    /// Endpoint stalled.
    Stalled,
    /// Device gone.
    Gone,
}

/// A device in its socket, shared by those who serve it.
pub struct Socket<D>(Arc<Mutex<Port<D>>>);

impl<D> Clone for Socket<D> {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<D: Device> Socket<D> {
    /// Plugs a device in.
    pub fn new(port: Port<D>) -> Self {
        Self(Arc::new(Mutex::new(port)))
    }

    /// The port. A thread that panicked while it had it does not matter: every transfer leaves it
    /// whole.
    pub fn port(&self) -> MutexGuard<'_, Port<D>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A device in its socket.
pub struct Port<D> {
    /// The device.
    pub device: D,
    faults: Faults,
    /// Endpoints that stall.
    halted: Vec<u8>,
    /// Time until the device is plugged in again, s.
    away_s: Option<f64>,
    plugged: u64,
}

const TO_COMPUTER: u8 = 0x80;
const STANDARD: u8 = 0;
const ENDPOINT: u8 = 2;

impl<D: Device> Port<D> {
    /// Plugs a device in, without faults.
    pub fn new(device: D) -> Self {
        Self::with_faults(device, Rates::default(), 1)
    }

    /// Plugs a device in, with faults of its bulk transfers.
    pub fn with_faults(device: D, rates: Rates, seed: u64) -> Self {
        Self {
            device,
            faults: Faults::new(rates, seed),
            halted: Vec::new(),
            away_s: None,
            plugged: 1,
        }
    }

    /// Changes the rates of faults.
    pub fn set_rates(&mut self, rates: Rates) {
        self.faults.rates = rates;
    }

    /// Faults so far.
    #[must_use]
    pub fn counts(&self) -> FaultCounts {
        self.faults.counts
    }

    /// Returns true while it is plugged in.
    #[must_use]
    pub fn is_plugged_in(&self) -> bool {
        self.away_s.is_none()
    }

    /// Returns the number of times it was plugged in. Handles from before the latest are void.
    #[must_use]
    pub fn times_plugged_in(&self) -> u64 {
        self.plugged
    }

    /// Unplugs it for a time, s; infinity is for good.
    pub fn unplug(&mut self, away_s: f64) {
        self.away_s = Some(away_s);
        self.halted.clear();
    }

    /// Lets time pass.
    pub fn advance(&mut self, seconds: f64) {
        self.device.advance(seconds);
        if let Some(left) = &mut self.away_s {
            *left -= seconds;
            if *left <= 0.0 {
                self.away_s = None;
                self.plugged += 1;
                self.device.plugged_in();
            }
        }
    }

    /// A control transfer. `data` is what goes to the device.
    pub fn control(&mut self, setup: &Setup, data: &[u8]) -> Reply {
        if !self.is_plugged_in() {
            return Reply::Gone;
        }
        let answer = if setup.request_type & 0x60 == STANDARD {
            self.standard(setup)
        } else {
            self.device.control(setup, data)
        };
        match answer {
            Answer::Done(mut bytes) => {
                bytes.truncate(usize::from(setup.length));
                let to_computer = setup.request_type & TO_COMPUTER != 0;
                Reply::Done {
                    count: if to_computer { bytes.len() } else { data.len() },
                    bytes,
                }
            }
            Answer::Pending => Reply::Pending,
            Answer::Stall => Reply::Stalled,
        }
    }

    fn standard(&mut self, setup: &Setup) -> Answer {
        let descriptors = self.device.descriptors();
        let [index, kind] = setup.value.to_le_bytes();
        let found = match (setup.request_type, setup.request) {
            // GET_STATUS of the device: self-powered; of an endpoint: whether it stalls.
            (0x80, 0) => Some(vec![1, 0]),
            (0x82, 0) => {
                let halted = self.halted.contains(&(setup.index as u8));
                Some(vec![u8::from(halted), 0])
            }
            (0x80, 6) => match kind {
                1 => Some(descriptors.device()),
                2 if index == 0 => Some(descriptors.configuration()),
                3 => descriptors.string(index),
                _ => None,
            },
            (0x80, 8) => Some(vec![1]),
            (0x81, 10) => Some(vec![0]),
            // SET_CONFIGURATION and SET_INTERFACE: there is one of each.
            (0x00, 9) => (setup.value <= 1).then(Vec::new),
            (0x01, 11) => (setup.value == 0).then(Vec::new),
            // CLEAR_FEATURE ENDPOINT_HALT.
            (ENDPOINT, 1) if setup.value == 0 => {
                self.halted
                    .retain(|endpoint| *endpoint != setup.index as u8);
                Some(Vec::new())
            }
            _ => None,
        };
        found.map_or(Answer::Stall, Answer::Done)
    }

    /// A transfer to an endpoint.
    pub fn write(&mut self, endpoint: u8, bytes: &[u8]) -> Reply {
        let fault = match self.begin(endpoint) {
            Ok(fault) => fault,
            Err(reply) => return reply,
        };
        let bytes = match fault {
            Some(TransferFault::TimeOut) => return Reply::Never,
            Some(TransferFault::Short) => &bytes[..self.faults.part(bytes.len())],
            _ => bytes,
        };
        match self.device.write(endpoint, bytes) {
            Answer::Done(_) => Reply::Done {
                count: bytes.len(),
                bytes: Vec::new(),
            },
            Answer::Pending => Reply::Pending,
            Answer::Stall => Reply::Stalled,
        }
    }

    /// A transfer from an endpoint. A fault is drawn when there is something to give.
    pub fn read(&mut self, endpoint: u8, most: usize) -> Reply {
        if !self.is_plugged_in() {
            return Reply::Gone;
        }
        if self.halted.contains(&endpoint) || !self.device.descriptors().has_endpoint(endpoint) {
            return Reply::Stalled;
        }
        let mut bytes = match self.device.read(endpoint, most) {
            Answer::Done(bytes) => bytes,
            Answer::Pending => return Reply::Pending,
            Answer::Stall => return Reply::Stalled,
        };
        match self.begin(endpoint) {
            Ok(Some(TransferFault::TimeOut)) => return Reply::Never,
            Ok(Some(TransferFault::Short)) => bytes.truncate(self.faults.part(bytes.len())),
            Ok(_) => {}
            Err(reply) => return reply,
        }
        Reply::Done {
            count: bytes.len(),
            bytes,
        }
    }

    /// Draws the fault of a transfer; an error where it ends the transfer at once.
    fn begin(&mut self, endpoint: u8) -> Result<Option<TransferFault>, Reply> {
        if !self.is_plugged_in() {
            return Err(Reply::Gone);
        }
        if self.halted.contains(&endpoint) || !self.device.descriptors().has_endpoint(endpoint) {
            return Err(Reply::Stalled);
        }
        let fault = self.faults.draw();
        match fault {
            Some(TransferFault::Stall) => {
                self.halted.push(endpoint);
                Err(Reply::Stalled)
            }
            Some(TransferFault::Unplug) => {
                self.unplug(self.faults.rates.away_s);
                Err(Reply::Gone)
            }
            other => Ok(other),
        }
    }
}

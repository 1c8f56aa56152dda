//! A port as a transport for a driver in the same program: no libusb, no kernel.

use std::sync::Arc;
use std::time::{Duration, Instant};

use asperity_host::device::falcon::ftdi::{ENDPOINT_IN, ENDPOINT_OUT, REQUEST_TYPE};
use asperity_host::device::falcon::transport::{Direction, TransferError, Transport};
use asperity_host::device::falcon::{OpenError, Opened, Opener};
use asperity_virtual_usb::{Device, Port, Reply, Setup, Socket};

/// Time between two questions whether there is something.
const STEP: Duration = Duration::from_micros(500);

/// A handle of a device; it is void once the device has been unplugged.
pub(crate) struct InProcess<D> {
    socket: Socket<D>,
    plugged: u64,
}

/// Opens a device whenever it is plugged in.
pub(crate) struct InProcessOpener<D>(pub(crate) Socket<D>);

impl<D: Device + 'static> Opener for InProcessOpener<D> {
    fn open(&mut self) -> Result<Opened, OpenError> {
        let Some(transport) = InProcess::open(&self.0) else {
            // Time passes for a device that is away.
            std::thread::sleep(STEP);
            self.0.port().advance(STEP.as_secs_f64());
            return Err(TransferError::Disconnected.into());
        };
        let serial = self.0.port().device.descriptors().strings[2].clone();
        Ok(Opened {
            transport: Arc::new(transport),
            serial: Some(serial),
        })
    }
}

impl<D: Device> InProcess<D> {
    /// Opens a device that is plugged in.
    pub(crate) fn open(socket: &Socket<D>) -> Option<Self> {
        let port = socket.port();
        let plugged = port.is_plugged_in().then(|| port.times_plugged_in())?;
        drop(port);
        Some(Self {
            socket: socket.clone(),
            plugged,
        })
    }

    /// Asks until there is a reply or patience ends. Time passes for the device as for us.
    fn ask(
        &self,
        patience: Duration,
        mut transfer: impl FnMut(&mut Port<D>) -> Reply,
    ) -> Result<(usize, Vec<u8>), TransferError> {
        let begun = Instant::now();
        let mut given_up = false;
        loop {
            let mut port = self.socket.port();
            if port.times_plugged_in() != self.plugged {
                return Err(TransferError::Disconnected);
            }
            if !given_up {
                match transfer(&mut port) {
                    Reply::Done { count, bytes } => return Ok((count, bytes)),
                    Reply::Pending => {}
                    Reply::Never => given_up = true,
                    Reply::Stalled => return Err(TransferError::Stalled),
                    Reply::Gone => return Err(TransferError::Disconnected),
                }
            }
            drop(port);
            if begun.elapsed() >= patience {
                return Err(TransferError::TimedOut);
            }
            std::thread::sleep(STEP);
            self.socket.port().advance(STEP.as_secs_f64());
        }
    }
}

impl<D: Device> Transport for InProcess<D> {
    fn control(&self, request: u8, value: u16, index: u16) -> Result<(), TransferError> {
        let setup = Setup {
            request_type: REQUEST_TYPE,
            request,
            value,
            index,
            length: 0,
        };
        let patience = Duration::from_secs(1);
        self.ask(patience, |port| port.control(&setup, &[]))
            .map(drop)
    }

    fn send(&self, bytes: &[u8], patience: Duration) -> Result<usize, TransferError> {
        let sent = self.ask(patience, |port| port.write(ENDPOINT_OUT, bytes))?;
        Ok(sent.0)
    }

    fn receive(&self, packet: &mut [u8], patience: Duration) -> Result<usize, TransferError> {
        let most = packet.len();
        let (count, bytes) = self.ask(patience, |port| port.read(ENDPOINT_IN, most))?;
        packet[..count].copy_from_slice(&bytes);
        Ok(count)
    }

    fn clear_stall(&self, direction: Direction) -> Result<(), TransferError> {
        let endpoint = match direction {
            Direction::In => ENDPOINT_IN,
            Direction::Out => ENDPOINT_OUT,
        };
        let setup = Setup {
            request_type: 2,
            request: 1,
            value: 0,
            index: endpoint.into(),
            length: 0,
        };
        let patience = Duration::from_secs(1);
        self.ask(patience, |port| port.control(&setup, &[]))
            .map(drop)
    }
}

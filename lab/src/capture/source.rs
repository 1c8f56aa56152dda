//! Where samples come from.

use super::columns::Layout;
use super::error::SensorError;
use super::line::LineDecoder;
use super::samples::{Counts, Samples};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Duration;

/// A sensor that is open. It is read on a thread of its own.
pub trait Source: Send {
    /// Appends what came, and waits for it no longer than `wait`; nothing may have come.
    ///
    /// # Errors
    /// [`SensorError`]; nothing comes afterwards.
    fn read(&mut self, wait: Duration, into: &mut Samples) -> Result<(), SensorError>;

    /// Its columns, once they are known.
    fn layout(&self) -> Option<&Layout>;

    /// Seconds in a unit of the sensor's own time, if it states them.
    fn stated_scale(&self) -> Option<f64>;

    /// Returns the counts so far.
    fn counts(&self) -> Counts;

    /// Its name, for errors.
    fn name(&self) -> &str;
}

/// Bytes of lines.
pub trait Port: Send {
    /// Appends what came, and waits for it no longer than `wait`.
    ///
    /// # Errors
    /// [`SensorError`] where nothing will come any more.
    fn read(&mut self, wait: Duration, into: &mut Vec<u8>) -> Result<(), SensorError>;
}

/// A sensor that sends lines.
pub struct LineSource<P> {
    name: String,
    port: P,
    decoder: LineDecoder,
    bytes: Vec<u8>,
}

impl<P: Port> LineSource<P> {
    /// Lines of a port; with `layout`, their headers do not count.
    pub fn new(name: &str, port: P, layout: Option<Layout>) -> Self {
        Self {
            name: name.to_owned(),
            port,
            decoder: LineDecoder::new(name, layout),
            bytes: Vec::new(),
        }
    }
}

impl<P: Port> Source for LineSource<P> {
    fn read(&mut self, wait: Duration, into: &mut Samples) -> Result<(), SensorError> {
        self.bytes.clear();
        let read = self.port.read(wait, &mut self.bytes);
        self.decoder.feed(&self.bytes, into)?;
        read
    }

    fn layout(&self) -> Option<&Layout> {
        self.decoder.layout()
    }

    fn stated_scale(&self) -> Option<f64> {
        let layout = self.decoder.layout()?;
        layout.has_clock().then_some(1.0)
    }

    fn counts(&self) -> Counts {
        self.decoder.counts()
    }

    fn name(&self) -> &str {
        &self.name
    }
}

/// Lines that another thread of this program sends.
pub struct Sent {
    /// Pieces of them.
    pub from: Receiver<Vec<u8>>,
}

impl Port for Sent {
    fn read(&mut self, wait: Duration, into: &mut Vec<u8>) -> Result<(), SensorError> {
        match self.from.recv_timeout(wait) {
            Ok(bytes) => into.extend_from_slice(&bytes),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Err(SensorError::Ended("sim:".into())),
        }
        Ok(())
    }
}

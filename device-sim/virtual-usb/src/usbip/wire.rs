//! Headers of USB/IP as bytes, big-endian.

use std::io::{self, Read};

use crate::descriptor::Descriptors;

/// Protocol version 1.1.1.
pub const VERSION: u16 = 0x0111;
/// Asks for a list of devices.
pub const REQUEST_LIST: u16 = 0x8005;
/// Answers [`REQUEST_LIST`].
pub const REPLY_LIST: u16 = 0x0005;
/// Asks for a device.
pub const REQUEST_IMPORT: u16 = 0x8003;
/// Answers [`REQUEST_IMPORT`].
pub const REPLY_IMPORT: u16 = 0x0003;
/// Submits a transfer.
pub const SUBMIT: u32 = 1;
/// Takes a transfer back.
pub const UNLINK: u32 = 2;
/// Answers [`SUBMIT`].
pub const SUBMITTED: u32 = 3;
/// Answers [`UNLINK`].
pub const UNLINKED: u32 = 4;

/// Status of a request that is granted.
pub const GRANTED: u32 = 0;
/// Status for a device that another has.
pub const BUSY: u32 = 2;
/// Status for a device that there is not.
pub const NO_DEVICE: u32 = 4;

/// Bytes of a bus id.
pub const BUS_ID: usize = 32;
/// Bytes of a device's record.
pub const RECORD: usize = 312;
/// Bytes of a header once a device is imported.
pub const HEADER: usize = 48;
/// Most bytes of one transfer.
pub const MAX_TRANSFER: u32 = 64 * 1024;

/// Errors of transfers, as Linux numbers them.
pub mod status {
    /// Stalled (EPIPE).
    pub const STALLED: i32 = -32;
    /// Taken back (ECONNRESET).
    pub const TAKEN_BACK: i32 = -104;
}

/// Code and status of a request or reply before a device is imported.
#[must_use]
pub fn operation(code: u16, status: u32) -> Vec<u8> {
    let mut bytes = VERSION.to_be_bytes().to_vec();
    bytes.extend(code.to_be_bytes());
    bytes.extend(status.to_be_bytes());
    bytes
}

/// A bus id as bytes.
#[must_use]
pub fn bus_id(text: &str) -> [u8; BUS_ID] {
    let mut bytes = [0; BUS_ID];
    for (byte, letter) in bytes.iter_mut().zip(text.bytes().take(BUS_ID - 1)) {
        *byte = letter;
    }
    bytes
}

/// A device's record.
#[must_use]
pub fn record(bus_id: &str, number: u32, descriptors: &Descriptors) -> Vec<u8> {
    let mut bytes = vec![0; 256];
    let path = format!("/sys/devices/asperity/{bus_id}");
    bytes[..path.len()].copy_from_slice(path.as_bytes());
    bytes.extend(self::bus_id(bus_id));
    // Bus 1, device, full speed.
    for field in [1, number, 2] {
        bytes.extend(u32::to_be_bytes(field));
    }
    for field in [descriptors.vendor, descriptors.product, descriptors.release] {
        bytes.extend(field.to_be_bytes());
    }
    let interfaces = descriptors.interfaces.len() as u8;
    bytes.extend([descriptors.class, 0, 0, 1, 1, interfaces]);
    bytes
}

/// A header once a device is imported, either way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Header {
    /// [`SUBMIT`], [`UNLINK`], [`SUBMITTED`] or [`UNLINKED`].
    pub command: u32,
    /// Number of the transfer.
    pub sequence: u32,
    /// True for a transfer from the device.
    pub from_device: bool,
    /// Endpoint, without its direction.
    pub endpoint: u32,
    /// The five numbers that follow: for [`SUBMIT`] flags, length, frame, packets, interval; for
    /// [`SUBMITTED`] status, length, frame, packets, errors; for [`UNLINK`] the other's sequence,
    /// and for [`UNLINKED`] the status, first.
    pub numbers: [u32; 5],
    /// The setup of a control transfer.
    pub setup: [u8; 8],
}

impl Header {
    /// As bytes.
    #[must_use]
    pub fn bytes(&self) -> [u8; HEADER] {
        let first = [
            self.command,
            self.sequence,
            // Bus 1, device 1.
            0x0001_0001,
            u32::from(self.from_device),
            self.endpoint,
        ];
        let mut bytes = [0; HEADER];
        for (n, word) in first.into_iter().chain(self.numbers).enumerate() {
            bytes[4 * n..4 * n + 4].copy_from_slice(&word.to_be_bytes());
        }
        bytes[40..].copy_from_slice(&self.setup);
        bytes
    }

    /// From bytes.
    #[must_use]
    pub fn of(bytes: &[u8; HEADER]) -> Self {
        let word = |n: usize| {
            let mut four = [0; 4];
            four.copy_from_slice(&bytes[4 * n..4 * n + 4]);
            u32::from_be_bytes(four)
        };
        let mut setup = [0; 8];
        setup.copy_from_slice(&bytes[40..]);
        Self {
            command: word(0),
            sequence: word(1),
            from_device: word(3) == 1,
            endpoint: word(4),
            numbers: std::array::from_fn(|n| word(5 + n)),
            setup,
        }
    }
}

/// Reads just so many bytes.
///
/// # Errors
/// What the stream says, its end included.
pub fn take<const N: usize>(stream: &mut impl Read) -> io::Result<[u8; N]> {
    let mut bytes = [0; N];
    stream.read_exact(&mut bytes)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Device as _;
    use crate::touch::{Firmware, Touch};

    #[test]
    fn a_header_comes_back_and_lies_as_the_kernel_has_it() {
        let header = Header {
            command: SUBMIT,
            sequence: 0x0102_0304,
            from_device: true,
            endpoint: 1,
            numbers: [5, 64, 7, u32::MAX, 9],
            setup: [0x80, 6, 0, 1, 0, 0, 18, 0],
        };
        let bytes = header.bytes();
        assert_eq!(Header::of(&bytes), header);
        assert_eq!(bytes[..8], [0, 0, 0, 1, 1, 2, 3, 4]);
        assert_eq!(bytes[12..24], [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 5]);
        assert_eq!(bytes[24..28], [0, 0, 0, 64]);
        assert_eq!(bytes[40..], header.setup);
    }

    #[test]
    fn a_record_has_its_312_bytes() {
        let touch = Touch::new(Firmware::Serial);
        let record = record("1-2", 7, touch.descriptors());
        assert_eq!(record.len(), RECORD);
        assert_eq!(&record[256..259], b"1-2");
        assert_eq!(record[288..300], [0, 0, 0, 1, 0, 0, 0, 7, 0, 0, 0, 2]);
        assert_eq!(record[300..304], [0x29, 0x88, 0x03, 0x02]);
        assert_eq!(record[311], 2, "interfaces");
    }
}

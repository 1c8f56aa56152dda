//! The serial chip inside a Falcon (FTDI), as far as the Falcon needs it.
//!
//! Everything is set by vendor requests of type 0x40 without data: a request, a value, and the
//! index 0. A packet to the computer begins with two status bytes.

use super::transport::{TransferError, Transport};

/// Type of the control requests: to the device, vendor, device.
pub const REQUEST_TYPE: u8 = 0x40;
/// Endpoint to the computer.
pub const ENDPOINT_IN: u8 = 0x81;
/// Endpoint to the device.
pub const ENDPOINT_OUT: u8 = 0x02;
/// Bytes of a packet.
pub const PACKET_BYTES: usize = 64;
/// Status bytes at the beginning of a packet to the computer.
pub const STATUS_BYTES: usize = 2;
/// Payload of a packet to the computer, bytes.
pub const PAYLOAD_BYTES: usize = PACKET_BYTES - STATUS_BYTES;

/// Divisor of 3 MBd for 9600 Bd: 312.5, its half in bit 14.
pub const DIVISOR_HANDSHAKE: u16 = 0x4138;
/// Divisor for the firmware's transfer: 21, some 143 kBd, which descriptions call 140 kBd.
pub const DIVISOR_FIRMWARE: u16 = 0x15;
/// Divisor in operation.
pub const DIVISOR_RUNNING: u16 = 0x2;

/// A setting of the chip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Setting {
    /// Forgets what was received and not yet fetched.
    PurgeReceived,
    /// Forgets what was not yet sent.
    PurgeSent,
    /// The line "request to send".
    Rts(bool),
    /// The line "data terminal ready".
    Dtr(bool),
    /// No flow control.
    NoFlowControl,
    /// Baud rate as a divisor of 3 MBd.
    Divisor(u16),
    /// Eight bits, no parity, one stop bit.
    EightNone1,
    /// Milliseconds after which the chip sends a packet that is not full.
    LatencyMs(u8),
}

impl Setting {
    /// Request and value.
    #[must_use]
    pub const fn request(self) -> (u8, u16) {
        match self {
            Self::PurgeReceived => (0, 1),
            Self::PurgeSent => (0, 2),
            Self::Dtr(on) => (1, 0x100 | on as u16),
            Self::Rts(on) => (1, 0x200 | (on as u16) << 1),
            Self::NoFlowControl => (2, 0),
            Self::Divisor(divisor) => (3, divisor),
            Self::EightNone1 => (4, 8),
            Self::LatencyMs(ms) => (9, ms as u16),
        }
    }

    /// The setting of a request, which a virtual device reads. `None` for one that the Falcon does
    /// not need.
    #[must_use]
    pub const fn of(request: u8, value: u16) -> Option<Self> {
        Some(match (request, value) {
            (0, 1) => Self::PurgeReceived,
            (0, 2) => Self::PurgeSent,
            (1, 0x100 | 0x101) => Self::Dtr(value & 1 != 0),
            (1, 0x200 | 0x202) => Self::Rts(value & 2 != 0),
            (2, 0) => Self::NoFlowControl,
            (3, divisor) => Self::Divisor(divisor),
            (4, 8) => Self::EightNone1,
            (9, 1..=255) => Self::LatencyMs(value as u8),
            _ => return None,
        })
    }
}

/// For the handshake of a device that waits for its firmware. A latency of 16 ms lets an answer
/// arrive in one packet. The last falling and rising DTR resets the processor.
pub const HANDSHAKE: [Setting; 9] = [
    Setting::PurgeReceived,
    Setting::PurgeSent,
    Setting::LatencyMs(16),
    Setting::Divisor(DIVISOR_HANDSHAKE),
    Setting::EightNone1,
    Setting::NoFlowControl,
    Setting::Rts(false),
    Setting::Dtr(false),
    Setting::Dtr(true),
];
/// For the transfer of the firmware.
pub const FIRMWARE: [Setting; 2] = [Setting::Dtr(false), Setting::Divisor(DIVISOR_FIRMWARE)];
/// For operation: a packet waits for 1 ms at most.
pub const RUNNING: [Setting; 4] = [
    Setting::LatencyMs(1),
    Setting::Divisor(DIVISOR_RUNNING),
    Setting::PurgeReceived,
    Setting::PurgeSent,
];

/// Makes settings, in their order.
///
/// # Errors
/// The first [`TransferError`].
pub fn set(transport: &dyn Transport, settings: &[Setting]) -> Result<(), TransferError> {
    settings.iter().try_for_each(|setting| {
        let (request, value) = setting.request();
        transport.control(request, value, 0)
    })
}

/// Returns the payload of a packet, behind its status bytes.
#[must_use]
pub fn payload(packet: &[u8]) -> &[u8] {
    packet.get(STATUS_BYTES..).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_device_reads_the_setting_that_was_made() {
        let all = [&HANDSHAKE[..], &FIRMWARE, &RUNNING, &[Setting::Rts(true)]].concat();
        for setting in all {
            let (request, value) = setting.request();
            assert_eq!(Setting::of(request, value), Some(setting));
        }
        for (request, value) in [(0, 3), (1, 0x301), (9, 0), (9, 256), (200, 0)] {
            assert_eq!(Setting::of(request, value), None);
        }
    }

    #[test]
    fn divisors_are_the_baud_rates_they_are_named_for() {
        let divisor = f64::from(DIVISOR_HANDSHAKE & 0x3fff) + 0.5;
        assert_eq!(3e6 / divisor, 9600.0);
        assert!((3e6 / f64::from(DIVISOR_FIRMWARE) - 140e3).abs() / 140e3 < 0.03);
    }

    #[test]
    fn a_packet_without_payload_carries_nothing() {
        for packet in [&[][..], &[1], &[1, 0x60]] {
            assert!(payload(packet).is_empty());
        }
        assert_eq!(payload(&[1, 0x60, 7]), [7]);
    }
}

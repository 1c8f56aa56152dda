//! Transport to a Falcon: USB, or a virtual device in the same program.

use std::time::Duration;

use thiserror::Error;

/// Why a transfer gave nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum TransferError {
    /// Nothing came, or was taken, within the time.
    #[error("no answer in time")]
    TimedOut,
    /// The endpoint stalled; [`Transport::clear_stall`] clears it.
    #[error("the device refused the transfer (stall)")]
    Stalled,
    /// The device is gone.
    #[error("the device is gone")]
    Disconnected,
    /// Anything else that the system reports.
    #[error("the system reports an input/output error")]
    Failed,
}

/// Which way an endpoint goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// To the computer.
    In,
    /// To the device.
    Out,
}

/// Carries control requests and the two bulk streams of a serial chip. Two threads use it at once:
/// one that sends, one that receives.
pub trait Transport: Send + Sync {
    /// A vendor's request without data.
    ///
    /// # Errors
    /// [`TransferError`].
    fn control(&self, request: u8, value: u16, index: u16) -> Result<(), TransferError>;

    /// Sends bytes; gives how many were taken.
    ///
    /// # Errors
    /// [`TransferError`].
    fn send(&self, bytes: &[u8], patience: Duration) -> Result<usize, TransferError>;

    /// Receives one packet, its two status bytes included; gives its length.
    ///
    /// # Errors
    /// [`TransferError`].
    fn receive(&self, packet: &mut [u8], patience: Duration) -> Result<usize, TransferError>;

    /// Clears a stall.
    ///
    /// # Errors
    /// [`TransferError`].
    fn clear_stall(&self, direction: Direction) -> Result<(), TransferError>;
}

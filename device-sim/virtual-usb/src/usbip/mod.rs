//! USB over TCP, as Linux's `usbip` speaks it (protocol 1.1.1, `Documentation/usb/usbip_protocol`).
//!
//! | file | holds |
//! |---|---|
//! | [`wire`] | headers as bytes |
//! | [`server`] | serves ports; a transfer that has no answer yet stays pending |

pub mod server;
pub mod wire;

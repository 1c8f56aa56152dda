//! Seeded faults around any device.
//!
//! A [`FaultPlan`](crate::fault_plan::FaultPlan) says when they begin. The device behind goes on in any case: what it measured is thrown
//! away, as a lost packet is.
//!
//! | fault | a reading gives | a force |
//! |---|---|---|
//! | lost | [`DeviceError::TimedOut`](super::DeviceError) | arrives |
//! | late | the last reading, not fresh | arrives |
//! | duplicate | the last reading once more, as if fresh | arrives |
//! | stuck | fresh buttons at the last position | arrives |
//! | not finite | a coordinate that is NaN or infinite | arrives |
//! | out of range | a coordinate some metres away | arrives |
//! | short transfer | [`DeviceError::ShortTransfer`](super::DeviceError) | arrives |
//! | stalled | [`DeviceError::Stalled`](super::DeviceError) | arrives |
//! | unplugged | [`DeviceError::Disconnected`](super::DeviceError) | does not arrive, and the device has none |
//! | write failed | what was measured | does not arrive; the device keeps the last one |
//! | clock step | what was measured, and [`DeviceFaultInjector::take_clock_step`] says how many periods are gone | arrives |
//!
//! [`trial`] runs one of them in the middle of a contact, and says what became of the force.

mod injector;
mod kind;
pub mod trial;

pub use injector::DeviceFaultInjector;
pub use kind::InjectedFault;

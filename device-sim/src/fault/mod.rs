//! Seeded faults between a device and a servo, stackable on any servo.
//!
//! A [`FaultPlan`] says when they begin. The servo sees each kind as follows:
//!
//! | fault | the servo sees |
//! |---|---|
//! | NaN | a fresh sample with a NaN or infinite coordinate |
//! | dropped | no tick at all; the next sample says how many passed |
//! | stale | the last sample again, with `elapsed_ticks` 0 |
//! | stuck | fresh samples whose position does not change |
//! | late | stale samples, then one that says how many ticks passed |

mod injector;
mod kind;

pub use asperity_host::fault_plan::FaultPlan;
pub use injector::FaultInjector;
pub use kind::SampleFault;

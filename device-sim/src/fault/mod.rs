//! Seeded faults between a device and a servo, stackable on any servo.
//!
//! At most one fault runs at a time; while none does, each tick draws one with the
//! configured probabilities. What a servo can tell of each:
//!
//! | fault | the servo sees |
//! |---|---|
//! | NaN | a fresh sample with a NaN or infinite coordinate |
//! | dropped | no tick at all; the next sample says how many went by |
//! | stale | the last sample again, `elapsed_ticks` 0 |
//! | stuck | fresh samples that never move |
//! | late | stale ones, then one that says how many ticks went by |

mod injector;
mod plan;

pub use injector::FaultInjector;
pub use plan::{Fault, FaultCounts, FaultPlan, FaultPlanError, FaultRate};

//! The stages of a tick, each with its equation, its bound and one `step`, which the tick calls.
//!
//! A stage is a configuration, which does not change, and a small state, which does:
//! `configuration.step(&mut state, …)`. A `step` cannot fail and takes nearly the same time
//! whatever its input.

pub mod contact;
pub mod contact_law;
pub(crate) mod direction;
pub mod excitation;
pub(crate) mod force_crossing;
pub mod friction;
pub(crate) mod friction_law;
pub mod limiter;
pub mod passivity;
pub mod recursion;
pub mod sample_gate;
pub(crate) mod spring_shape;
pub(crate) mod table;
pub mod tap;
pub(crate) mod upsample;
pub mod velocity;
pub mod vibration;
pub mod wall;

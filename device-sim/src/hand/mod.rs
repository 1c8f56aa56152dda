//! A virtual hand: a grip on the stylus and a script of intentions.
//!
//! The grip's spring and damper pull the stylus to where the hand means to be. In
//! the air the hand also feeds forward the inertia and friction it knows of, as a
//! practised hand does, so that it is where it means to be. In contact it holds a
//! normal force instead of a height: the spring is loaded by the wanted force, the
//! hand sinks as far as it has learned that the surface yields, and an integrator
//! corrects what is felt in the stylus, at the grip's bandwidth.

mod controller;
mod grip;
mod intent;
mod motion;
mod path;
mod script;

pub use controller::Hand;
pub use grip::{Grip, GripPreset};
pub use intent::Intent;
pub use motion::Motion;
pub use path::{StrokePath, TapPath, min_jerk, scrub_m};
pub use script::{HOVER_M, Script};

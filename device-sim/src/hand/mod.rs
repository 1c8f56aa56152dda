//! A virtual hand: a grip on the stylus and a script of intentions.
//!
//! The grip's spring and damper pull the stylus towards the intended position. In the air the
//! hand also feeds forward the inertia and friction that it knows, as a practised hand does, so
//! that it reaches that position. In contact it holds a normal force instead of a height: it
//! loads the spring by the wanted force, sinks by the compliance of the surface that it has
//! learned, and corrects the force that it feels with an integrator of the grip's bandwidth.

mod controller;
mod grip;
mod intent;
mod motion;
mod path;
pub mod recording;
mod script;

pub use controller::Hand;
pub use grip::{Grip, GripPreset};
pub use intent::Intent;
pub use motion::Motion;
pub use path::{StrokePath, TapPath, min_jerk, scrub_m};
pub use script::{HOVER_M, Script};

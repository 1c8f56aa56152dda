//! A simulated bench: known textures are stroked and tapped, simulated sensors write files, and what an
//! import makes of the files is held against the truth.
//!
//! The importer gets what a sensor would: three axes of acceleration with gravity, noise and a clock
//! of their own, force with noise and bias, the measured position. It never sees the texture.

mod error;
mod learning_curve;
mod perform;
mod sensors;
mod textures;
mod tool;
mod truth;

pub use error::ImportAccuracyError;
pub use learning_curve::{Figures, GOAL_DB, LOUD_DB, LearningCurvePoint, learn, summary};
pub use perform::{Performance, Strokes, Until, perform};
pub use sensors::{BENT_S, GRAVITY_M_S2, HAND_HALF, across, of_tool};
pub use sensors::{Sensors, record};
pub use textures::materials;
pub use tool::{MOST_FREE_TAPS, Resonance};
pub use truth::{Cell, Comparison, compare, compare_at};

//! Physical quantities: numbers with a unit, which only add up where the units are the same.
//!
//! A [`Quantity`] is one number, a [`Vector`] has three components along the world's axes, a
//! [`Four`] is four numbers side by side. [`mod@unit`] is the table of units, each with its binary
//! point in fixed point; [`product`] says which product and which quotient give which unit, and
//! where they are cut. In floats a quantity is an `f32` and costs nothing.
//!
//! ```
//! use asperity_runtime::{Float, quantity::{Quantity, unit::{Metre, Newton, NewtonPerMetre}}};
//!
//! let stiffness = Quantity::<Float, NewtonPerMetre>::of(500.0);
//! let depth = Quantity::<Float, Metre>::of(0.001);
//! let force: Quantity<Float, Newton> = stiffness * depth;
//! assert_eq!(force.value(), 0.5);
//! ```
//!
//! A force and an acceleration do not add up, in floats either:
//!
//! ```compile_fail,E0308
//! use asperity_runtime::{Float, quantity::{Quantity, unit::{Newton, VibrationAcceleration}}};
//!
//! let force = Quantity::<Float, Newton>::of(1.0);
//! let acceleration = Quantity::<Float, VibrationAcceleration>::of(1.0);
//! let sum = force + acceleration;
//! ```
//!
//! A speed times a length is no force; there is no such product in the table:
//!
//! ```compile_fail,E0277
//! use asperity_runtime::{Float, quantity::{Quantity, unit::{Metre, MetrePerSecond, Newton}}};
//!
//! let speed = Quantity::<Float, MetrePerSecond>::of(1.0);
//! let length = Quantity::<Float, Metre>::of(1.0);
//! let force: Quantity<Float, Newton> = speed * length;
//! ```
//!
//! Nor is a stiffness times a length a length:
//!
//! ```compile_fail,E0308
//! use asperity_runtime::{Float, quantity::{Quantity, unit::{Metre, NewtonPerMetre}}};
//!
//! let stiffness = Quantity::<Float, NewtonPerMetre>::of(500.0);
//! let depth = Quantity::<Float, Metre>::of(0.001);
//! let length: Quantity<Float, Metre> = stiffness * depth;
//! ```

mod four;
mod magnitude;
pub mod product;
mod scalar;
pub mod unit;
mod vector;

pub use self::{
    four::Four,
    magnitude::{Magnitude, Magnitudes, Projection},
    scalar::{Quantity, Raw},
    vector::{StoredVector, Vector},
};

//! Other methods, from published descriptions, that the table compares with the runtime's.
//!
//! They compute in f64, so that failures come from the method and not from rounding.

pub mod all_pole;
pub mod coulomb;
pub mod fixed_point;
pub mod walk;

pub use all_pole::AllPole;
pub use coulomb::{Regularised, Sign};

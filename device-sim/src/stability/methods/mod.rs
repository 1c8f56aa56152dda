//! Other ways to do what the runtime does, from published descriptions: what the table
//! compares ours with. In f64, so that what fails is the method and not its rounding.

pub mod all_pole;
pub mod coulomb;
pub mod fixed_point;
pub mod walk;

pub use all_pole::AllPole;
pub use coulomb::{Regularised, Sign};

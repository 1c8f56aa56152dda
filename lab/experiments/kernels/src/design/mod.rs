//! The factors of a kernel, the default, and the variants that are compared with it.

mod settings;
mod variants;

pub use settings::{Arithmetic, Design, Level, Order, Shape, Structure, Transition};
pub use variants::{Factor, Variant, variants};

//! From bytes to a plan. Everything about a model that can be checked is checked here, once.

pub(crate) mod constant;
mod fuse;
mod graph;
pub(crate) mod ports;
mod refusal;
mod scan;

pub(crate) use constant::Constant;
pub use graph::{MAX_OPSET, MIN_OPSET};
pub(crate) use graph::{Plan, Slot, Step, load};

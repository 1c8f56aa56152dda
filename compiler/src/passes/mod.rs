//! From one texture model to another: rate, stability, size.

pub mod ceiling;
pub mod reduce;
pub mod rerate;
pub mod stabilise;

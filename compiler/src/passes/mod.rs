//! From one texture model to another: rate, stability, size, ceiling.

pub mod ceiling;
pub mod reduce;
pub mod rerate;
pub mod stabilise;

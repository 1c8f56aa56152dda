//! From one texture model to another: rate, stability, size, triangles.

pub mod ceiling;
pub mod reduce;
pub mod rerate;
pub mod stabilise;
pub mod triangulate;

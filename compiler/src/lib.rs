//! The Asperity compiler.
pub mod model;

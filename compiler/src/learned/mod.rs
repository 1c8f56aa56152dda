//! The learned model: its folder, its description, its networks.

pub mod description;
pub mod friction;
pub mod level;

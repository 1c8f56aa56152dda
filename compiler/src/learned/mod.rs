//! The learned model: its folder, its description, its networks.

pub mod description;

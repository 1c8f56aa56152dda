//! Alternatives to the tick, and what each costs and loses.
//!
//! The runtime renders in one way. Why that way, these labs measure with kernels of every
//! other way ([`asperity_kernels`]).
//!
//! | module | holds |
//! |---|---|
//! | [`kernel`] | the kernels on the compiler's models |
//! | [`material`] | the textures that are measured |
//! | [`accuracy`] | how far a design is from the f64 oracle, at rest and moving |
//! | [`held_out`] | how well an interpolation predicts a measured model it has not seen |
//! | [`cost`] | executed instructions, bytes, time |
//! | [`pareto`] | all of it over all materials |
//! | [`noise`], [`statistics`] | what they need |
//! | [`table`] | the CSV files |
//! | [`markdown`] | the tables of the documentation |
//! | [`chart`] | the pictures |

pub mod accuracy;
pub mod chart;
pub mod cost;
pub mod held_out;
pub mod kernel;
pub mod markdown;
pub mod material;
pub mod noise;
pub mod pareto;
pub mod statistics;
pub mod table;

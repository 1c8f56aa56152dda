//! Alternatives to the tick, and what each costs and loses.
//!
//! The runtime renders in one way. These measurements say why: they run kernels of every other
//! way ([`asperity_kernels`]) on the same textures.
//!
//! | module | holds |
//! |---|---|
//! | [`kernel`] | the kernels on the compiler's models |
//! | [`material`] | the textures that are measured |
//! | [`accuracy`], [`difference`] | how far a design is from the f64 oracle, at rest and moving |
//! | [`contact`] | contact laws with a part left out, and a linear spring in their place |
//! | [`direction`] | ways to follow the direction of a stroke |
//! | [`cost`], [`cortex_m`] | executed instructions, bytes |
//! | [`reduced_material`] | what `--fidelity auto` keeps of a material |
//! | [`mod@measure`], [`summary`], [`front`] | every design on every material, and which designs no other beats |
//! | [`noise`], [`statistics`] | seeded noise; percentiles and levels |
//! | [`json`], [`markdown`] | results as JSON, as tables of the documentation |
//! | [`chart`] | the pictures |

pub mod accuracy;
pub mod chart;
pub mod contact;
pub mod cortex_m;
pub mod cost;
pub mod difference;
pub mod direction;
pub mod front;
pub mod json;
pub mod kernel;
pub mod markdown;
pub mod material;
pub mod measure;
pub mod noise;
pub mod reduced_material;
pub mod statistics;
pub mod summary;

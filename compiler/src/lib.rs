//! The Asperity compiler turns prompts, recordings, effects from other tools and models of your own into compact haptic
//! assets, and verifies each asset before returning it.
//!
//! ```
//! use asperity::{learned::inference::Backend, sources::prompt::{Options, PromptCompiler}};
//! use asperity_formats::Asset;
//!
//! // The text encoder and the learned model are embedded: no file, no network.
//! let prompt_compiler = PromptCompiler::embedded(&Backend::Portable)?;
//! let compiled = prompt_compiler.compile("wet ice", &Options::default())?;
//! let bytes = &compiled.lowered.bytes; // what an `.asp` file holds
//!
//! let asset = Asset::parse(bytes).expect("a verified asset");
//! assert_eq!(asset.name(), "wet ice");
//! assert!(compiled.verified.is_some()); // the runtime itself has rendered these bytes
//! # Ok::<(), asperity::driver::Failure>(())
//! ```
//!
//! An asset holds one texture: what a stylus feels when it taps a material, presses it and slides over it. The compiler
//! runs ahead of time; [`asperity_runtime`] renders the asset in a servo loop, one tick at a time. Verification drives
//! that same runtime over the whole domain of the asset, so that what is checked is what is felt.
//!
//! # What to read first
//!
//! 1. [`driver`]: the one way from any source to verified bytes, which commands and libraries take too.
//!    [`compiled::Compiled`] is what it returns.
//! 2. [`sources`]: what a texture can be made from, and the trait that a source of your own implements.
//! 3. [`model`]: a texture between its source and its bytes. [`emit::lower`] encodes it, [`emit::verify`] tests it,
//!    [`emit::raise`] reads it back.
//! 4. [`library`] for many textures, [`scene`] for several surfaces, [`sources::latents`] to change a texture later.
//!
//! `docs/reading.md` in the repository follows a prompt through these modules, with the equations.
//!
//! # Folders
//!
//! A texture passes through these folders from its source to its bytes; the others serve all of them. A module's public
//! path is its folder.
//!
//! | folder | contents |
//! |---|---|
//! | [`sources`] | one trait, and a folder or a file for each source; latents, mixed and edited |
//! | [`compiled`] | the result: textures, their reports, their distance from the source |
//! | [`learned`] | the learned model, embedded or in a folder, its text encoders, and their inference |
//! | [`passes`] | from model to model: rate, stability, size, ceiling |
//! | [`emit`] | from model to bytes and back, one texture or a library of them |
//! | [`library`] | many textures: the library of a manifest, its cache, its changes |
//! | [`edit_memory`] | what an asset remembers of how it was made, for later edits |
//! | [`interchange`] | other tools' formats |
//! | [`views`] | pictures and sound: plots, previews, playback, renderings |
//!
//! The model between source and bytes, in f64 and SI units, and its mathematics are a crate below this one,
//! [`asperity_texture`], whose folders [`model`] and [`signal`] are named here as well.
//!
//! The [`driver`] takes any source through the passes of the [`pipeline`] to verified bytes. [`scene`] packs several
//! textures within a budget. Below this crate, `asperity-io` reads files within limits, writes them whole or not at
//! all, and words failures with their remedy; above it, `asperity-console` and the command `asperity` talk to people.
#![forbid(unsafe_code)]

pub mod compiled;
pub mod driver;
pub mod edit_memory;
pub mod emit;
pub mod interchange;
mod json;
pub mod learned;
pub mod library;
mod name;
pub mod passes;
pub mod pipeline;
pub mod scene;
pub mod sources;
pub mod views;

/// Diagnostics of this crate's errors: their remedies.
pub use asperity_io::diagnostic;

pub use asperity_texture::{model, signal};

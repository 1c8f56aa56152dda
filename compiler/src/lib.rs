//! The Asperity compiler turns prompts, recordings, effects from other tools and models of your own into compact haptic
//! assets, and verifies each asset before returning it.
//!
//! ```
//! use asperity::{
//!     inference::Backend,
//!     prompt::{Options, PromptCompiler},
//! };
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
//! 3. [`model`]: a texture between its source and its bytes. [`lower`] encodes it, [`verify`] tests it, [`raise`] reads
//!    it back.
//! 4. [`library`] for many textures, [`scene`] for several surfaces, [`edit`] to change a texture later.
//!
//! `docs/reading.md` in the repository follows a prompt through these modules, with the equations.
//!
//! # Where everything is
//!
//! A texture passes through these folders from its source to its bytes; the others serve all of them:
//!
//! | folder | holds |
//! |---|---|
//! | `sources/` | what a texture is made from: one trait ([`sources`]), and a folder or a file for each source |
//! | | [`prompt`], [`hatt`], [`recording`], [`model_file`], [`effects`], [`builtin`]; an asset as it is |
//! | | latents, mixed and edited: [`edit`] |
//! | `compiled/` | the result: [`compiled`] textures, their reports, their distance from the source |
//! | `learned/` | the [`learned`] model, [`embedded`] or in a folder, its [`text`] encoders, and their [`inference`] |
//! | `passes/` | from model to model: [`rerate`], [`stabilise`], [`reduce`], [`ceiling`], [`triangulate`] |
//! | `emit/` | from model to bytes and back: [`lower`], [`verify`], [`textures`], [`raise`] |
//! | `library/` | many textures: the [`library`] of a manifest, its cache, what changed in it |
//! | `edit_memory/` | what an asset remembers of how it was made, for later edits: [`edit_memory`] |
//! | `interchange/` | other tools' formats: the [`interchange`] |
//! | `views/` | for eyes and ears: [`inspect`], [`plot`], [`preview`], [`diffusion`], [`listen`], [`render`] |
//!
//! The model between source and bytes, in f64 and SI units, and its mathematics are a crate below this one,
//! [`asperity_texture`]. Its modules are named here as well: the [`model`], its [`mesh`], [`mixture`], [`attributes`],
//! [`defaults`] and [`tap_synthesis`]; [`lsf`], [`levinson`], [`level`], [`reflection`], [`resample`], [`spectrum`] and
//! [`impact`].
//!
//! The [`driver`] takes any source through the passes of the [`pipeline`] to verified bytes. [`scene`] packs several
//! textures within a budget. Below this crate, `asperity-io` reads files within limits, writes them whole or not at
//! all, and words failures with their remedy; above it, `asperity-console` and the command `asperity` talk to people.
#![forbid(unsafe_code)]

mod emit;
mod passes;
mod views;

pub mod compiled;
pub mod driver;
pub mod edit_memory;
pub mod interchange;
pub mod learned;
pub mod library;
pub mod pipeline;
pub mod scene;
pub mod sources;

/// Diagnostics of this crate's errors: their remedies.
pub use asperity_io::diagnostic;

// Users name a module without its folder, so that files can move between the stages.
pub use asperity_texture::model::{self, attributes, defaults, mesh, mixture, tap_synthesis};
pub use asperity_texture::signal::{
    impact, level, levinson, lsf, quantile, reflection, resample, spectrum,
};
pub use emit::{lower, raise, textures, verify};
pub use learned::{embedded, inference, text};
pub use passes::{ceiling, reduce, rerate, stabilise, triangulate};
pub use sources::{builtin, effects, hatt, latents as edit, model_file, prompt, recording};
pub use views::{diffusion, inspect, listen, plot, preview, render};

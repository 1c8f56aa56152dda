//! The Asperity compiler: textures in, compact and verified haptic assets out.
//!
//! A texture passes these folders from its source to its bytes; the others serve all of them:
//!
//! | folder | holds |
//! |---|---|
//! | `sources/` | what a texture is made of, one trait ([`sources`]) and a folder each: [`prompt`], [`hatt`], [`recording`], [`model_file`], [`effects`], [`builtin`], assets, and latents, mixed and edited: [`edit`] |
//! | `compiled/` | what comes of a source: [`compiled`], its reports, its distance from what it was made of |
//! | `learned/` | the [`learned`] model, [`embedded`] or in a folder, its [`text`] encoders, and what runs them: [`inference`] |
//! | `passes/` | from model to model: [`rerate`], [`stabilise`], [`reduce`], [`triangulate`] |
//! | `emit/` | from model to bytes and back: [`lower`], [`verify`], [`textures`], [`raise`] |
//! | `library/` | many textures: the [`library`] of a manifest, its cache, what changed in it |
//! | `edit_memory/` | what an asset remembers of its making, for edits: [`edit_memory`] |
//! | `interchange/` | other tools' formats: the [`interchange`] |
//! | `views/` | what a person looks at: [`inspect`], [`plot`], [`preview`], [`diffusion`], [`listen`], [`render`] |
//!
//! The model between source and bytes, f64 and SI units, and its mathematics are a crate below this one,
//! [`asperity_texture`]; its modules are named here as well: the [`model`], its [`mesh`], [`mixture`], [`attributes`],
//! [`defaults`] and [`tap_synthesis`]; [`lsf`], [`levinson`], [`level`], [`reflection`], [`resample`], [`spectrum`] and
//! [`impact`].
//!
//! The [`driver`] takes any source through the passes of the [`pipeline`] to verified bytes: commands
//! and libraries take this one way. [`scene`] packs several textures within a budget. Below this
//! crate, `asperity-io` reads files within limits, writes them whole or not at all, and states
//! failures; above it, `asperity-console` and the command `asperity` talk to people.
#![forbid(unsafe_code)]

mod emit;
mod passes;
mod views;
mod words;

pub mod compiled;
pub mod driver;
pub mod edit_memory;
pub mod interchange;
pub mod learned;
pub mod library;
pub mod pipeline;
pub mod scene;
pub mod sources;

/// What every error of this crate says besides its cause: the remedy.
pub use asperity_io::diagnostic;

// Users name a module without its folder, so that files can move between the stages.
pub use asperity_texture::model::{self, attributes, defaults, mesh, mixture, tap_synthesis};
pub use asperity_texture::signal::{impact, level, levinson, lsf, reflection, resample, spectrum};
pub use emit::{lower, raise, textures, verify};
pub use learned::{embedded, inference, text};
pub use passes::{ceiling, reduce, rerate, stabilise, triangulate};
pub use sources::{builtin, effects, hatt, latents as edit, model_file, prompt, recording};
pub use views::{diffusion, inspect, listen, plot, preview, render};

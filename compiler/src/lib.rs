//! The Asperity compiler: textures in, compact and verified haptic assets out.
//!
//! A front end ([`hatt`], [`builtin`]) makes a [`model::TextureModel`] in f64 and SI
//! units; [`lower`] quantises it into the bytes of an asset and reports the error;
//! [`verify`] drives the real runtime over the whole domain before anything is
//! written. [`raise`] goes back, for [`inspect`] and [`plot`]; [`render`] runs a
//! trajectory through the runtime; [`scene`] packs what a scene touches within a budget.
#![forbid(unsafe_code)]

pub mod attributes;
pub mod builtin;
pub mod defaults;
pub mod diagnostic;
pub mod embedded;
pub mod hatt;
pub mod inference;
pub mod inspect;
pub mod interpolate;
pub mod learned;
pub mod levinson;
pub mod library;
pub mod lower;
pub mod lsf;
pub mod mesh;
pub mod model;
pub mod output;
pub mod plot;
pub mod preview;
pub mod progress;
pub mod prompt;
pub mod raise;
pub mod reduce;
pub mod reflection;
pub mod render;
pub mod rerate;
pub mod scene;
pub mod source;
pub mod spectrum;
pub mod tap_synthesis;
pub mod text;
pub mod triangulate;
pub mod verify;

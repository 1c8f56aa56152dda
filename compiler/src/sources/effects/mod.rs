//! Effects of other tools as textures: `.haptic`, AHAP and HJIF.
//!
//! Such a file knows no speed, no force and no acceleration. Its continuous effects become the models
//! of one stroke, at a speed and a force that the user states, and its transients become taps. The
//! level follows from the accelerations that the user states for a full scale.
//!
//! ```
//! use asperity::{driver, sources::{effects::{Effects, EffectsKind, Options}, Tools}, pipeline::Request};
//!
//! # let folder = tempfile::tempdir().expect("a temporary folder");
//! // A file with a single transient.
//! let file = folder.path().join("click.ahap");
//! # std::fs::write(&file, r#"{"Version": 1.0, "Pattern": [{"Event": {"Time": 0.0, "EventType": "HapticTransient",
//! #     "EventParameters": [{"ParameterID": "HapticIntensity", "ParameterValue": 1.0}]}}]}"#)
//! #     .expect("a writable folder");
//! let source = Effects { file, kind: EffectsKind::Ahap, options: Options::default() };
//! let compiled = driver::compile(&source, &Request::default(), &Tools::default())?;
//! assert_eq!(compiled.texture.name, "click");
//! assert_eq!(compiled.texture.taps.traces.len(), 1);
//! # Ok::<(), asperity::driver::Failure>(())
//! ```

#[cfg(test)]
mod frozen;
mod source;
mod stroke;
#[cfg(test)]
pub(crate) mod tests;

pub use source::{Effects, EffectsKind, Options};

//! A manifest: which textures a library has, as TOML, CSV or JSON lines.
//!
//! All three give the same rows. Every row is checked by itself, then all of them together, and
//! every fault is reported with file, line and key.
//!
//! ```
//! use asperity::library::Manifest;
//! use std::path::Path;
//!
//! let file = Path::new("materials.toml");
//! let text = "[[texture]]\nname = \"oak\"\nprompt = \"rough oak\"\n[[texture]]\nprompt = \"cork\"\n";
//! let manifest = Manifest::of_text(file, text).expect("a valid manifest");
//! let names: Vec<&str> = manifest.entries.iter().map(|entry| entry.name.as_str()).collect();
//! assert_eq!(names, ["cork", "oak"]); // in order of name
//!
//! let faults = Manifest::of_text(file, "[[texture]]\nprompt = 7\n").unwrap_err();
//! assert_eq!((faults[0].line, faults[0].field.as_str()), (Some(2), "prompt"));
//! ```

mod cells;
mod check;
mod csv_file;
mod entry;
mod graph;
mod json_file;
mod missing;
mod read;
mod row;
mod toml_file;
mod values;

pub use entry::{Entry, EntryLocation, Options, Origin};
pub use read::{Manifest, Setup, is_scene};

pub(in crate::library) use graph::order;
pub(in crate::library) use values::CONFINED_REMEDY;

//! Asperity for Python.
//!
//! The package `asperity` is Python in `python/asperity/` and this module, `asperity._native`. The
//! module holds what needs the compiler or the runtime; records of plain values are Python. Doc
//! comments of Python items are their docstrings, so they follow NumPy's style.
//!
//! | file | holds |
//! |---|---|
//! | `author.rs` | `compile`, `Author`: prompts |
//! | `mix.rs` | `blend`, `compose`, `encode`, edits |
//! | `import.rs` | `import_hatt`, `import_model`, `import_effect`, `builtin` |
//! | `measured.rs` | `import_recording`, `import_surface` |
//! | `export.rs` | `export` |
//! | `texture.rs` | `Texture`, over `contents.rs` and `arrays.rs` |
//! | `library.rs`, `scene.rs`, `load.rs` | `Library`, `Scene`, `pack`, `load` |
//! | `build.rs`, `libraries.rs` | `build`, `merge`, `diff` |
//! | `renderer.rs` | `Renderer`, over `motion.rs`, `servo.rs` and `columns.rs` |
//! | `error.rs`, `records.rs` | exceptions and records that are Python |
//!
//! Long work releases the interpreter; `watch.rs` lets Ctrl-C end what has steps. A panic becomes a Python exception.

mod arguments;
mod arrays;
mod author;
mod build;
mod columns;
mod contents;
mod error;
mod export;
mod import;
mod libraries;
mod library;
mod load;
mod measured;
mod mix;
mod motion;
mod output;
mod records;
mod renderer;
mod scene;
mod servo;
mod texture;
mod watch;

use pyo3::pymodule;

/// The native part of the package `asperity`.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::author::{PromptCompiler, compile};
    #[pymodule_export]
    use crate::build::build;
    #[pymodule_export]
    use crate::contents::Texture;
    #[pymodule_export]
    use crate::export::export;
    #[pymodule_export]
    use crate::import::{builtin, import_effect, import_hatt, import_model};
    #[pymodule_export]
    use crate::libraries::{diff, merge};
    #[pymodule_export]
    use crate::library::{Library, pack};
    #[pymodule_export]
    use crate::load::load;
    #[pymodule_export]
    use crate::measured::{import_recording, import_surface};
    #[pymodule_export]
    use crate::mix::{blend, compose, encode};
    #[pymodule_export]
    use crate::output::Output;
    #[pymodule_export]
    use crate::renderer::Renderer;
    #[pymodule_export]
    use crate::scene::Scene;
    #[pymodule_export]
    use crate::texture::plot;

    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "Python's name")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}

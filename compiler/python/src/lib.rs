//! Asperity for Python.
//!
//! The package `asperity` is Python in `python/asperity/` and this module, `asperity._native`. The
//! module holds what needs the compiler or the runtime; records of plain values are Python. Doc
//! comments of Python items are their docstrings, so they follow NumPy's style.
//!
//! | file | holds |
//! |---|---|
//! | `author.rs` | `compile`, `Author`: prompts |
//! | `import.rs` | `import_hatt`, `import_model`, `builtin` |
//! | `texture.rs` | `Texture`, over `contents.rs` and `arrays.rs` |
//! | `library.rs`, `load.rs` | `Library`, `pack`, `load` |
//! | `renderer.rs` | `Renderer`, over `motion.rs`, `servo.rs` and `columns.rs` |
//! | `error.rs`, `records.rs` | exceptions and records that are Python |
//!
//! Long work releases the interpreter. A panic becomes a Python exception.

mod arguments;
mod arrays;
mod author;
mod columns;
mod contents;
mod error;
mod import;
mod library;
mod load;
mod motion;
mod output;
mod records;
mod renderer;
mod servo;
mod texture;

use pyo3::pymodule;

/// The native part of the package `asperity`.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::author::{Author, compile};
    #[pymodule_export]
    use crate::import::{builtin, import_hatt, import_model};
    #[pymodule_export]
    use crate::library::{Library, pack};
    #[pymodule_export]
    use crate::load::load;
    #[pymodule_export]
    use crate::output::Output;
    #[pymodule_export]
    use crate::renderer::Renderer;
    #[pymodule_export]
    use crate::texture::{Texture, plot};

    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "Python's name")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}

//! Helpers that need the compiler. The library of this package does without it, so that the
//! fuzzer builds only the runtime.

pub(crate) mod c;

use asperity::{
    driver::{self, Compiled},
    passes::reduce::Fidelity,
    pipeline::Request,
    sources::{Source, Tools, hatt::Hatt},
};
use std::path::Path;

/// Compiles a source; none that the tests use needs the learned model.
pub(crate) fn compiled(source: &dyn Source, request: &Request) -> Compiled {
    driver::compile(source, request, &Tools::default()).expect("a texture")
}

/// A HaTT material at a fidelity.
pub(crate) fn material(file: &Path, fidelity: Fidelity) -> Compiled {
    let request = Request {
        fidelity,
        ..Request::default()
    };
    compiled(&Hatt::new(file), &request)
}

/// The asset of a HaTT material in full.
pub(crate) fn hatt(file: &Path) -> Vec<u8> {
    material(file, Fidelity::Full).lowered.bytes
}

/// The bytes that `asperity builtin` writes.
pub(crate) fn builtin() -> Vec<u8> {
    asperity::emit::lower::lower(&asperity::sources::builtin::texture(), None)
        .expect("the built-in texture")
        .bytes
}

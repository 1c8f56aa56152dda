//! Helpers that need the compiler. The library of this package does without it, so that the
//! fuzzer builds only the runtime.

pub(crate) mod c;

/// The bytes that `asperity builtin` writes.
pub(crate) fn builtin() -> Vec<u8> {
    asperity::lower::lower(&asperity::builtin::texture(), None)
        .expect("the built-in texture")
        .bytes
}

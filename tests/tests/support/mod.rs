//! What needs the compiler, which the library of this package does without so that the
//! fuzzer builds the runtime alone.

/// The bytes that `asperity builtin` writes.
pub(crate) fn builtin() -> Vec<u8> {
    asperity::lower::lower(&asperity::builtin::texture(), None)
        .expect("the built-in texture")
        .bytes
}

//! The built-in texture as an asset.

/// The bytes that `asperity builtin` writes.
///
/// # Panics
/// If the built-in texture cannot be lowered.
#[must_use]
pub fn bytes() -> Vec<u8> {
    asperity::lower::lower(&asperity::builtin::texture(), None)
        .expect("the built-in texture")
        .bytes
}

//! The library that the firmware carries: the textures of the x86 benches, so that their
//! figures stand side by side.

use asperity_benches::texture::texture;
use asperity_formats::{
    Numerator,
    library::{encode_library, encoded_len},
};
use std::{fs, path::Path};

/// Writes the library, names ascending.
///
/// # Errors
/// When the file cannot be written.
pub(crate) fn write(path: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let textures = [
        ("order 20, ARMA", texture(20, Numerator::Lsf)),
        ("order 20, zero at Nyquist", texture(20, Numerator::Nyquist)),
        ("order 4, zero at Nyquist", texture(4, Numerator::Nyquist)),
    ];
    let named: Vec<_> = textures
        .iter()
        .map(|(name, bytes)| (*name, bytes.as_slice()))
        .collect();
    let mut bytes = vec![0; encoded_len(&named)];
    encode_library(&named, &mut bytes)?;
    fs::write(path, bytes)?;
    Ok(())
}

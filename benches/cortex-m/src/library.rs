//! The libraries that the session embeds: the textures of the x86 benches, so that the figures
//! can be compared, and those that the cost model is fitted to.

use asperity_benches::texture::{
    texture, texture_on, texture_with_contact, texture_with_direction, texture_with_law,
};
use asperity_formats::{
    Numerator,
    library::{encode_library, encoded_len},
};
use std::{fs, path::Path};

/// Writes `textures.aspl` and `costs.aspl` in a folder.
///
/// # Errors
/// When a file cannot be written.
pub(crate) fn write(folder: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let textures = [
        ("order 20, ARMA", texture(20, Numerator::Lsf)),
        ("order 20, zero at Nyquist", texture(20, Numerator::Nyquist)),
        ("order 4, zero at Nyquist", texture(4, Numerator::Nyquist)),
    ];
    encode(&textures, &folder.join("textures.aspl"))?;
    let costs = [
        ("10 nyquist", texture(10, Numerator::Nyquist)),
        ("10 nyquist, 12", texture_on(10, Numerator::Nyquist, 4, 3)),
        ("10 nyquist, 98", texture_on(10, Numerator::Nyquist, 8, 8)),
        (
            "10 nyquist, contact",
            texture_with_contact(10, Numerator::Nyquist),
        ),
        ("10 nyquist, law", texture_with_law(10, Numerator::Nyquist)),
        (
            "10 nyquist, ribs",
            texture_with_direction(10, Numerator::Nyquist),
        ),
        ("10+8", texture(10, Numerator::Lsf)),
        ("15+13", texture(15, Numerator::Lsf)),
        ("16 nyquist", texture(16, Numerator::Nyquist)),
        ("20 nyquist", texture(20, Numerator::Nyquist)),
        ("20+18", texture(20, Numerator::Lsf)),
        ("24 nyquist", texture(24, Numerator::Nyquist)),
        ("4 nyquist", texture(4, Numerator::Nyquist)),
        ("4+2", texture(4, Numerator::Lsf)),
        ("7 nyquist", texture(7, Numerator::Nyquist)),
        ("other", texture(4, Numerator::None)),
    ];
    encode(&costs, &folder.join("costs.aspl"))
}

/// Names ascending.
fn encode(textures: &[(&str, Vec<u8>)], path: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let named: Vec<_> = textures
        .iter()
        .map(|(name, bytes)| (*name, bytes.as_slice()))
        .collect();
    let mut bytes = vec![0; encoded_len(&named)];
    encode_library(&named, &mut bytes)?;
    fs::write(path, bytes)?;
    Ok(())
}

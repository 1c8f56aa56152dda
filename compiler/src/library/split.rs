//! A library becomes several smaller ones.

use super::loaded_library::LoadedLibrary;
use crate::emit::pack::{NamedAsset, encode};
use asperity_io::diagnostic::Fault;

/// Libraries of neighbouring textures, each as large as the others within one texture.
///
/// # Errors
/// [`Fault`] for an asset that does not parse.
pub fn split(library: &LoadedLibrary, count: usize) -> Result<Vec<Vec<u8>>, Fault> {
    let total = library.textures.len();
    (0..count)
        .map(|part| {
            let range = part * total / count..(part + 1) * total / count;
            let named: Vec<NamedAsset<'_>> = library.textures[range]
                .iter()
                .map(|(name, bytes)| NamedAsset { name, bytes })
                .collect();
            encode(&named)
        })
        .collect()
}

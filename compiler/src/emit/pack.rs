//! Packs many assets into one library.

use asperity_formats::{EncodeError, SceneSurface, library, scene};
use asperity_io::diagnostic::Fault;

/// An asset and its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NamedAsset<'a> {
    /// Name, unique in the library.
    pub name: &'a str,
    /// Bytes of the asset.
    pub bytes: &'a [u8],
}

/// Returns the fault of assets that do not make a library.
pub(crate) fn unwritable(error: EncodeError) -> Fault {
    let remedy = "give every texture a name of its own, and no more than the format counts";
    Fault::new(format!("the library cannot be written: {error}"), remedy)
}

/// Bytes of a library of these assets, sorted by name, whatever their order.
///
/// # Errors
/// [`Fault`] for two assets of one name, or an asset that does not parse.
pub fn encode(assets: &[NamedAsset<'_>]) -> Result<Vec<u8>, Fault> {
    let sorted = sorted(assets);
    let mut bytes = vec![0; library::encoded_len(&sorted)];
    let len = library::encode_library(&sorted, &mut bytes).map_err(unwritable)?;
    bytes.truncate(len);
    Ok(bytes)
}

/// Bytes of a library with a scene, whose textures are numbered in order of name.
///
/// # Errors
/// As [`encode`], and for a surface that the format refuses.
pub fn encode_scene(
    assets: &[NamedAsset<'_>],
    surfaces: &[SceneSurface],
) -> Result<Vec<u8>, Fault> {
    let sorted = sorted(assets);
    let len = library::encoded_len(&sorted) + scene::encoded_len(surfaces.len());
    let mut bytes = vec![0; len];
    library::encode_scene(&sorted, surfaces, &mut bytes).map_err(unwritable)?;
    Ok(bytes)
}

/// Number of bytes that a library with a scene takes besides its assets.
#[must_use]
pub fn scene_len(names: &[&str], surfaces: usize) -> usize {
    let empty: Vec<(&str, &[u8])> = names.iter().map(|name| (*name, &[][..])).collect();
    library::encoded_len(&empty) + scene::encoded_len(surfaces)
}

fn sorted<'a>(assets: &[NamedAsset<'a>]) -> Vec<(&'a str, &'a [u8])> {
    let mut sorted: Vec<(&str, &[u8])> = assets.iter().map(|a| (a.name, a.bytes)).collect();
    sorted.sort_by_key(|(name, _)| *name);
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{emit::lower::lower, sources::builtin};

    #[test]
    fn the_order_given_does_not_matter_and_a_name_counts_once() {
        let bytes = lower(&builtin::texture(), None).unwrap().bytes;
        let asset = |name| NamedAsset {
            name,
            bytes: &bytes,
        };
        let forth = encode(&[asset("a"), asset("b")]).unwrap();
        assert_eq!(forth, encode(&[asset("b"), asset("a")]).unwrap());
        assert!(encode(&[asset("a"), asset("a")]).is_err());
    }
}

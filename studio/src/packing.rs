//! A library of textures that the page chose.

use crate::{error::ApiError, http::Status, texture::Texture};
use asperity::{
    emit::{
        lower::LowerError,
        pack::{NamedAsset, encode},
        sections::renamed,
    },
    library::check_name,
};
use asperity_io::shown::size;
use std::{collections::HashSet, sync::Arc};

/// Bytes of a library that is packed.
const MOST_BYTES: usize = 256 << 20;

/// The bytes of a library of these textures, each with its name there.
///
/// # Errors
/// For no texture at all, names that no texture can have or that stand twice, and for more bytes than are packed.
pub(crate) fn pack(named: &[(String, Arc<Texture>)]) -> Result<Vec<u8>, ApiError> {
    let wrong = |error: String, help: &str| ApiError::new(Status::BadRequest, error, help);
    if named.is_empty() {
        return Err(wrong(
            "textures is empty".into(),
            "give at least one texture",
        ));
    }
    let bytes: usize = named.iter().map(|(_, texture)| texture.asset().len()).sum();
    if bytes > MOST_BYTES {
        let error = format!(
            "the textures have {} together, but a library that is packed here at most {}",
            size(bytes as u64),
            size(MOST_BYTES as u64)
        );
        let help = "pack fewer, or join libraries with `asperity merge`";
        return Err(ApiError::new(Status::TooLarge, error, help));
    }
    let mut taken = HashSet::new();
    let mut assets = Vec::with_capacity(named.len());
    for (at, (name, texture)) in named.iter().enumerate() {
        let field = |error: ApiError| ApiError {
            status: Status::BadRequest,
            error: format!("textures[{at}].name: {}", error.error),
            ..error
        };
        check_name(name).map_err(|e| field(ApiError::of(&e)))?;
        if !taken.insert(name) {
            let error = format!("textures[{at}].name: {name:?} stands twice");
            return Err(wrong(error, "give every texture a name of its own"));
        }
        let asset = renamed(texture.asset(), name);
        assets.push(asset.map_err(|e| ApiError::of(&LowerError::from(e)))?);
    }
    let assets: Vec<NamedAsset<'_>> = named
        .iter()
        .zip(&assets)
        .map(|((name, _), bytes)| NamedAsset { name, bytes })
        .collect();
    encode(&assets).map_err(|e| ApiError::of(&e))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn textures_of_256_mib_are_packed_and_not_a_byte_more() {
        let bytes = |count: usize| Arc::new(Texture::of_bytes("", &vec![0; count].into()));
        let (large, byte) = (bytes(64 << 20), bytes(1));
        // Without a name, none is packed in the end.
        let mut named = vec![(String::new(), large); 4];
        let refused = pack(&named).unwrap_err();
        assert!(refused.error.starts_with("textures[0].name"), "{refused:?}");
        named.push((String::new(), byte));
        let refused = pack(&named).unwrap_err();
        assert_eq!(refused.status, Status::TooLarge, "{refused:?}");
        assert!(refused.error.contains("at most 268.4 MB"), "{refused:?}");
    }
}

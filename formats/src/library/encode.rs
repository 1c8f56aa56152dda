//! Writing a library.

use super::{
    index::LibraryIndex,
    layout::{ENTRY_LEN, HEADER_LEN, MAGIC, VERSION_WITH_SCENE},
    memory::Library,
};
use crate::{
    asset::Asset,
    checksum::crc32,
    error::{EncodeError, FormatError},
    limits,
    scene::{self, SceneSurface},
    wire::Writer,
};

/// A texture as an index lists it, before its asset is at hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IndexedTexture<'a> {
    /// Its name.
    pub name: &'a str,
    /// Bytes of its asset.
    pub len: u32,
    /// Bytes of it that a runtime needs.
    pub haptic_len: u32,
}

/// Bytes of the index of these textures: header, entries and names.
#[must_use]
pub fn encoded_index_len(textures: &[IndexedTexture<'_>]) -> usize {
    textures.iter().fold(HEADER_LEN, |sum, texture| {
        sum + ENTRY_LEN + texture.name.len()
    })
}

/// Writes the front of a library without a scene, sorted by name; the assets follow in this order.
/// So a library that no memory holds can be written. Returns the bytes of the index and of the
/// library.
///
/// # Errors
/// A small buffer, names that do not ascend, lengths that cannot be.
pub fn encode_index(
    textures: &[IndexedTexture<'_>],
    out: &mut [u8],
) -> Result<(usize, u64), EncodeError> {
    let index_len = encoded_index_len(textures);
    let assets: u64 = textures.iter().map(|texture| u64::from(texture.len)).sum();
    let total_len = index_len as u64 + assets;
    let all = textures.iter().map(|texture| Ok(*texture));
    write_index(all, 1, index_len, total_len, out)?;
    LibraryIndex::parse(out.get(..index_len).unwrap_or_default())?;
    Ok((index_len, total_len))
}

/// Bytes of a library of these named assets.
#[must_use]
pub fn encoded_len(textures: &[(&str, &[u8])]) -> usize {
    textures.iter().fold(HEADER_LEN, |sum, (name, bytes)| {
        sum + ENTRY_LEN + name.len() + bytes.len()
    })
}

/// Writes a library of named assets, sorted by name, into `out`.
///
/// The names of the index are those given here; each asset is checked.
///
/// # Errors
/// A small buffer, an asset that does not parse, names that do not ascend.
pub fn encode_library(textures: &[(&str, &[u8])], out: &mut [u8]) -> Result<usize, EncodeError> {
    encode(textures, &[], out)
}

/// Writes a library with a scene: as [`encode_library`], with at least one surface. Takes
/// [`encoded_len`] and [`scene::encoded_len`] bytes.
///
/// # Errors
/// As [`encode_library`], and a surface that a reader would refuse.
pub fn encode_scene(
    textures: &[(&str, &[u8])],
    surfaces: &[SceneSurface],
    out: &mut [u8],
) -> Result<usize, EncodeError> {
    if !(1..=limits::MAX_SURFACES).contains(&surfaces.len()) {
        return Err(FormatError::invalid(
            "scene.count",
            0,
            surfaces.len() as f64,
            "1 to 64 surfaces",
        )
        .into());
    }
    encode(textures, surfaces, out)
}

fn encode(
    textures: &[(&str, &[u8])],
    surfaces: &[SceneSurface],
    out: &mut [u8],
) -> Result<usize, EncodeError> {
    let index_len = textures
        .iter()
        .fold(HEADER_LEN, |sum, (name, _)| sum + ENTRY_LEN + name.len());
    let assets_end = encoded_len(textures);
    let (version, total_len) = if surfaces.is_empty() {
        (1, assets_end)
    } else {
        let scene_len = scene::encoded_len(surfaces.len());
        (VERSION_WITH_SCENE, assets_end + scene_len)
    };
    let listed = textures.iter().map(|(name, bytes)| {
        Ok(IndexedTexture {
            name,
            len: bytes.len() as u32,
            haptic_len: Asset::parse(bytes)?.haptic_len() as u32,
        })
    });
    write_index(listed, version, index_len, total_len as u64, out)?;
    let mut writer = Writer::new(out, index_len);
    for (_, bytes) in textures {
        writer.bytes(bytes)?;
    }
    if !surfaces.is_empty() {
        let place = out.get_mut(assets_end..).unwrap_or_default();
        scene::encode(surfaces, textures.len(), place)?;
    }
    Library::parse(out.get(..total_len).unwrap_or_default())?;
    Ok(total_len)
}

/// Header, entries and names.
fn write_index<'a>(
    textures: impl ExactSizeIterator<Item = Result<IndexedTexture<'a>, EncodeError>>,
    version: u16,
    index_len: usize,
    total_len: u64,
    out: &mut [u8],
) -> Result<(), EncodeError> {
    let count = textures.len();
    let names_at = HEADER_LEN + count * ENTRY_LEN;
    let mut writer = Writer::new(out, 0);
    writer.bytes(&MAGIC)?;
    writer.u16(version)?;
    writer.u16(0)?;
    writer.u32(count as u32)?;
    writer.u32(index_len as u32)?;
    writer.u64(total_len)?;
    writer.u32(0)?;
    let (mut offset, mut name_offset) = (index_len as u64, 0_u32);
    for (index, texture) in textures.enumerate() {
        let texture = texture?;
        let mut writer = Writer::new(out, HEADER_LEN + index * ENTRY_LEN);
        writer.u64(offset)?;
        writer.u32(texture.len)?;
        writer.u32(texture.haptic_len)?;
        writer.u32(name_offset)?;
        writer.u16(texture.name.len() as u16)?;
        writer.u16(0)?;
        let name = texture.name.as_bytes();
        Writer::new(out, names_at + name_offset as usize).bytes(name)?;
        offset += u64::from(texture.len);
        name_offset += texture.name.len() as u32;
    }
    let crc = crc32(&[
        out.get(..24).unwrap_or_default(),
        out.get(HEADER_LEN..index_len).unwrap_or_default(),
    ]);
    Writer::new(out, 24).u32(crc)?;
    Ok(())
}

//! Writing a library.

use super::{
    layout::{ENTRY_LEN, HEADER_LEN, MAGIC, VERSION_WITH_SCENE},
    memory::Library,
};
use crate::{
    Asset, EncodeError, FormatError,
    checksum::crc32,
    limits,
    scene::{self, SceneSurface},
    wire::Writer,
};

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
    let mut writer = Writer::new(out, 0);
    writer.bytes(&MAGIC)?;
    writer.u16(version)?;
    writer.u16(0)?;
    writer.u32(textures.len() as u32)?;
    writer.u32(index_len as u32)?;
    writer.u64(total_len as u64)?;
    writer.u32(0)?;
    let (mut offset, mut name_offset) = (index_len as u64, 0_u32);
    for (name, bytes) in textures {
        writer.u64(offset)?;
        writer.u32(bytes.len() as u32)?;
        writer.u32(Asset::parse(bytes)?.haptic_len() as u32)?;
        writer.u32(name_offset)?;
        writer.u16(name.len() as u16)?;
        writer.u16(0)?;
        offset += bytes.len() as u64;
        name_offset += name.len() as u32;
    }
    for (name, _) in textures {
        writer.bytes(name.as_bytes())?;
    }
    for (_, bytes) in textures {
        writer.bytes(bytes)?;
    }
    if !surfaces.is_empty() {
        let place = out.get_mut(assets_end..).unwrap_or_default();
        scene::encode(surfaces, textures.len(), place)?;
    }
    let crc = crc32(&[
        out.get(..24).unwrap_or_default(),
        out.get(HEADER_LEN..index_len).unwrap_or_default(),
    ]);
    Writer::new(out, 24).u32(crc)?;
    Library::parse(out.get(..total_len).unwrap_or_default())?;
    Ok(total_len)
}

//! An asset of given sections: what changes some sections of another asset and keeps the rest.

use crate::{
    asset::Asset,
    checksum::crc32,
    error::EncodeError,
    friction::Friction,
    header::{
        ENTRY_LEN, FIXED_LEN, FRICTION, HAPTIC, MAGIC, VERSION_WITH_OPTIONAL, VERSION_WITHOUT_LAW,
        count_haptic,
    },
    wire::Writer,
};

/// Bytes of an asset of these sections.
#[must_use]
pub fn assembled_len(sections: &[([u8; 4], &[u8])]) -> usize {
    sections
        .iter()
        .fold(FIXED_LEN, |sum, (_, body)| sum + ENTRY_LEN + body.len())
}

/// Writes an asset of these sections into `out`, which needs [`assembled_len`] bytes. The haptic
/// sections come first, in the order of the format; the ancillary ones follow in any order.
///
/// Sections that are taken from another asset keep their bytes, so the haptic part of both
/// assets is the same.
///
/// # Errors
/// [`EncodeError`] for a small buffer, and for sections that a reader would reject.
pub fn assemble(sections: &[([u8; 4], &[u8])], out: &mut [u8]) -> Result<usize, EncodeError> {
    let count = u8::try_from(sections.len()).map_err(|_| EncodeError::Count {
        field: "sections",
        index: 0,
        found: sections.len(),
        expected: crate::limits::MAX_SECTIONS,
    })?;
    let total_len = assembled_len(sections);
    let table_end = FIXED_LEN + sections.len() * ENTRY_LEN;
    let haptic = count_haptic(sections.iter().map(|(tag, _)| *tag));
    let haptic_len = sections
        .iter()
        .take(haptic)
        .fold(table_end, |sum, (_, body)| sum + body.len());
    let mut writer = Writer::new(out, 0);
    writer.bytes(&MAGIC)?;
    let friction = sections.iter().find(|(tag, _)| *tag == FRICTION);
    writer.u16(if haptic > HAPTIC.len() {
        VERSION_WITH_OPTIONAL
    } else {
        friction.map_or(VERSION_WITHOUT_LAW, |(_, body)| Friction::version_of(body))
    })?;
    writer.u8(count)?;
    writer.u8(0)?;
    writer.u32(total_len as u32)?;
    writer.u32(haptic_len as u32)?;
    writer.u32(0)?;
    for (tag, body) in sections {
        writer.bytes(tag)?;
        writer.u32(body.len() as u32)?;
        writer.u32(crc32(&[body]))?;
    }
    for (_, body) in sections {
        writer.bytes(body)?;
    }
    let crc = crc32(&[
        out.get(..16).unwrap_or_default(),
        out.get(FIXED_LEN..table_end).unwrap_or_default(),
    ]);
    Writer::new(out, 16).u32(crc)?;
    Asset::parse(out.get(..total_len).unwrap_or_default())?;
    Ok(total_len)
}

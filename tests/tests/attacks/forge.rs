//! Damage with right checksums, so that the checks behind them are reached.

use asperity_formats::Asset;
use asperity_tests::damage::seal;

const ENTRY_LEN: usize = 24;
const HEADER_LEN: usize = 28;

fn u32_at(bytes: &[u8], at: usize) -> usize {
    bytes.get(at..at + 4).map_or(0, |four| {
        u32::from_le_bytes([four[0], four[1], four[2], four[3]]) as usize
    })
}

/// CRC-32 as `formats/SPEC.md` defines it, by a table.
pub(crate) fn crc32(parts: &[&[u8]]) -> u32 {
    let table: Vec<u32> = (0..256_u32)
        .map(|byte| (0..8).fold(byte, |crc, _| (crc >> 1) ^ (0xedb8_8320 * (crc & 1))))
        .collect();
    let bytes = parts.iter().flat_map(|part| part.iter());
    !bytes.fold(!0_u32, |crc, &byte| {
        (crc >> 8) ^ table[((crc ^ u32::from(byte)) & 0xff) as usize]
    })
}

/// Recomputes the checksums of an asset, a library, those of its assets and its scene included, or
/// a recorded session.
pub(crate) fn sealed(mut bytes: Vec<u8>) -> Vec<u8> {
    if bytes.starts_with(b"ASPT") {
        seal(&mut bytes);
    } else if bytes.starts_with(b"ASPL") && bytes.len() >= HEADER_LEN {
        seal_library(&mut bytes);
    } else if bytes.starts_with(b"ASPR") {
        seal_session(&mut bytes);
    }
    bytes
}

/// Every block of a recorded session that is whole: kind, length, body, checksum.
fn seal_session(bytes: &mut [u8]) {
    let mut at = 8;
    while at + 5 < bytes.len() {
        let end = at + 5 + u32_at(bytes, at + 1);
        if end + 4 > bytes.len() {
            break;
        }
        let crc = crc32(&[&bytes[at..end]]);
        bytes[end..end + 4].copy_from_slice(&crc.to_le_bytes());
        at = end + 4;
    }
}

fn seal_library(bytes: &mut [u8]) {
    let count = u32_at(bytes, 8).min(16);
    let mut end = u32_at(bytes, 12);
    for index in 0..count {
        let entry = HEADER_LEN + index * ENTRY_LEN;
        let start = u32_at(bytes, entry);
        end = start.saturating_add(u32_at(bytes, entry + 8));
        if let Some(asset) = bytes.get_mut(start..end) {
            seal(asset);
        }
    }
    if bytes
        .get(end..)
        .is_some_and(|scene| scene.starts_with(b"SCEN") && scene.len() >= 12)
    {
        let crc = crc32(&[&bytes[end + 12..]]);
        bytes[end + 8..end + 12].copy_from_slice(&crc.to_le_bytes());
    }
    let index_end = u32_at(bytes, 12);
    if let Some(rest) = bytes.get(HEADER_LEN..index_end) {
        let crc = crc32(&[&bytes[..24], rest]);
        bytes[24..28].copy_from_slice(&crc.to_le_bytes());
    }
}

/// The head of a recorded session, then blocks of ticks that hold nothing, two bytes each.
pub(crate) fn session_of(session: &[u8], blocks: usize, ticks: usize) -> Vec<u8> {
    let mut bytes = session[..8 + 5 + u32_at(session, 9) + 4].to_vec();
    let mut body = Vec::new();
    let mut rest = ticks;
    while rest >= 128 {
        body.push((rest % 128) as u8 | 128);
        rest /= 128;
    }
    body.push(rest as u8);
    body.resize(body.len() + 2 * ticks, 0);
    let mut block = vec![1];
    block.extend((body.len() as u32).to_le_bytes());
    block.extend(body);
    block.extend(crc32(&[&block]).to_le_bytes());
    bytes.extend(block.repeat(blocks));
    bytes
}

/// A library that states `count` textures, of which the first is `asset` and the others are empty,
/// and a scene of one surface. Its checksums are right.
pub(crate) fn library_of(count: u32, asset: &[u8]) -> Vec<u8> {
    let names: Vec<u8> = (0..count)
        .flat_map(|n| format!("{n:07x}").into_bytes())
        .collect();
    let index_len = HEADER_LEN + count as usize * ENTRY_LEN + names.len();
    let haptic_len = Asset::parse(asset).expect("a valid asset").haptic_len();
    let mut entries = Vec::with_capacity(count as usize * ENTRY_LEN);
    let mut offset = index_len as u64;
    for n in 0..count {
        let (len, haptic_len) = match n {
            0 => (asset.len() as u32, haptic_len as u32),
            _ => (0, 0),
        };
        entries.extend(offset.to_le_bytes());
        entries.extend(len.to_le_bytes());
        entries.extend(haptic_len.to_le_bytes());
        entries.extend((7 * n).to_le_bytes());
        entries.extend([7, 0, 0, 0]);
        offset += u64::from(len);
    }
    let mut content = vec![1, 0, 0, 0];
    content.extend([0; 4]);
    for value in [
        0.0, 0.0, 0.0, 0.0, 0.0, 1.0, -1.0, -1.0, -1.0, 1.0, 1.0, 1.0_f32,
    ] {
        content.extend(value.to_le_bytes());
    }
    let mut scene = b"SCEN".to_vec();
    scene.extend((content.len() as u32).to_le_bytes());
    scene.extend(crc32(&[&content]).to_le_bytes());
    scene.extend(&content);
    let mut bytes = b"ASPL".to_vec();
    bytes.extend([2, 0, 0, 0]);
    bytes.extend(count.to_le_bytes());
    bytes.extend((index_len as u32).to_le_bytes());
    bytes.extend((offset + scene.len() as u64).to_le_bytes());
    let crc = crc32(&[&bytes, &entries, &names]);
    bytes.extend(crc.to_le_bytes());
    for part in [&entries[..], &names, asset, &scene] {
        bytes.extend(part);
    }
    bytes
}

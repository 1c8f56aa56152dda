//! Recomputes the checksums of a damaged asset, so that the checks behind them are reached.

/// CRC-32 bit by bit, as `formats/SPEC.md` defines it.
fn crc32(bytes: impl IntoIterator<Item = u8>) -> u32 {
    !bytes.into_iter().fold(!0_u32, |crc, byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 * (crc & 1))
        })
    })
}

fn u32_at(bytes: &[u8], at: usize) -> usize {
    bytes.get(at..at + 4).map_or(0, |four| {
        u32::from_le_bytes([four[0], four[1], four[2], four[3]]) as usize
    })
}

/// Recomputes every CRC of an asset. Does nothing if the section table is incomplete.
pub fn seal(asset: &mut [u8]) {
    let table_end = 20 + 12 * usize::from(asset.get(6).copied().unwrap_or(0));
    if asset.len() < table_end {
        return;
    }
    let mut start = table_end;
    for entry in (20..table_end).step_by(12) {
        let end = start.saturating_add(u32_at(asset, entry + 4));
        if let Some(body) = asset.get(start..end) {
            let crc = crc32(body.iter().copied());
            asset[entry + 8..entry + 12].copy_from_slice(&crc.to_le_bytes());
        }
        start = end;
    }
    let crc = crc32(asset[..16].iter().chain(&asset[20..table_end]).copied());
    asset[16..20].copy_from_slice(&crc.to_le_bytes());
}

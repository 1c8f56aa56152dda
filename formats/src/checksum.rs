//! CRC-32 (ISO-HDLC, the one of zlib and PNG): finds every single-bit flip and
//! every burst of up to 32 bits.

use crc::{CRC_32_ISO_HDLC, Crc, Table};

/// Tables of 1 KiB: with sixteen, a byte costs a quarter; a microcontroller's flash is dearer.
const TABLES: usize = if cfg!(target_pointer_width = "64") {
    16
} else {
    1
};
static CRC32: Crc<u32, Table<TABLES>> = Crc::<u32, Table<TABLES>>::new(&CRC_32_ISO_HDLC);

/// CRC-32 of the pieces, one after the other.
pub(crate) fn crc32(pieces: &[&[u8]]) -> u32 {
    let mut digest = CRC32.digest();
    for piece in pieces {
        digest.update(piece);
    }
    digest.finalize()
}

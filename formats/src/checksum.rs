//! CRC-32 (ISO-HDLC, the one of zlib and PNG): finds every single-bit flip and
//! every burst of up to 32 bits.

use crc::{CRC_32_ISO_HDLC, Crc, Table};

const CRC32: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);

/// CRC-32 of the pieces, one after the other.
pub(crate) fn crc32(pieces: &[&[u8]]) -> u32 {
    let mut digest = CRC32.digest();
    for piece in pieces {
        digest.update(piece);
    }
    digest.finalize()
}

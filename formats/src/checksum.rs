//! CRC-32 (ISO-HDLC, the one of zlib and PNG): finds every single-bit flip and
//! every burst of up to 32 bits.

/// CRC-32 of the pieces, one after the other.
#[cfg(target_pointer_width = "64")]
pub(crate) fn crc32(pieces: &[&[u8]]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    for piece in pieces {
        hasher.update(piece);
    }
    hasher.finalize()
}

/// The same CRC with one table of 1 KiB, because flash on a microcontroller costs more than time at
/// load.
#[cfg(not(target_pointer_width = "64"))]
pub(crate) fn crc32(pieces: &[&[u8]]) -> u32 {
    use crc::{CRC_32_ISO_HDLC, Crc, Table};
    static CRC32: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);
    let mut digest = CRC32.digest();
    for piece in pieces {
        digest.update(piece);
    }
    digest.finalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The check value of the catalogue of parametrised CRCs, in one piece and in two.
    #[test]
    fn the_check_value_is_that_of_the_catalogue() {
        assert_eq!(crc32(&[b"123456789"]), 0xcbf4_3926);
        assert_eq!(crc32(&[b"1234", b"56789"]), 0xcbf4_3926);
        assert_eq!(crc32(&[]), 0);
    }
}

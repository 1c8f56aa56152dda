//! Magic, versions and sizes of the header.

/// Latest version of the library format; without a scene, a library is written in version 1.
pub const VERSION: u16 = 2;
pub(super) const VERSION_WITH_SCENE: u16 = 2;
/// Bytes to read first, enough for [`index_len`](super::index_len).
pub const HEADER_LEN: usize = 28;
pub(super) const MAGIC: [u8; 4] = *b"ASPL";
pub(super) const ENTRY_LEN: usize = 24;

//! The library: many assets behind an index, sorted by name.
//!
//! One texture is read by index or name without touching the others. The index
//! can be read alone ([`LibraryIndex`]) from the front of a file; a whole library
//! in memory, mapped or in flash is a [`Library`]. Behind the assets of version 2 lies a
//! [`Scene`](crate::Scene).

mod encode;
mod index;
mod layout;
mod memory;

pub use self::{
    encode::{
        IndexedTexture, encode_index, encode_library, encode_scene, encoded_index_len, encoded_len,
    },
    index::{Entry, LibraryIndex, index_len},
    layout::{HEADER_LEN, VERSION},
    memory::Library,
};

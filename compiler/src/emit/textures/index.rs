//! A library's index in memory: parsed once, when the library is opened.

use asperity_formats::{
    FormatError,
    library::{Entry, LibraryIndex},
};
use std::ops::Range;

/// Where the textures of a library lie.
#[derive(Debug)]
pub(super) struct Index {
    pub(super) version: u16,
    /// Bytes of the whole library, as stated.
    pub(super) total_len: u64,
    /// Where the scene lies, if there is one.
    pub(super) scene: Option<Range<u64>>,
    /// In ascending order of name.
    locations: Vec<TextureLocation>,
}

/// Where one texture lies.
#[derive(Debug, Clone)]
pub(super) struct TextureLocation {
    pub(super) name: String,
    pub(super) offset: u64,
    pub(super) len: u64,
    haptic_len: u32,
}

impl TextureLocation {
    /// Checks what the index states of an asset.
    ///
    /// # Errors
    /// As [`Entry::check`].
    pub(super) fn check(&self, index: usize, asset: &[u8]) -> Result<(), FormatError> {
        let entry = Entry {
            name: &self.name,
            offset: self.offset,
            len: self.len as u32,
            haptic_len: self.haptic_len,
        };
        entry.check(index, asset)
    }
}

impl Index {
    /// The index at the front of a library.
    ///
    /// # Errors
    /// The first check that fails.
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, FormatError> {
        let parsed = LibraryIndex::parse(bytes)?;
        #[cfg(test)]
        ENTRIES_READ.with(|read| read.set(read.get() + parsed.len()));
        let location = |entry: Entry<'_>| TextureLocation {
            name: entry.name.to_owned(),
            offset: entry.offset,
            len: u64::from(entry.len),
            haptic_len: entry.haptic_len,
        };
        Ok(Self {
            version: parsed.version(),
            total_len: parsed.total_len(),
            scene: parsed.scene_range(),
            locations: parsed.entries().map(location).collect(),
        })
    }

    /// Number of textures.
    pub(super) fn len(&self) -> usize {
        self.locations.len()
    }

    /// The texture at an index.
    pub(super) fn get(&self, index: usize) -> Option<&TextureLocation> {
        self.locations.get(index)
    }

    /// Neighbouring textures, of which there are so many.
    pub(super) fn locations(&self, range: Range<usize>) -> &[TextureLocation] {
        self.locations.get(range).unwrap_or_default()
    }

    /// The index of a name; a binary search.
    pub(super) fn find(&self, name: &str) -> Option<usize> {
        let by_name = |location: &TextureLocation| location.name.as_str().cmp(name);
        self.locations.binary_search_by(by_name).ok()
    }

    /// The names in order.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.locations.iter().map(|location| location.name.as_str())
    }
}

#[cfg(test)]
thread_local! {
    /// Entries that this thread has read out of indices: what the work of a command is counted in.
    pub(crate) static ENTRIES_READ: std::cell::Cell<usize> = const { std::cell::Cell::new(0) };
}

//! A whole library in memory, mapped or in flash.

use super::index::{Entry, LibraryIndex};
use crate::{asset::Asset, error::FormatError, scene::Scene};
use core::{cmp::Ordering, ops::Range};

/// A whole library in memory.
#[derive(Debug, Clone, Copy)]
pub struct Library<'a> {
    bytes: &'a [u8],
    index: LibraryIndex<'a>,
    scene: Option<Scene<'a>>,
}

impl<'a> Library<'a> {
    /// Checks the index, the total length and the scene; assets are checked when asked for.
    ///
    /// # Errors
    /// The first check that fails.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, FormatError> {
        let index = LibraryIndex::parse(bytes)?;
        let (stated, found) = (index.total_len(), bytes.len() as u64);
        match found.cmp(&stated) {
            Ordering::Less => Err(FormatError::TooShort {
                field: "library",
                needed: stated,
                found,
            }),
            Ordering::Greater => Err(FormatError::TooLong {
                field: "library",
                stated,
                found,
            }),
            Ordering::Equal => {
                let section = index.scene_range().and_then(|range| {
                    // Within a length that was found in memory.
                    bytes.get(range.start as usize..range.end as usize)
                });
                let scene = section
                    .map(|section| Scene::parse(section, index.len()))
                    .transpose()?;
                Ok(Self {
                    bytes,
                    index,
                    scene,
                })
            }
        }
    }

    /// The scene, if there is one.
    #[must_use]
    pub const fn scene(&self) -> Option<&Scene<'a>> {
        self.scene.as_ref()
    }

    /// The index.
    #[must_use]
    pub const fn index(&self) -> &LibraryIndex<'a> {
        &self.index
    }

    /// Bytes of the asset at `index`. That its haptic length is the one of the index is all that is checked.
    ///
    /// # Errors
    /// [`FormatError::NoSuchTexture`], or the haptic length.
    pub fn bytes(&self, index: usize) -> Result<&'a [u8], FormatError> {
        let entry = self.index.get(index);
        let bytes = entry.and_then(|entry| self.bytes.get(range(&entry)?));
        let (Some(entry), Some(bytes)) = (entry, bytes) else {
            return Err(FormatError::NoSuchTexture {
                index,
                count: self.index.len(),
            });
        };
        entry.check(index, bytes)?;
        Ok(bytes)
    }

    /// The checked asset at `index`.
    ///
    /// # Errors
    /// [`FormatError::NoSuchTexture`], or why the asset was rejected.
    pub fn asset(&self, index: usize) -> Result<Asset<'a>, FormatError> {
        Asset::parse(self.bytes(index)?)
    }
}

fn range(entry: &Entry<'_>) -> Option<Range<usize>> {
    let start = usize::try_from(entry.offset).ok()?;
    Some(start..start.checked_add(entry.len as usize)?)
}

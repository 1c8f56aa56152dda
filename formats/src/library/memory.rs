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

    /// Bytes of the asset at `index`, unchecked.
    ///
    /// # Errors
    /// [`FormatError::NoSuchTexture`].
    pub fn bytes(&self, index: usize) -> Result<&'a [u8], FormatError> {
        self.index
            .get(index)
            .and_then(|entry| self.bytes.get(range(&entry)?))
            .ok_or(FormatError::NoSuchTexture {
                index,
                count: self.index.len(),
            })
    }

    /// The checked asset at `index`.
    ///
    /// # Errors
    /// [`FormatError::NoSuchTexture`], or why the asset was rejected.
    pub fn asset(&self, index: usize) -> Result<Asset<'a>, FormatError> {
        let mut asset = Asset::parse(self.bytes(index)?);
        let stated = self.index.get(index).map_or(0, |entry| entry.haptic_len);
        // In place: an asset that is moved takes its room twice.
        if (asset.as_ref()).is_ok_and(|asset| asset.haptic_len() != stated as usize) {
            asset = Err(FormatError::invalid(
                "library.entry.haptic_len",
                index,
                f64::from(stated),
                "must be the asset's own",
            ));
        }
        asset
    }
}

fn range(entry: &Entry<'_>) -> Option<Range<usize>> {
    let start = usize::try_from(entry.offset).ok()?;
    Some(start..start.checked_add(entry.len as usize)?)
}

//! The index: where each texture of a library lies.

use super::layout::{ENTRY_LEN, HEADER_LEN, MAGIC, VERSION, VERSION_WITH_SCENE};
use crate::{
    checksum::crc32, error::FormatError, friction::text, header::Header, limits, scene,
    wire::array_at,
};
use core::{cmp::Ordering, ops::Range};

/// A validated index, borrowed from the front of a library.
#[derive(Debug, Clone, Copy)]
pub struct LibraryIndex<'a> {
    entries: &'a [u8],
    names: &'a [u8],
    total_len: u64,
    version: u16,
    /// Where the assets end.
    assets_end: u64,
}

/// Where one texture lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Entry<'a> {
    /// Its name, unique in the library.
    pub name: &'a str,
    /// First byte of its asset in the library.
    pub offset: u64,
    /// Bytes of the asset.
    pub len: u32,
    /// Bytes of it that a runtime needs.
    pub haptic_len: u32,
}

impl Entry<'_> {
    /// Compares the haptic length with that of the asset, which the index alone cannot show. `index` names the entry
    /// in the error. An asset whose own header is damaged passes: whoever parses it finds that.
    ///
    /// # Errors
    /// [`FormatError::Invalid`] of `library.entry.haptic_len`.
    pub fn check(&self, index: usize, asset: &[u8]) -> Result<(), FormatError> {
        match Header::parse(asset) {
            Ok(header) if header.haptic_len != self.haptic_len as usize => {
                Err(FormatError::invalid(
                    "library.entry.haptic_len",
                    index,
                    f64::from(self.haptic_len),
                    "must be the asset's own",
                ))
            }
            _ => Ok(()),
        }
    }
}

/// Length of header, entries and names, from the first [`HEADER_LEN`] bytes.
///
/// # Errors
/// Too short, wrong magic, unknown version, or a length that cannot be.
pub fn index_len(header: &[u8]) -> Result<usize, FormatError> {
    if header.len() < HEADER_LEN {
        return Err(FormatError::TooShort {
            field: "library header",
            needed: HEADER_LEN as u64,
            found: header.len() as u64,
        });
    }
    let found: [u8; 4] = array_at(header, 0);
    if found != MAGIC {
        return Err(FormatError::Magic {
            found,
            expected: MAGIC,
        });
    }
    let version = u16::from_le_bytes(array_at(header, 4));
    if version == 0 || version > VERSION {
        return Err(FormatError::Version {
            found: version,
            supported: VERSION,
        });
    }
    let count = u32::from_le_bytes(array_at(header, 8)) as usize;
    if count > limits::MAX_TEXTURES {
        return Err(FormatError::invalid(
            "library.count",
            0,
            count as f64,
            "at most 1048576 textures",
        ));
    }
    let len = u32::from_le_bytes(array_at(header, 12)) as usize;
    let least = HEADER_LEN + count * (ENTRY_LEN + 1);
    let most = HEADER_LEN + count * (ENTRY_LEN + limits::MAX_NAME_BYTES);
    if (least..=most).contains(&len) {
        Ok(len)
    } else {
        Err(FormatError::invalid(
            "library.index_len",
            0,
            len as f64,
            "does not fit the count of textures",
        ))
    }
}

impl<'a> LibraryIndex<'a> {
    /// Checks the index at the front of `bytes`: length, magic, version, CRC, then
    /// every entry. Bytes behind the index are not looked at.
    ///
    /// # Errors
    /// The first check that fails.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, FormatError> {
        let len = index_len(bytes)?;
        let Some(index) = bytes.get(..len) else {
            return Err(FormatError::TooShort {
                field: "library index",
                needed: len as u64,
                found: bytes.len() as u64,
            });
        };
        let (head, rest) = index.split_at(HEADER_LEN);
        let stated = u32::from_le_bytes(array_at(head, 24));
        let computed = crc32(&[head.get(..24).unwrap_or_default(), rest]);
        if stated != computed {
            return Err(FormatError::Checksum {
                section: "library index",
                stated,
                computed,
            });
        }
        let flags = u16::from_le_bytes(array_at(head, 6));
        if flags != 0 {
            return Err(FormatError::invalid(
                "library.flags",
                0,
                f64::from(flags),
                "must be 0",
            ));
        }
        let count = u32::from_le_bytes(array_at(head, 8)) as usize;
        let (entries, names) = rest.split_at(count * ENTRY_LEN);
        let mut index = Self {
            entries,
            names,
            total_len: u64::from_le_bytes(array_at(head, 16)),
            version: u16::from_le_bytes(array_at(head, 4)),
            assets_end: 0,
        };
        index.assets_end = index.check(len as u64)?;
        Ok(index)
    }

    /// Assets lie one after the other; names lie one after the other and ascend. Returns
    /// where the assets end.
    fn check(&self, index_len: u64) -> Result<u64, FormatError> {
        let (mut offset, mut name_end, mut previous) = (index_len, 0, "");
        for (index, record) in self.entries.chunks_exact(ENTRY_LEN).enumerate() {
            let raw = RawEntry::read(record);
            if raw.reserved != 0 {
                return Err(FormatError::invalid(
                    "library.entry.reserved",
                    index,
                    f64::from(raw.reserved),
                    "must be 0",
                ));
            }
            if raw.name_offset != name_end {
                return Err(FormatError::invalid(
                    "library.entry.name_offset",
                    index,
                    f64::from(raw.name_offset),
                    "names must follow each other",
                ));
            }
            name_end += u32::from(raw.name_len);
            let name = text("library.entry.name", index, self.name_bytes(&raw))?;
            if index > 0 && name <= previous {
                return Err(FormatError::Text {
                    field: "library.entry.name",
                    index: index as u32,
                    reason: "names must ascend and differ",
                });
            }
            previous = name;
            if raw.offset != offset {
                return Err(FormatError::invalid(
                    "library.entry.offset",
                    index,
                    raw.offset as f64,
                    "assets must follow each other",
                ));
            }
            offset += u64::from(raw.len);
            if raw.haptic_len > raw.len {
                return Err(FormatError::invalid(
                    "library.entry.haptic_len",
                    index,
                    f64::from(raw.haptic_len),
                    "at most the length of the asset",
                ));
            }
        }
        if name_end as usize != self.names.len() {
            return Err(FormatError::invalid(
                "library.index_len",
                0,
                self.names.len() as f64,
                "must end with the last name",
            ));
        }
        let (fits, rule) = if self.version < VERSION_WITH_SCENE {
            let rule = "must be the sum of index and assets";
            (offset == self.total_len, rule)
        } else {
            let lengths = [1, limits::MAX_SURFACES].map(|n| scene::encoded_len(n) as u64);
            let rest = self.total_len.checked_sub(offset);
            let fits = rest.is_some_and(|rest| (lengths[0]..=lengths[1]).contains(&rest));
            (fits, "must be the sum of index, assets and scene")
        };
        if fits {
            Ok(offset)
        } else {
            Err(FormatError::invalid(
                "library.total_len",
                0,
                self.total_len as f64,
                rule,
            ))
        }
    }

    /// Version of the format that the library was written in.
    #[must_use]
    pub const fn version(&self) -> u16 {
        self.version
    }

    /// Where the scene lies, if there is one.
    #[must_use]
    pub fn scene_range(&self) -> Option<Range<u64>> {
        (self.version >= VERSION_WITH_SCENE).then_some(self.assets_end..self.total_len)
    }

    fn name_bytes(&self, raw: &RawEntry) -> &'a [u8] {
        let start = raw.name_offset as usize;
        self.names
            .get(start..start + usize::from(raw.name_len))
            .unwrap_or_default()
    }

    /// Number of textures.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.entries.len() / ENTRY_LEN
    }

    /// Returns true if the library has no textures.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Bytes of the whole library, as stated.
    #[must_use]
    pub const fn total_len(&self) -> u64 {
        self.total_len
    }

    /// The entry at `index`, in order of names.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Entry<'a>> {
        let start = index.checked_mul(ENTRY_LEN)?;
        let raw = RawEntry::read(self.entries.get(start..start.checked_add(ENTRY_LEN)?)?);
        Some(Entry {
            name: core::str::from_utf8(self.name_bytes(&raw)).unwrap_or_default(),
            offset: raw.offset,
            len: raw.len,
            haptic_len: raw.haptic_len,
        })
    }

    /// The index of `name`; a binary search.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<usize> {
        let (mut low, mut high) = (0, self.len());
        while low < high {
            let middle = low + (high - low) / 2;
            match self.get(middle)?.name.cmp(name) {
                Ordering::Equal => return Some(middle),
                Ordering::Less => low = middle + 1,
                Ordering::Greater => high = middle,
            }
        }
        None
    }

    /// Every entry, in order of names.
    pub fn entries(&self) -> impl ExactSizeIterator<Item = Entry<'a>> + use<'a, '_> {
        // `get` answers for every index below `len`.
        (0..self.len()).map(|index| {
            self.get(index).unwrap_or(Entry {
                name: "",
                offset: 0,
                len: 0,
                haptic_len: 0,
            })
        })
    }
}

struct RawEntry {
    offset: u64,
    len: u32,
    haptic_len: u32,
    name_offset: u32,
    name_len: u16,
    reserved: u16,
}

impl RawEntry {
    fn read(record: &[u8]) -> Self {
        Self {
            offset: u64::from_le_bytes(array_at(record, 0)),
            len: u32::from_le_bytes(array_at(record, 8)),
            haptic_len: u32::from_le_bytes(array_at(record, 12)),
            name_offset: u32::from_le_bytes(array_at(record, 16)),
            name_len: u16::from_le_bytes(array_at(record, 20)),
            reserved: u16::from_le_bytes(array_at(record, 22)),
        }
    }
}

//! The header and the section table: where everything is, and under which CRC.

use crate::{checksum::crc32, error::FormatError, limits, wire::array_at};

/// Latest version of the asset format; an asset is written in the lowest one that can hold it.
pub const VERSION: u16 = VERSION_WITH_OPTIONAL;
/// The version of an asset whose friction has no law.
pub(crate) const VERSION_WITHOUT_LAW: u16 = 1;
/// The version of an asset whose friction has a law.
pub(crate) const VERSION_WITH_LAW: u16 = 2;
/// The version of an asset with sections of [`OPTIONAL`].
pub(crate) const VERSION_WITH_OPTIONAL: u16 = 3;
/// First bytes of an asset.
pub(crate) const MAGIC: [u8; 4] = *b"ASPT";
/// Bytes before the section table.
pub(crate) const FIXED_LEN: usize = 20;
/// Bytes of a table entry.
pub(crate) const ENTRY_LEN: usize = 12;

/// Every section, in file order. A runtime needs the haptic ones, in upper case. The
/// ancillary ones, in lower case, are optional and skipped where unknown.
pub(crate) const NAME: [u8; 4] = *b"NAME";
pub(crate) const GRID: [u8; 4] = *b"GRID";
pub(crate) const TAPS: [u8; 4] = *b"TAPS";
pub(crate) const FRICTION: [u8; 4] = *b"FRIC";
pub(crate) const COUPLING: [u8; 4] = *b"SURF";
pub(crate) const CONTACT: [u8; 4] = *b"CONT";
pub(crate) const AXIS: [u8; 4] = *b"AXIS";
pub(crate) const PROVENANCE: [u8; 4] = *b"prov";
pub(crate) const PREVIEW: [u8; 4] = *b"prev";
pub(crate) const LATENT: [u8; 4] = *b"late";
pub(crate) const HISTORY: [u8; 4] = *b"hist";

/// The haptic sections that every asset has, in this order.
pub(crate) const HAPTIC: [([u8; 4], &str); 5] = [
    (NAME, "name"),
    (GRID, "grid"),
    (TAPS, "taps"),
    (FRICTION, "friction"),
    (COUPLING, "surface"),
];
/// The haptic sections of version 3, behind the others in this order; at least one of them.
pub(crate) const OPTIONAL: [([u8; 4], &str); 2] = [(CONTACT, "contact"), (AXIS, "direction")];

/// Location and checksum of a section in an asset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SectionInfo {
    /// Four-byte tag; upper case first: haptic.
    pub tag: [u8; 4],
    /// First byte in the asset.
    pub offset: usize,
    /// Length in bytes.
    pub len: usize,
    /// CRC-32 of the section's bytes.
    pub crc32: u32,
}

impl SectionInfo {
    /// Returns true if a runtime needs the section.
    #[must_use]
    pub const fn is_haptic(&self) -> bool {
        self.tag[0].is_ascii_uppercase()
    }

    /// The tag as the name that errors use.
    pub(crate) fn label(&self) -> &'static str {
        let mut haptic = HAPTIC.iter().chain(&OPTIONAL);
        haptic.find(|(tag, _)| *tag == self.tag).map_or_else(
            || match self.tag {
                PROVENANCE => "provenance",
                PREVIEW => "preview",
                LATENT => "latent",
                HISTORY => "history",
                _ => "ancillary section",
            },
            |(_, label)| label,
        )
    }
}

/// A header whose lengths, magic, version and CRC hold.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Header<'a> {
    table: &'a [u8],
    pub(crate) version: u16,
    pub(crate) total_len: usize,
    pub(crate) haptic_len: usize,
}

impl<'a> Header<'a> {
    /// Checks length, magic, version and header CRC, in this order.
    pub(crate) fn parse(bytes: &'a [u8]) -> Result<Self, FormatError> {
        if bytes.len() < FIXED_LEN {
            return Err(FormatError::TooShort {
                field: "header",
                needed: FIXED_LEN as u64,
                found: bytes.len() as u64,
            });
        }
        let found: [u8; 4] = array_at(bytes, 0);
        if found != MAGIC {
            return Err(FormatError::Magic {
                found,
                expected: MAGIC,
            });
        }
        let version = u16::from_le_bytes(array_at(bytes, 4));
        if version == 0 || version > VERSION {
            return Err(FormatError::Version {
                found: version,
                supported: VERSION,
            });
        }
        let count = usize::from(bytes[6]);
        let end = FIXED_LEN + count * ENTRY_LEN;
        let (Some(fixed), Some(table)) = (bytes.get(..16), bytes.get(FIXED_LEN..end)) else {
            return Err(FormatError::TooShort {
                field: "section table",
                needed: end as u64,
                found: bytes.len() as u64,
            });
        };
        let stated = u32::from_le_bytes(array_at(bytes, 16));
        let computed = crc32(&[fixed, table]);
        if stated != computed {
            return Err(FormatError::Checksum {
                section: "header",
                stated,
                computed,
            });
        }
        let header = Self {
            table,
            version,
            total_len: u32::from_le_bytes(array_at(bytes, 8)) as usize,
            haptic_len: u32::from_le_bytes(array_at(bytes, 12)) as usize,
        };
        header.check_table(bytes[7])?;
        Ok(header)
    }

    /// Sections lie one after the other, haptic ones first; the lengths add up.
    fn check_table(&self, reserved: u8) -> Result<(), FormatError> {
        if reserved != 0 {
            return Err(FormatError::invalid(
                "header.reserved",
                0,
                f64::from(reserved),
                "must be 0",
            ));
        }
        let count = self.sections().count();
        if count > limits::MAX_SECTIONS {
            return Err(FormatError::invalid(
                "header.section_count",
                0,
                count as f64,
                "at most 16 sections",
            ));
        }
        for (position, (tag, _)) in HAPTIC.iter().enumerate() {
            if self.sections().nth(position).map(|s| s.tag) != Some(*tag) {
                return Err(FormatError::Section {
                    tag: *tag,
                    reason: "missing or out of order",
                });
            }
        }
        if (self.haptic_count() > HAPTIC.len()) != (self.version >= VERSION_WITH_OPTIONAL) {
            let next = self.sections().nth(HAPTIC.len());
            let found = next.filter(|section| OPTIONAL.iter().any(|(tag, _)| *tag == section.tag));
            return Err(FormatError::Section {
                tag: found.map_or(CONTACT, |section| section.tag),
                reason: "version 3 has CONT, AXIS or both, and no earlier one has either",
            });
        }
        for (position, section) in self.sections().enumerate().skip(self.haptic_count()) {
            if section.is_haptic() {
                return Err(FormatError::Section {
                    tag: section.tag,
                    reason: "unknown haptic section",
                });
            }
            if self
                .sections()
                .skip(position + 1)
                .any(|s| s.tag == section.tag)
            {
                return Err(FormatError::Section {
                    tag: section.tag,
                    reason: "appears twice",
                });
            }
        }
        let total: u64 = self.end_of(self.sections());
        if total != self.total_len as u64 {
            return Err(FormatError::invalid(
                "header.total_len",
                0,
                self.total_len as f64,
                "must be the sum of header, table and sections",
            ));
        }
        let haptic: u64 = self.end_of(self.sections().take(self.haptic_count()));
        if haptic != self.haptic_len as u64 {
            return Err(FormatError::invalid(
                "header.haptic_len",
                0,
                self.haptic_len as f64,
                "must be the sum of header, table and haptic sections",
            ));
        }
        Ok(())
    }

    /// Number of haptic sections.
    pub(crate) fn haptic_count(&self) -> usize {
        count_haptic(self.sections().map(|section| section.tag))
    }

    fn end_of(&self, sections: impl Iterator<Item = SectionInfo>) -> u64 {
        let head = (FIXED_LEN + self.table.len()) as u64;
        sections.fold(head, |sum, section| sum + section.len as u64)
    }

    /// Every section in file order.
    pub(crate) fn sections(&self) -> impl Iterator<Item = SectionInfo> + use<'a> {
        let mut offset = FIXED_LEN + self.table.len();
        self.table.chunks_exact(ENTRY_LEN).map(move |entry| {
            let section = SectionInfo {
                tag: array_at(entry, 0),
                offset,
                len: u32::from_le_bytes(array_at(entry, 4)) as usize,
                crc32: u32::from_le_bytes(array_at(entry, 8)),
            };
            offset = offset.saturating_add(section.len);
            section
        })
    }
}

/// Number of haptic sections at the front of these tags, of which the first five are in order.
pub(crate) fn count_haptic(tags: impl Iterator<Item = [u8; 4]>) -> usize {
    let mut optional = OPTIONAL.iter();
    let behind = tags
        .skip(HAPTIC.len())
        .take_while(|tag| optional.any(|(next, _)| next == tag));
    HAPTIC.len() + behind.count()
}

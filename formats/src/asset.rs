//! The asset: one texture, as a validated view of its bytes.

use crate::{
    checksum::crc32,
    contact::ContactLaw,
    coupling::Coupling,
    direction::Direction,
    error::FormatError,
    friction::{Friction, text},
    grid::Grid,
    header::{self, Header, SectionInfo},
    latent::Latents,
    limits,
    provenance::Provenance,
    taps::Taps,
};

/// A texture, borrowed from validated bytes.
///
/// Accessors cannot fail and do not allocate.
#[derive(Debug, Clone, Copy)]
pub struct Asset<'a> {
    bytes: &'a [u8],
    header: Header<'a>,
    name: &'a str,
    grid: Grid<'a>,
    taps: Taps<'a>,
    friction: Friction<'a>,
    coupling: Coupling,
    contact: Option<ContactLaw<'a>>,
    direction: Option<Direction>,
    provenance: Option<Provenance<'a>>,
}

impl<'a> Asset<'a> {
    /// Checks a whole asset, ancillary sections included.
    ///
    /// The order is fixed: length, magic, version, header CRC, section table,
    /// stated against actual length, the CRC of every section, then each section's
    /// structure and meaning in file order. Linear in the size of the bytes.
    ///
    /// # Errors
    /// The first check that fails, with field, index and value.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, FormatError> {
        let header = Header::parse(bytes)?;
        if bytes.len() > header.total_len {
            return Err(FormatError::TooLong {
                field: "asset",
                stated: header.total_len as u64,
                found: bytes.len() as u64,
            });
        }
        if bytes.len() < header.total_len {
            return Err(FormatError::TooShort {
                field: "asset",
                needed: header.total_len as u64,
                found: bytes.len() as u64,
            });
        }
        Self::parse_sections(bytes, header, usize::MAX)
    }

    /// Checks only what a runtime needs: the first [`Asset::haptic_len`] bytes.
    /// Bytes behind them may be absent and are not read.
    ///
    /// # Errors
    /// As [`Asset::parse`].
    pub fn parse_haptic(bytes: &'a [u8]) -> Result<Self, FormatError> {
        let header = Header::parse(bytes)?;
        let Some(haptic) = bytes.get(..header.haptic_len) else {
            return Err(FormatError::TooShort {
                field: "haptic sections",
                needed: header.haptic_len as u64,
                found: bytes.len() as u64,
            });
        };
        Self::parse_sections(haptic, header, header.haptic_count())
    }

    fn parse_sections(
        bytes: &'a [u8],
        header: Header<'a>,
        count: usize,
    ) -> Result<Self, FormatError> {
        for section in header.sections().take(count) {
            let computed = crc32(&[body(bytes, &section)]);
            if computed != section.crc32 {
                return Err(FormatError::Checksum {
                    section: section.label(),
                    stated: section.crc32,
                    computed,
                });
            }
        }
        let find = |tag| {
            header
                .sections()
                .take(count)
                .find(|s| s.tag == tag)
                .map(|s| body(bytes, &s))
        };
        let haptic = |tag| find(tag).unwrap_or_default();
        let friction = Friction::parse(haptic(header::FRICTION), header.version)?;
        // In place: an asset that is moved takes its room twice.
        Ok(Self {
            bytes,
            header,
            name: text("name", 0, haptic(header::NAME))?,
            grid: Grid::parse(haptic(header::GRID))?,
            taps: Taps::parse(haptic(header::TAPS))?,
            friction,
            coupling: Coupling::parse(haptic(header::COUPLING))?,
            contact: find(header::CONTACT).map(ContactLaw::parse).transpose()?,
            direction: find(header::AXIS)
                .map(|bytes| Direction::parse(bytes, &friction))
                .transpose()?,
            provenance: ancillary(
                find(header::PROVENANCE),
                preview(bytes, &header),
                find(header::LATENT),
                find(header::HISTORY),
            )?,
        })
    }

    /// Version the asset was written in: 3 with a contact law or a direction, 2 if its friction has a law, else 1.
    #[must_use]
    pub const fn version(&self) -> u16 {
        self.header.version
    }

    /// Name of the texture.
    #[must_use]
    pub const fn name(&self) -> &'a str {
        self.name
    }

    /// The force–speed grid of models.
    #[must_use]
    pub const fn grid(&self) -> &Grid<'a> {
        &self.grid
    }

    /// The tap bank.
    #[must_use]
    pub const fn taps(&self) -> &Taps<'a> {
        &self.taps
    }

    /// μ, its anchors and its law.
    #[must_use]
    pub const fn friction(&self) -> &Friction<'a> {
        &self.friction
    }

    /// Wall and gains.
    #[must_use]
    pub const fn coupling(&self) -> &Coupling {
        &self.coupling
    }

    /// The contact law, if the material gives way.
    #[must_use]
    pub const fn contact(&self) -> Option<&ContactLaw<'a>> {
        self.contact.as_ref()
    }

    /// The direction, if it differs along an axis and across it.
    #[must_use]
    pub const fn direction(&self) -> Option<&Direction> {
        self.direction.as_ref()
    }

    /// Provenance; absent after [`Asset::parse_haptic`].
    #[must_use]
    pub const fn provenance(&self) -> Option<&Provenance<'a>> {
        self.provenance.as_ref()
    }

    /// Preview image, PNG; absent after [`Asset::parse_haptic`].
    #[must_use]
    pub fn preview_png(&self) -> Option<&'a [u8]> {
        preview(self.bytes, &self.header)
    }

    fn tagged(&self, tag: [u8; 4]) -> Option<&'a [u8]> {
        self.section(&self.sections().find(|s| s.tag == tag)?)
    }

    /// The latents it was decoded from; absent after [`Asset::parse_haptic`].
    #[must_use]
    pub fn latents(&self) -> Option<Latents<'a>> {
        Latents::parse(self.tagged(header::LATENT)?).ok()
    }

    /// Creation and editing history, JSON; absent after [`Asset::parse_haptic`].
    #[must_use]
    pub fn history(&self) -> Option<&'a str> {
        history(self.tagged(header::HISTORY)?).ok()
    }

    /// Bytes of one section; `None` if it is not there, or behind what was parsed.
    #[must_use]
    pub fn section(&self, section: &SectionInfo) -> Option<&'a [u8]> {
        self.bytes
            .get(section.offset..section.offset.checked_add(section.len)?)
    }

    /// Bytes a runtime needs: header, table and haptic sections.
    #[must_use]
    pub const fn haptic_len(&self) -> usize {
        self.header.haptic_len
    }

    /// Bytes of the whole asset.
    #[must_use]
    pub const fn total_len(&self) -> usize {
        self.header.total_len
    }

    /// Every section in file order.
    pub fn sections(&self) -> impl Iterator<Item = SectionInfo> + use<'a> {
        self.header.sections()
    }
}

/// The preview's bytes, where they are among `bytes`.
fn preview<'a>(bytes: &'a [u8], header: &Header<'_>) -> Option<&'a [u8]> {
    let section = header.sections().find(|s| s.tag == header::PREVIEW)?;
    bytes.get(section.offset..section.offset.saturating_add(section.len))
}

/// Checks the sections that a runtime does not need: a function of its own, because they take stack.
#[inline(never)]
fn ancillary<'a>(
    provenance: Option<&'a [u8]>,
    preview: Option<&[u8]>,
    latents: Option<&[u8]>,
    edits: Option<&[u8]>,
) -> Result<Option<Provenance<'a>>, FormatError> {
    let provenance = provenance.map(Provenance::parse).transpose();
    if provenance.is_ok() && preview.is_some_and(|png| !png.starts_with(b"\x89PNG\r\n\x1a\n")) {
        return Err(FormatError::Section {
            tag: header::PREVIEW,
            reason: "is not a PNG",
        });
    }
    latents.map(Latents::parse).transpose()?;
    edits.map(history).transpose()?;
    provenance
}

/// A section's bytes; the header proved that they are inside.
fn body<'a>(bytes: &'a [u8], section: &SectionInfo) -> &'a [u8] {
    bytes
        .get(section.offset..section.offset.saturating_add(section.len))
        .unwrap_or_default()
}

/// The text of the history, which nothing but the compiler reads any further.
fn history(bytes: &[u8]) -> Result<&str, FormatError> {
    let reject = |reason| FormatError::Section {
        tag: header::HISTORY,
        reason,
    };
    if bytes.len() > limits::MAX_HISTORY_BYTES {
        return Err(reject("is longer than 65536 bytes"));
    }
    core::str::from_utf8(bytes).map_err(|_| reject("is not UTF-8"))
}

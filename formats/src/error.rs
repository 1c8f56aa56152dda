//! Why bytes were rejected, or could not be written.

use thiserror::Error;

/// Why an asset or a library was rejected.
///
/// Variants stand in the order in which the checks run: length, magic, version,
/// checksum, structure, meaning.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum FormatError {
    /// Fewer bytes than the smallest file, or than the header says.
    #[error("{field}: {needed} bytes needed, {found} found: the file is truncated")]
    TooShort {
        /// Name of the truncated field.
        field: &'static str,
        /// Bytes needed.
        needed: u64,
        /// Bytes found.
        found: u64,
    },
    /// More bytes than the header says.
    #[error("{field}: {stated} bytes stated, {found} found: trailing bytes")]
    TooLong {
        /// Name of the overlong field.
        field: &'static str,
        /// Bytes stated.
        stated: u64,
        /// Bytes found.
        found: u64,
    },
    /// The first four bytes are not ours.
    #[error("magic: {found:02x?} found, {expected:02x?} expected: not this kind of file")]
    Magic {
        /// Bytes found.
        found: [u8; 4],
        /// Bytes expected.
        expected: [u8; 4],
    },
    /// Written by a later or unknown version of the format.
    #[error("version: {found} found, {supported} supported: update the reader")]
    Version {
        /// Version found.
        found: u16,
        /// Latest version this reader knows.
        supported: u16,
    },
    /// Bytes changed after they were written.
    #[error(
        "{section} checksum: {stated:08x} stated, {computed:08x} computed: the file is damaged"
    )]
    Checksum {
        /// Section, or `header`.
        section: &'static str,
        /// CRC-32 in the file.
        stated: u32,
        /// CRC-32 of the bytes.
        computed: u32,
    },
    /// A section is missing, repeated, unknown or out of order.
    #[error("section {}: {reason}", tag.escape_ascii())]
    Section {
        /// Four-byte tag.
        tag: [u8; 4],
        /// Description of the defect.
        reason: &'static str,
    },
    /// A value is outside its range, or breaks a rule.
    #[error("{field}[{index}] = {value}: {rule}")]
    Invalid {
        /// Section and field, e.g. `grid.vertex.speed_mm_s`.
        field: &'static str,
        /// Index of the element; 0 for a scalar field.
        index: u32,
        /// The value found.
        value: f64,
        /// The rule it breaks.
        rule: &'static str,
    },
    /// A text is not UTF-8, empty, or too long.
    #[error("{field}[{index}]: {reason}")]
    Text {
        /// Section and field.
        field: &'static str,
        /// Index of the element.
        index: u32,
        /// Description of the defect.
        reason: &'static str,
    },
    /// Metadata that postcard cannot read.
    #[error("{section}: metadata does not decode")]
    Metadata {
        /// Section.
        section: &'static str,
    },
    /// The index of a texture that the library does not have.
    #[error("texture {index}: the library has {count}")]
    NoSuchTexture {
        /// Index asked for.
        index: usize,
        /// Textures in the library.
        count: usize,
    },
}

impl FormatError {
    /// A typed rejection of one number.
    pub(crate) const fn invalid(
        field: &'static str,
        index: usize,
        value: f64,
        rule: &'static str,
    ) -> Self {
        Self::Invalid {
            field,
            index: index as u32,
            value,
            rule,
        }
    }
}

/// Why an asset could not be written.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum EncodeError {
    /// The buffer is too small.
    #[error("the buffer has {available} bytes, {needed} or more are needed")]
    BufferTooSmall {
        /// Bytes needed up to the point of failure.
        needed: usize,
        /// Bytes there are.
        available: usize,
    },
    /// A list has another length than its siblings say, or more than a byte counts.
    #[error("{field}[{index}]: {found} entries, {expected} expected")]
    Count {
        /// Which list.
        field: &'static str,
        /// Which one of them.
        index: usize,
        /// Entries found.
        found: usize,
        /// Entries expected, or the most there can be.
        expected: usize,
    },
    /// Metadata that postcard cannot write into the buffer.
    #[error("provenance does not fit the buffer")]
    Metadata,
    /// The result would be rejected by a reader.
    #[error("the asset would be rejected: {0}")]
    Rejected(#[from] FormatError),
}

/// Rejects a value that is not finite or not in `min..=max`.
pub(crate) fn in_range(
    field: &'static str,
    index: usize,
    value: f32,
    (min, max): (f32, f32),
    rule: &'static str,
) -> Result<f32, FormatError> {
    // A NaN compares false with everything, so it is rejected here too.
    if value >= min && value <= max {
        Ok(value)
    } else {
        Err(FormatError::invalid(field, index, f64::from(value), rule))
    }
}

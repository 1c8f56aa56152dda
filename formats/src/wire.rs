//! Bounds-checked little-endian reading and writing.

use crate::error::{EncodeError, FormatError};
use half::f16;

/// Reads a section front to back; every step says what it wanted.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reader<'a> {
    bytes: &'a [u8],
    position: usize,
}

impl<'a> Reader<'a> {
    pub(crate) const fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, position: 0 }
    }

    pub(crate) fn bytes(
        &mut self,
        field: &'static str,
        count: usize,
    ) -> Result<&'a [u8], FormatError> {
        let rest = self.bytes.get(self.position..).unwrap_or_default();
        match rest.get(..count) {
            Some(piece) => {
                self.position += count;
                Ok(piece)
            }
            None => Err(FormatError::TooShort {
                field,
                needed: count as u64,
                found: rest.len() as u64,
            }),
        }
    }

    fn array<const N: usize>(&mut self, field: &'static str) -> Result<[u8; N], FormatError> {
        let mut out = [0; N];
        out.copy_from_slice(self.bytes(field, N)?);
        Ok(out)
    }

    pub(crate) fn u8(&mut self, field: &'static str) -> Result<u8, FormatError> {
        Ok(self.array::<1>(field)?[0])
    }

    pub(crate) fn u16(&mut self, field: &'static str) -> Result<u16, FormatError> {
        Ok(u16::from_le_bytes(self.array(field)?))
    }

    pub(crate) fn f32(&mut self, field: &'static str) -> Result<f32, FormatError> {
        Ok(f32::from_le_bytes(self.array(field)?))
    }

    /// Returns true if nothing is left.
    pub(crate) const fn is_empty(&self) -> bool {
        self.position == self.bytes.len()
    }

    /// A section may not hold more than its fields.
    pub(crate) fn finish(self, section: &'static str) -> Result<(), FormatError> {
        if self.position == self.bytes.len() {
            Ok(())
        } else {
            Err(FormatError::TooLong {
                field: section,
                stated: self.position as u64,
                found: self.bytes.len() as u64,
            })
        }
    }
}

/// Reads `N` bytes at `at` of bytes that were validated before; zeros beyond them.
#[inline]
pub(crate) fn array_at<const N: usize>(bytes: &[u8], at: usize) -> [u8; N] {
    let mut out = [0; N];
    if let Some(piece) = bytes.get(at..at.saturating_add(N)) {
        out.copy_from_slice(piece);
    }
    out
}

/// Reads a binary16 at `at` of validated bytes.
#[inline]
pub(crate) fn f16_at(bytes: &[u8], at: usize) -> f32 {
    f16::from_le_bytes(array_at(bytes, at)).to_f32()
}

/// Reads a binary32 at `at` of validated bytes.
#[inline]
pub(crate) fn f32_at(bytes: &[u8], at: usize) -> f32 {
    f32::from_le_bytes(array_at(bytes, at))
}

/// Reads a u16 at `at` of validated bytes.
#[inline]
pub(crate) fn u16_at(bytes: &[u8], at: usize) -> u16 {
    u16::from_le_bytes(array_at(bytes, at))
}

/// Writes front to back into a caller's buffer.
pub(crate) struct Writer<'a> {
    bytes: &'a mut [u8],
    position: usize,
}

impl<'a> Writer<'a> {
    pub(crate) const fn new(bytes: &'a mut [u8], position: usize) -> Self {
        Self { bytes, position }
    }

    pub(crate) const fn position(&self) -> usize {
        self.position
    }

    pub(crate) fn bytes(&mut self, piece: &[u8]) -> Result<(), EncodeError> {
        let end = self.position.saturating_add(piece.len());
        let available = self.bytes.len();
        match self.bytes.get_mut(self.position..end) {
            Some(place) => {
                place.copy_from_slice(piece);
                self.position = end;
                Ok(())
            }
            None => Err(EncodeError::BufferTooSmall {
                needed: end,
                available,
            }),
        }
    }

    pub(crate) fn u8(&mut self, value: u8) -> Result<(), EncodeError> {
        self.bytes(&[value])
    }

    pub(crate) fn u16(&mut self, value: u16) -> Result<(), EncodeError> {
        self.bytes(&value.to_le_bytes())
    }

    pub(crate) fn u32(&mut self, value: u32) -> Result<(), EncodeError> {
        self.bytes(&value.to_le_bytes())
    }

    pub(crate) fn u64(&mut self, value: u64) -> Result<(), EncodeError> {
        self.bytes(&value.to_le_bytes())
    }

    pub(crate) fn f32(&mut self, value: f32) -> Result<(), EncodeError> {
        self.bytes(&value.to_le_bytes())
    }

    pub(crate) fn f16(&mut self, value: f32) -> Result<(), EncodeError> {
        self.bytes(&f16::from_f32(value).to_le_bytes())
    }
}

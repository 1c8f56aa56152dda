//! late: where a texture lies in the latent space of a learned model.

use crate::{error::FormatError, limits, wire::Reader};

/// The latents that an asset was decoded from. The runtime never reads them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Latents<'a> {
    /// CRC-32 of the model whose latent space it is.
    pub model_crc32: u32,
    /// Number of latents: 1 for the whole texture, or 3 for sliding, tapping and friction.
    parts: usize,
    /// Numbers of a latent.
    width: usize,
    numbers: &'a [u8],
}

impl<'a> Latents<'a> {
    pub(crate) fn parse(bytes: &'a [u8]) -> Result<Self, FormatError> {
        let mut reader = Reader::new(bytes);
        let mut crc = [0; 4];
        crc.copy_from_slice(reader.bytes("latent.model_crc32", 4)?);
        let parts = usize::from(reader.u8("latent.parts")?);
        let reserved = reader.u8("latent.reserved")?;
        let width = usize::from(reader.u16("latent.width")?);
        for (field, value, fits, rule) in [
            ("latent.parts", parts, parts == 1 || parts == 3, "1 or 3"),
            (
                "latent.reserved",
                reserved.into(),
                reserved == 0,
                "must be 0",
            ),
            (
                "latent.width",
                width,
                (1..=limits::MAX_LATENT).contains(&width),
                "1 to 1024 numbers",
            ),
        ] {
            if !fits {
                return Err(FormatError::invalid(field, 0, value as f64, rule));
            }
        }
        let numbers = reader.bytes("latent.numbers", 4 * parts * width)?;
        reader.finish("latent")?;
        let latents = Self {
            model_crc32: u32::from_le_bytes(crc),
            parts,
            width,
            numbers,
        };
        let all = latents.numbers(0..parts * width);
        match all.enumerate().find(|(_, x)| !x.is_finite()) {
            Some((index, x)) => Err(FormatError::invalid(
                "latent.numbers",
                index,
                f64::from(x),
                "must be finite",
            )),
            None => Ok(latents),
        }
    }

    /// Number of latents: 1 for the whole texture, or 3 for sliding, tapping and friction.
    #[must_use]
    pub const fn parts(&self) -> usize {
        self.parts
    }

    /// Numbers of a latent.
    #[must_use]
    pub const fn width(&self) -> usize {
        self.width
    }

    /// The numbers of one latent; none for a part that is not there.
    pub fn part(&self, part: usize) -> impl Iterator<Item = f32> + use<'a> {
        let range = if part < self.parts {
            part * self.width..(part + 1) * self.width
        } else {
            0..0
        };
        self.numbers(range)
    }

    fn numbers(&self, range: core::ops::Range<usize>) -> impl Iterator<Item = f32> + use<'a> {
        let bytes = self.numbers.get(4 * range.start..4 * range.end);
        let words = bytes.unwrap_or_default().chunks_exact(4);
        words.map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
    }
}

//! late: where a texture lies in the latent space of a learned model.

use crate::{error::FormatError, grid::record, limits, wire::Reader};

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
        match words(numbers).enumerate().find(|(_, x)| !x.is_finite()) {
            Some((index, x)) => Err(FormatError::invalid(
                "latent.numbers",
                index,
                f64::from(x),
                "must be finite",
            )),
            None => Ok(Self {
                model_crc32: u32::from_le_bytes(crc),
                parts,
                width,
                numbers,
            }),
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
        words(record(self.numbers, part, 4 * self.width).unwrap_or_default())
    }
}

fn words(bytes: &[u8]) -> impl Iterator<Item = f32> {
    let words = bytes.as_chunks().0.iter();
    words.map(|word| f32::from_le_bytes(*word))
}

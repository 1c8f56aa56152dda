//! prov: where a texture comes from, as postcard metadata.

use crate::{error::FormatError, limits};
use serde::{Deserialize, Serialize};

/// Where a texture comes from. The runtime never reads it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Provenance<'a> {
    /// Tool, version and command that generated the texture.
    pub generator: &'a str,
    /// File or corpus entry it was made from, without a folder.
    pub source: &'a str,
    /// CRC-32 of the source's bytes, 0 where there is no file.
    pub source_crc32: u32,
    /// The prompt, for a texture that has one.
    pub prompt: Option<&'a str>,
    /// Seed of everything random in its making.
    pub seed: u64,
    /// Fidelity asked for: `full`, `auto` or an order.
    pub fidelity: &'a str,
    /// True if the taps are synthetic rather than recorded.
    pub taps_synthetic: bool,
    /// RMS spectral error of LSF quantisation over the grid, dB.
    pub lsf_error_db: f32,
    /// Caveats: synthetic parts, unconfirmed defaults.
    pub notes: &'a str,
}

impl<'a> Provenance<'a> {
    pub(crate) fn parse(bytes: &'a [u8]) -> Result<Self, FormatError> {
        if bytes.len() > limits::MAX_PROVENANCE_BYTES {
            return Err(FormatError::invalid(
                "provenance.len",
                0,
                bytes.len() as f64,
                "at most 16384 bytes",
            ));
        }
        let reject = FormatError::Metadata {
            section: "provenance",
        };
        match postcard::take_from_bytes::<Self>(bytes) {
            // Later minor versions may append fields.
            Ok((provenance, _)) if provenance.lsf_error_db.is_finite() => Ok(provenance),
            _ => Err(reject),
        }
    }
}

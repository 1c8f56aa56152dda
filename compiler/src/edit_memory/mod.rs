//! Edit memory of an asset: latents and history, outside the haptic sections.
//!
//! The runtime skips both; [edits](crate::sources::latents) begin with them. An asset that was not decoded from a latent remembers
//! nothing:
//!
//! ```
//! use asperity::{
//!     sources::builtin,
//!     edit_memory::{Latents, remembered},
//!     learned::description::LATENT,
//!     emit::lower::lower,
//! };
//! use asperity_formats::Asset;
//!
//! let bytes = lower(&builtin::texture(), None).expect("a texture that fits an asset").bytes;
//! let asset = Asset::parse(&bytes).expect("a valid asset");
//! assert_eq!(remembered(&asset).expect("no damaged history"), None);
//!
//! let (a, b) = (Latents::whole([0.0; LATENT]), Latents::whole([1.0; LATENT]));
//! assert_eq!(Latents::between(&a, &b, 0.5).slide, [0.5; LATENT]);
//! ```

mod history;
mod latents;
mod sliders;

pub use history::{History, Ingredient, Origin, Step};
pub use latents::Latents;
pub use sliders::{AXES, Axis, Sliders};

use crate::learned::{Latent, description::LATENT};
use asperity_formats::{Asset, EncodeError, assemble, assembled_len};
use asperity_io::diagnostic::Fault;
use std::fmt::Display;

const LATENT_TAG: [u8; 4] = *b"late";
const HISTORY_TAG: [u8; 4] = *b"hist";

/// Edit memory of an asset.
#[derive(Debug, Clone, PartialEq)]
pub struct Memory {
    /// CRC-32 of the model whose latents these are.
    pub model_crc32: u32,
    /// Latents that the texture was decoded from.
    pub latents: Latents,
    /// Creation and edit history.
    pub history: History,
}

/// The asset with this memory in place of any that it had. Its haptic sections keep their bytes.
///
/// # Errors
/// [`EncodeError`] for bytes that are no asset.
pub(crate) fn remember(asset: &[u8], memory: &Memory) -> Result<Vec<u8>, EncodeError> {
    let latent = latent_body(memory);
    let history = History {
        shift: memory.latents.shift,
        ..memory.history.clone()
    };
    let json = history.json();
    let asset = Asset::parse(asset)?;
    let mut sections: Vec<([u8; 4], &[u8])> = asset
        .sections()
        .filter(|section| section.tag != LATENT_TAG && section.tag != HISTORY_TAG)
        .filter_map(|section| Some((section.tag, asset.section(&section)?)))
        .collect();
    sections.push((LATENT_TAG, &latent));
    if !history.is_empty() {
        sections.push((HISTORY_TAG, json.as_bytes()));
    }
    let mut bytes = vec![0; assembled_len(&sections)];
    assemble(&sections, &mut bytes)?;
    Ok(bytes)
}

fn latent_body(memory: &Memory) -> Vec<u8> {
    let parts = memory.latents.parts();
    let mut body = memory.model_crc32.to_le_bytes().to_vec();
    body.extend([parts.len() as u8, 0]);
    body.extend((LATENT as u16).to_le_bytes());
    body.extend(parts.iter().flatten().flat_map(|x| x.to_le_bytes()));
    body
}

/// Returns the fault of a history that is not what this version writes, or is damaged.
pub(crate) fn damaged(name: &str, what: impl Display) -> Fault {
    let what = format!("history of {name:?}: {what}");
    Fault::new(what, "build the file again from its source")
}

/// Reads the edit memory of an asset; `None` if it has no latent, or a latent of another width than this version's.
///
/// # Errors
/// [`Fault`] for a history that this version does not write.
pub fn remembered(asset: &Asset<'_>) -> Result<Option<Memory>, Fault> {
    let Some(stored) = asset.latents().filter(|stored| stored.width() == LATENT) else {
        return Ok(None);
    };
    let part = |part: usize| -> Latent {
        let mut z = [0.0; LATENT];
        z.iter_mut()
            .zip(stored.part(part))
            .for_each(|(z, x)| *z = x);
        z
    };
    let parts: Vec<Latent> = (0..stored.parts()).map(part).collect();
    let Some(latents) = Latents::of_parts(&parts) else {
        return Ok(None);
    };
    let history: History = match asset.history() {
        None => History::default(),
        Some(json) => serde_json::from_str(json).map_err(|error| damaged(asset.name(), error))?,
    };
    Ok(Some(Memory {
        model_crc32: stored.model_crc32,
        latents: latents.shifted(history.shift),
        history,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{emit::lower::lower, sources::builtin};

    #[test]
    fn a_memory_is_read_back_replaced_and_never_haptic() {
        let plain = lower(&builtin::texture(), None).unwrap().bytes;
        let haptic = |bytes: &[u8]| -> Vec<Vec<u8>> {
            let asset = Asset::parse(bytes).unwrap();
            let haptic = asset.sections().filter(|s| s.is_haptic());
            haptic
                .map(|s| asset.section(&s).unwrap().to_vec())
                .collect()
        };
        let mut memory = Memory {
            model_crc32: 7,
            latents: Latents::whole([0.25; LATENT]),
            history: History::default(),
        };
        let once = remember(&plain, &memory).unwrap();
        assert_eq!(once.len() - plain.len(), 12 + 8 + 4 * LATENT);
        assert_eq!(haptic(&once), haptic(&plain));
        memory.latents.tap = [1.0; LATENT];
        memory.latents.shift.hard = -0.1;
        memory.history = History::of(Origin::Encode {
            name: "x".into(),
            part: "slide".into(),
        });
        memory.history.shift = memory.latents.shift;
        let twice = remember(&once, &memory).unwrap();
        let found = remembered(&Asset::parse(&twice).unwrap()).unwrap();
        assert_eq!(found, Some(memory));
        assert_eq!(remembered(&Asset::parse(&plain).unwrap()).unwrap(), None);
    }
}

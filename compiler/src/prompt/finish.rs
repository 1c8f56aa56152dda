//! From a decoded texture to verified bytes: reduction, preview, lowering, verification.

use super::{Clock, Options, PromptError};
use crate::{
    learned::texture::calmed,
    lower::{self, Lowered},
    model::TextureModel,
    preview, reduce,
    verify::{self, VerifyError, VerifyReport},
};

/// Shares of the way to white noise that are tried in turn where none will not do.
const CALMED: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// A texture that passed verification.
#[derive(Debug, Clone)]
pub struct Finished {
    /// The texture as it was verified.
    pub texture: TextureModel,
    /// What the fidelity left out, and what that cost.
    pub reduction: reduce::Report,
    /// The preview, if one was asked for.
    pub preview: Option<Vec<u8>>,
    /// The asset.
    pub lowered: Lowered,
    /// What verification saw.
    pub verified: VerifyReport,
    /// How far the models were moved towards white noise, 0..=1.
    pub calmed: f64,
}

/// Reduces, lowers and verifies a decoded texture. One that rings without bound in motion is
/// calmed until it does not; white noise cannot.
///
/// # Errors
/// [`PromptError`] with the stage that failed.
pub fn finish(
    texture: &TextureModel,
    families: &[(&str, f64)],
    options: &Options,
    clock: &mut Clock,
) -> Result<Finished, PromptError> {
    let rings = |error: &PromptError| {
        use VerifyError::{Tick, Unstable};
        matches!(error, PromptError::Verify(Tick { .. } | Unstable { .. }))
    };
    let mut result = attempt(texture, 0.0, families, options, clock);
    for share in CALMED {
        match &result {
            Err(error) if rings(error) => {
                result = attempt(&calmed(texture, share), share, families, options, clock);
            }
            _ => break,
        }
    }
    result
}

fn attempt(
    texture: &TextureModel,
    share: f64,
    families: &[(&str, f64)],
    options: &Options,
    clock: &mut Clock,
) -> Result<Finished, PromptError> {
    let reduce::Reduction { texture, report } = reduce::reduce(texture, options.fidelity);
    clock.lap("reduce");
    let preview = if options.preview {
        let png = preview::png(&texture.grid, families, options.seed)?;
        clock.lap("preview");
        Some(png)
    } else {
        None
    };
    let lowered = lower::lower(&texture, preview.as_deref())?;
    clock.lap("lower");
    let verified = verify::verify(&texture, &lowered.bytes)?;
    clock.lap("verify");
    Ok(Finished {
        texture,
        reduction: report,
        preview,
        lowered,
        verified,
        calmed: share,
    })
}

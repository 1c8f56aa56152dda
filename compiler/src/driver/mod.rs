//! The one way from a source to a verified asset.
//!
//! Whatever a texture is made of, [`compile`] reads it, takes it through the passes
//!
//! ```text
//! rerate → reduce → ceiling → preview → lower → verify → compare
//! ```
//!
//! and says how far the asset is from its source.
//!
//! ```
//! use asperity::{sources::{builtin::Builtin, Tools}, driver, pipeline::Request};
//!
//! let compiled = driver::compile(&Builtin, &Request::default(), &Tools::default())?;
//! assert_eq!(&compiled.lowered.bytes[..4], b"ASPT");
//! let passes: Vec<&str> = compiled.timings.iter().map(|(pass, _)| pass.name()).collect();
//! assert_eq!(passes, ["generate", "reduce", "ceiling", "lower", "verify"]);
//! # Ok::<(), asperity::driver::Failure>(())
//! ```

mod prompts;

pub use crate::compiled::{Compared, Compiled, ErrorReference};
pub use asperity_io::diagnostic::Failure;

use crate::{
    edit_memory::remembered,
    emit::{
        lower::{ErrorSummary, LowerError, Lowered},
        sections::renamed,
    },
    passes::reduce::{Fidelity, reduce},
    pipeline::{Attachments, Pass, Pipeline, PipelineError, Request},
    sources::{Source, SourceOutput, Tools, asset, latents::equal_loudness},
};
use asperity_formats::{Asset, EncodeError};
use asperity_io::diagnostic::Diagnostic;
use rayon::prelude::*;
use thiserror::Error;

/// A texture did not pass the pipeline.
#[derive(Debug, Error)]
#[error("{origin}{colon}{cause}", colon = if origin.is_empty() { "" } else { ": " })]
pub struct Stopped {
    /// Name of the source; may be empty.
    pub origin: String,
    /// The pass that failed, and why.
    pub cause: PipelineError,
}

impl Diagnostic for Stopped {
    fn remedy(&self) -> String {
        self.cause.remedy()
    }

    fn is_usage(&self) -> bool {
        self.cause.is_usage()
    }
}

/// Compiles the texture of a source. The same inputs and request give the same bytes.
///
/// # Errors
/// What the source says, or [`Stopped`] with the pass that failed; where the tools say that no more is wanted. Nothing
/// is written either way.
pub fn compile(
    source: &dyn Source,
    request: &Request,
    tools: &Tools<'_>,
) -> Result<Compiled, Failure> {
    tools.go_on()?;
    let mut pipeline = Pipeline::timed(tools.clock);
    let mut sourced = source.model(request, tools, &mut pipeline)?;
    if let Some(asset) = sourced.asset.take() {
        if request
            .conversion(sourced.texture.grid.sample_rate_hz)
            .is_none()
        {
            return Ok(passthrough(sourced, &asset, request, pipeline)?);
        }
        // Converted to another rate, it keeps all else.
        let parsed = asset::parsed(&asset)?;
        sourced.picture = parsed.preview_png().map(<[u8]>::to_owned);
        sourced.memory = remembered(&parsed)?;
    } else if let Some(memory) = &mut sourced.memory {
        memory.history.loudness_db = request.loudness_db;
    }
    if let Some(name) = &request.name {
        sourced.texture.name.clone_from(name);
    }
    if let Some(level_db) = request.loudness_db {
        equal_loudness(&mut sourced.texture, level_db);
    }
    Ok(
        compiled(sourced, request, pipeline).map_err(|cause| Stopped {
            origin: source.origin(),
            cause,
        })?,
    )
}

/// Compiles several sources in parallel; results in their order, whatever the thread count. `done` is
/// called once a source, from any thread.
pub fn compile_all<S: Source>(
    sources: &[S],
    request: &Request,
    tools: &Tools<'_>,
    done: impl Fn() + Sync,
) -> Vec<Result<Compiled, Failure>> {
    let compiled = sources.par_iter().map(|source| {
        let result = compile(source, request, tools);
        done();
        result
    });
    compiled.collect()
}

/// An asset that is passed through unchanged, under the name that was asked for.
fn passthrough(
    sourced: SourceOutput,
    asset: &[u8],
    request: &Request,
    pipeline: Pipeline,
) -> Result<Compiled, LowerError> {
    let mut texture = sourced.texture;
    let bytes = match &request.name {
        Some(name) => {
            texture.name.clone_from(name);
            renamed(asset, name)?
        }
        None => asset.to_owned(),
    };
    let parsed = Asset::parse(&bytes).map_err(EncodeError::from)?;
    let lowered = Lowered {
        haptic_bytes: parsed.haptic_len(),
        models: parsed.grid().models().len(),
        lsf_error: ErrorSummary::default(),
        bytes: bytes.clone(),
    };
    Ok(Compiled {
        reduction: reduce(&texture, Fidelity::Full).report,
        whole: texture.clone(),
        texture,
        fidelity: Fidelity::Full,
        preview: parsed.preview_png().map(<[u8]>::to_owned),
        lowered,
        verified: None,
        stabilised: 0.0,
        compared: None,
        certainty: sourced.certainty,
        warnings: sourced.warnings,
        findings: sourced.findings,
        timings: pipeline.timings().clone(),
    })
}

fn compiled(
    sourced: SourceOutput,
    request: &Request,
    mut pipeline: Pipeline,
) -> Result<Compiled, PipelineError> {
    let SourceOutput {
        texture,
        asset: _,
        truth,
        ringing,
        memory,
        picture,
        certainty,
        mut warnings,
        findings,
    } = sourced;
    let attachments = Attachments {
        picture: picture.as_deref(),
        memory: memory.as_ref(),
    };
    let mut passed = pipeline.compile(texture, request, ringing, &attachments)?;
    let compared = truth.map(|truth| {
        pipeline.run(Pass::Compare, || {
            truth.compared(&mut passed, request.fidelity)
        })
    });
    if passed.stabilised > 0.0 {
        warnings.push(format!(
            "the models rang in motion and were moved {:.0} % of the way to white noise",
            100.0 * passed.stabilised
        ));
    }
    Ok(Compiled {
        whole: passed.whole,
        texture: passed.texture,
        fidelity: request.fidelity,
        reduction: passed.reduction,
        preview: passed.preview,
        lowered: passed.lowered,
        verified: Some(passed.verified),
        stabilised: passed.stabilised,
        compared: compared.transpose()?,
        certainty,
        warnings,
        findings,
        timings: pipeline.timings().clone(),
    })
}

//! From a folder of sensor files to a verified asset.

use super::{
    analyse::{Analysis, analyse},
    complete::{Completed, complete},
    error::RecordingFailure,
    texture::{Sources, texture},
};
use crate::{
    front_ends::imported::{Imported, Report, Truth},
    learned::LearnedModel,
    model::{Numerator, TextureModel, defaults},
    pipeline::{Pass, Pipeline, PipelineError, Request, Ringing},
};
use std::path::Path;

/// What a user can ask of an import.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// What is asked of any texture; the rate of the analysis is 1 kHz.
    pub request: Request,
    /// Whether faults of the recording are let pass.
    pub force: bool,
}

/// An imported recording.
#[derive(Debug)]
pub struct RecordingImport {
    /// The asset.
    pub bytes: Vec<u8>,
    /// Its figures.
    pub report: Report,
    /// The texture before reduction.
    pub whole: TextureModel,
    /// What the sensors said.
    pub analysis: Analysis,
    /// What the learned model said.
    pub completed: Completed,
    /// Where each part comes from.
    pub sources: Sources,
    /// The time of every pass.
    pub pipeline: Pipeline,
}

/// Imports a recording.
///
/// # Errors
/// [`RecordingFailure`]; nothing is written either way.
pub fn import(
    folder: &Path,
    model: &LearnedModel,
    options: &Options,
) -> Result<RecordingImport, RecordingFailure> {
    let mut pipeline = Pipeline::default();
    let analysis = pipeline.run(Pass::Read, || analyse(folder, options.force))?;
    let completed = pipeline.run(Pass::Complete, || {
        complete(model, &analysis.fit.grid, &defaults::gains())
    })?;
    let (whole, sources) = texture(&analysis, &completed, crc32(&analysis));
    let ringing = match whole.grid.numerator {
        Numerator::Nyquist => Ringing::Stabilised,
        _ => Ringing::Refused,
    };
    let fail = |cause: PipelineError| RecordingFailure::Pipeline {
        folder: folder.to_owned(),
        cause,
    };
    let Imported {
        bytes,
        report,
        whole,
        ..
    } = pipeline
        .import(whole, &options.request, ringing, &Truth::Texture)
        .map_err(fail)?;
    Ok(RecordingImport {
        bytes,
        report,
        whole,
        analysis,
        completed,
        sources,
        pipeline,
    })
}

/// CRC-32 of all samples that were used.
fn crc32(analysis: &Analysis) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    for channel in &analysis.recording.channels {
        for sample in &channel.samples {
            hasher.update(&sample.to_le_bytes());
        }
    }
    hasher.finalize()
}

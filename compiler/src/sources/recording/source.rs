//! A folder of sensor files as a source.

use super::{
    analyse::{Analysis, analyse},
    complete::{Completed, complete},
    report,
    sheet::sheet,
    texture::{Parts, texture},
};
use crate::{
    compiled::{Compiled, ErrorReference},
    passes::reduce::Fidelity,
    pipeline::{Pass, Pipeline, Request, Ringing},
    sources::{Findings, ManifestSource, Operand, Source, SourceKind, SourceOutput, Tools, key},
};
use asperity_io::diagnostic::Failure;
use asperity_plot::PlotError;
use asperity_recording::check::Severity;
use asperity_texture::model::{Numerator, defaults};
use serde_json::Value;
use std::{path::PathBuf, sync::Arc};

/// A recording: sensor files of a tool on a surface. The rate of the analysis is 1 kHz.
#[derive(Debug, Clone)]
pub struct RecordingFolder {
    /// The folder.
    pub folder: PathBuf,
    /// True if faults of the recording are ignored.
    pub force: bool,
}

/// `recording` of a manifest.
pub const KIND: SourceKind = SourceKind {
    key: "recording",
    operand: Operand::Folder,
    open: |stated| {
        Ok(Arc::new(RecordingFolder {
            folder: stated.path.to_owned(),
            force: false,
        }))
    },
    options: &[],
    refuses: &["texture", "seed", "edit"],
    fidelity: Fidelity::Full,
    preview: false,
};

impl Source for RecordingFolder {
    fn needs_model(&self) -> bool {
        true
    }

    fn origin(&self) -> String {
        self.folder.display().to_string()
    }

    fn inputs(&self) -> Vec<PathBuf> {
        let entries = std::fs::read_dir(&self.folder).into_iter().flatten();
        let files = entries.filter_map(|entry| Some(entry.ok()?.path()));
        let mut files: Vec<PathBuf> = files.filter(|path| path.is_file()).collect();
        files.sort();
        files
    }

    fn model(
        &self,
        _: &Request,
        tools: &Tools<'_>,
        pipeline: &mut Pipeline,
    ) -> Result<SourceOutput, Failure> {
        let model = tools.model()?;
        let analysis = analyse(&self.folder, self.force, pipeline)?;
        let completed = pipeline.run(Pass::Complete, || {
            complete(model, &analysis.fit.grid, &defaults::gains())
        })?;
        let (texture, parts) = texture(&analysis, &completed, crc32(&analysis));
        let ringing = match texture.grid.numerator {
            Numerator::Nyquist => Ringing::Stabilised,
            _ => Ringing::Refused,
        };
        let warnings = analysis
            .checked
            .at_least(Severity::Warning)
            .map(|finding| format!("{} {}: {}", finding.file, finding.channel, finding.what));
        Ok(SourceOutput {
            truth: Some(ErrorReference::Texture),
            ringing,
            warnings: warnings.collect(),
            findings: Some(Arc::new(Recorded {
                analysis,
                completed,
                parts,
            })),
            ..SourceOutput::new(texture)
        })
    }
}

impl ManifestSource for RecordingFolder {
    fn key(&self, parts: key::Parts, _: &Tools<'_>) -> Result<key::Parts, Failure> {
        let parts = parts.part(&[self.force.into()]);
        let mut files = self.inputs().into_iter();
        Ok(files.try_fold(parts, |parts, file| parts.stream(&file))?)
    }
}

/// Findings from a recording.
#[derive(Debug)]
pub struct Recorded {
    /// Analysis of the sensor data.
    pub analysis: Analysis,
    /// Completion by the learned model.
    pub completed: Completed,
    /// Where each part comes from.
    pub parts: Parts,
}

impl Findings for Recorded {
    fn text(&self, compiled: &Compiled) -> String {
        report::text(self, compiled)
    }

    fn json(&self, compiled: &Compiled) -> Value {
        report::json(self, compiled)
    }

    fn sheet(&self, compiled: &Compiled) -> Result<Option<Vec<u8>>, PlotError> {
        sheet(self, &compiled.whole).map(Some)
    }
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

//! The files that a command writes of one texture.

use asperity::{
    model::TextureModel,
    pipeline::{Pass, Pipeline},
    sources::model_file,
};
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Failures, one},
    output::{OutputError, OutputId, Outputs},
};
use std::path::{Path, PathBuf};

/// An asset and what a user wants beside it: written together, or not at all.
pub(super) struct TextureOutputs {
    outputs: Outputs,
    asset: OutputId,
    model: Option<OutputId>,
    contents: Vec<(OutputId, Vec<u8>)>,
}

impl TextureOutputs {
    /// Opens the asset and, where a user wants it, the intermediate model, for a command that
    /// reads `inputs`.
    pub(super) fn open(
        inputs: &[PathBuf],
        asset: &Path,
        model: Option<&Path>,
    ) -> Result<Self, Failures> {
        let mut outputs = Outputs::beside(inputs);
        Ok(Self {
            asset: outputs.open(asset).map_err(one)?,
            model: outputs.open_if(model).map_err(one)?,
            outputs,
            contents: Vec::new(),
        })
    }

    /// Opens another file that a user may want.
    pub(super) fn open_if(&mut self, path: Option<&Path>) -> Result<Option<OutputId>, Failures> {
        self.outputs.open_if(path).map_err(one)
    }

    /// The console of a command with these outputs.
    pub(super) fn console(&self, console: Console) -> Console {
        console.beside(&self.outputs)
    }

    /// Takes the intermediate model, if a user wants it.
    pub(super) fn model(&mut self, whole: &TextureModel) {
        if let Some(file) = self.model {
            self.beside(file, model_file::to_json(whole));
        }
    }

    /// Takes the bytes of another file.
    pub(super) fn beside(&mut self, file: OutputId, bytes: Vec<u8>) {
        self.contents.push((file, bytes));
    }

    /// Writes all of them.
    pub(super) fn write(self, asset: &[u8], pipeline: &mut Pipeline) -> Result<(), Failures> {
        pipeline
            .run(Pass::Write, || self.commit(asset))
            .map_err(one)
    }

    fn commit(mut self, asset: &[u8]) -> Result<(), OutputError> {
        self.outputs.fill(self.asset, asset)?;
        for (file, bytes) in &self.contents {
            self.outputs.fill(*file, bytes)?;
        }
        self.outputs.commit()
    }
}

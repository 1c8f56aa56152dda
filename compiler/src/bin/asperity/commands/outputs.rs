//! The files that a command writes of one texture.

use crate::failure::{Failures, one};
use asperity::{model::TextureModel, model_file, output, pipeline::Pipeline};
use std::path::Path;

/// An asset and what a user wants beside it: written together, or not at all.
pub(super) struct Outputs<'a> {
    asset: &'a Path,
    model: Option<&'a Path>,
    beside: Vec<(&'a Path, Vec<u8>)>,
}

impl<'a> Outputs<'a> {
    /// The asset alone.
    pub(super) fn new(asset: &'a Path) -> Self {
        Self {
            asset,
            model: None,
            beside: Vec::new(),
        }
    }

    /// The asset and, where a user wants it, the intermediate model.
    pub(super) fn with_model(asset: &'a Path, model: Option<&'a Path>) -> Self {
        Self {
            model,
            ..Self::new(asset)
        }
    }

    /// Refuses outputs that are inputs, or each other. `more` are outputs besides asset and model.
    pub(super) fn check(&self, inputs: &[&Path], more: Option<&Path>) -> Result<(), Failures> {
        let outputs: Vec<&Path> = [self.asset]
            .into_iter()
            .chain(self.model)
            .chain(more)
            .collect();
        output::distinct(inputs, &outputs).map_err(one)
    }

    /// Takes the intermediate model, if a user wants it.
    pub(super) fn model(&mut self, whole: &TextureModel) {
        if let Some(file) = self.model {
            self.beside(file, model_file::to_json(whole));
        }
    }

    /// Takes another file.
    pub(super) fn beside(&mut self, file: &'a Path, bytes: Vec<u8>) {
        self.beside.push((file, bytes));
    }

    /// Writes all of them.
    pub(super) fn write(&self, asset: &[u8], pipeline: &mut Pipeline) -> Result<(), Failures> {
        let beside = self.beside.iter().map(|(file, bytes)| (*file, &bytes[..]));
        let files: Vec<(&Path, &[u8])> = [(self.asset, asset)].into_iter().chain(beside).collect();
        pipeline.write(&files).map_err(one)
    }
}

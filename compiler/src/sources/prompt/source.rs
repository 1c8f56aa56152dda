//! A prompt as a source, and with a picture that was made elsewhere.

use super::check;
use crate::{
    driver::Failure,
    passes::reduce::Fidelity,
    pipeline::{Pipeline, Request},
    sources::{Kind, Operand, Source, Sourced, Tools, key::Parts},
};
use std::sync::Arc;

/// A prompt and a seed.
#[derive(Debug, Clone)]
pub struct Prompt {
    /// What the texture is to feel like.
    pub text: String,
    /// 0 for the texture that the prompt means. Other seeds give variations of it, as another
    /// piece of the same material varies.
    pub seed: u64,
}

/// `prompt` of a manifest.
pub const KIND: Kind = Kind {
    key: "prompt",
    operand: Operand::Text,
    open: |stated| {
        check(stated.text)?;
        Ok(Arc::new(Prompt {
            text: stated.text.trim().to_owned(),
            seed: stated.seed,
        }))
    },
    refuses: &["texture"],
    fidelity: Fidelity::Auto,
    preview: true,
};

impl Source for Prompt {
    fn needs_model(&self) -> bool {
        true
    }

    fn prompt(&self) -> Option<&str> {
        Some(&self.text)
    }

    fn key(&self, parts: Parts, _: &Tools<'_>) -> Result<Parts, Failure> {
        Ok(parts.text(&self.text).part(&self.seed.to_le_bytes()))
    }

    fn read(
        &self,
        _: &Request,
        tools: &Tools<'_>,
        pipeline: &mut Pipeline,
    ) -> Result<Sourced, Failure> {
        check(&self.text)?;
        Ok(tools.author()?.sourced(&self.text, self.seed, pipeline)?)
    }
}

/// A source whose asset holds a picture that was made elsewhere. Its notes say what made it:
/// `by diffusion: …`.
#[derive(Debug)]
pub struct Illustrated<'a> {
    /// The source.
    pub source: &'a dyn Source,
    /// The picture.
    pub png: Vec<u8>,
    /// What made it.
    pub made: String,
}

impl Source for Illustrated<'_> {
    fn origin(&self) -> String {
        self.source.origin()
    }

    fn read(
        &self,
        request: &Request,
        tools: &Tools<'_>,
        pipeline: &mut Pipeline,
    ) -> Result<Sourced, Failure> {
        let mut sourced = self.source.read(request, tools, pipeline)?;
        let notes = &mut sourced.texture.provenance.notes;
        *notes = format!("{notes} Preview {}.", self.made).trim().to_owned();
        sourced.picture = Some(self.png.clone());
        Ok(sourced)
    }
}

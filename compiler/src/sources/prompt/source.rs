//! A prompt as a source.

use super::check;
use crate::{
    passes::reduce::Fidelity,
    pipeline::{Pipeline, Request},
    sources::{ManifestSource, Operand, Source, SourceKind, SourceOutput, Tools, key::Parts},
};
use asperity_io::diagnostic::Failure;
use std::sync::Arc;

/// A prompt and a seed.
#[derive(Debug, Clone)]
pub struct Prompt {
    /// Description of the feel.
    pub text: String,
    /// 0 for the texture that the prompt means. Other seeds give variations of it, as another
    /// piece of the same material varies.
    pub seed: u64,
    /// A picture that was made elsewhere, in the place of a preview.
    pub picture: Option<Picture>,
}

/// A picture of a prompt. The notes of the texture say what made it: `by diffusion: …`.
#[derive(Debug, Clone)]
pub struct Picture {
    /// The picture.
    pub png: Vec<u8>,
    /// Generator of the picture.
    pub made: String,
}

/// `prompt` of a manifest.
pub const KIND: SourceKind = SourceKind {
    key: "prompt",
    operand: Operand::Text,
    open: |stated| {
        check(stated.text)?;
        Ok(Arc::new(Prompt {
            text: stated.text.trim().to_owned(),
            seed: stated.seed,
            picture: None,
        }))
    },
    options: &[],
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

    fn model(
        &self,
        _: &Request,
        tools: &Tools<'_>,
        pipeline: &mut Pipeline,
    ) -> Result<SourceOutput, Failure> {
        check(&self.text)?;
        let prompt_compiler = tools.prompt_compiler()?;
        let mut sourced = prompt_compiler.sourced(&self.text, self.seed, pipeline)?;
        if let Some(Picture { png, made }) = &self.picture {
            let notes = &mut sourced.texture.provenance.notes;
            *notes = format!("{notes} Preview {made}.").trim().to_owned();
            sourced.picture = Some(png.clone());
        }
        Ok(sourced)
    }
}

impl ManifestSource for Prompt {
    fn key(&self, parts: Parts, _: &Tools<'_>) -> Result<Parts, Failure> {
        Ok(parts.text(&self.text).part(&self.seed.to_le_bytes()))
    }
}

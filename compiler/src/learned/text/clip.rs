//! CLIP's text tower from a user's own ONNX export: 77 tokens, any width.
//!
//! The weights of CLIP are not shipped. A folder holds `text_model.onnx` or `model.onnx`, with an
//! input of ids, int32 or int64 `[1, 77]`, possibly an attention mask of the same shape, and an
//! output `[1, width]`. Where there are several outputs, it is `text_embeds`.

use super::encoder::{Encoded, TextEncoder, failed, signature, unit};
use crate::learned::inference::Backend;
use asperity_io::{
    diagnostic::Fault,
    input::{self, InputKind},
};
use asperity_model::CLIP_MERGES;
use asperity_nn::{Dim, ElementType, Port, Session, Tensor};
use instant_clip_tokenizer::Tokenizer;
use std::path::{Path, PathBuf};

/// Tokens that CLIP reads, start and end marks included; shorter texts are padded.
pub const CONTEXT: usize = 77;
/// Tokens of the vocabulary.
const VOCABULARY: u16 = 49_408;
/// File names that are looked for, in this order.
pub const FILES: [&str; 2] = ["text_model.onnx", "model.onnx"];
/// Outputs that are preferred, in this order.
const OUTPUTS: [&str; 3] = ["text_embeds", "embedding", "pooler_output"];

/// The encoder on a back end.
pub struct Clip {
    session: Box<dyn Session>,
    tokeniser: Tokenizer,
    ids: Port,
    mask: Option<Port>,
    output: String,
    width: usize,
}

impl Clip {
    /// Opens the export in a folder.
    ///
    /// # Errors
    /// [`Fault`] when there is none, or it is no text tower.
    pub fn open(folder: &Path, backend: &Backend) -> Result<Self, Fault> {
        let file = find(folder).ok_or_else(|| {
            let [one, other] = FILES;
            failed(format_args!(
                "{}: neither {one} nor {other} in it",
                folder.display()
            ))
        })?;
        let network = |message: String| failed(format_args!("{}: {message}", file.display()));
        let bytes = input::read(&file, InputKind::TextEncoder)
            .map_err(|problem| network(format!("{problem}; {}", problem.remedy())))?;
        Self::new(backend.session(bytes.into()).map_err(network)?)
    }

    /// An encoder of a loaded text tower.
    ///
    /// # Errors
    /// [`Fault`] for other inputs or outputs than a text tower's.
    pub fn new(session: Box<dyn Session>) -> Result<Self, Fault> {
        // A vocabulary that is only as long as CLIP reads it: the tokenizer's own is five times so.
        let tokeniser =
            Tokenizer::with_vocabulary(CLIP_MERGES.as_bytes(), VOCABULARY).map_err(failed)?;
        let is_ids = |port: &&Port| {
            matches!(port.element_type, ElementType::I64 | ElementType::I32)
                && !port.name.contains("mask")
        };
        let inputs = session.inputs();
        let listed = |ports: &[Port]| {
            let names: Vec<&str> = ports.iter().map(|port| port.name.as_str()).collect();
            names.join(", ")
        };
        let ids = inputs.iter().find(is_ids).cloned().ok_or_else(|| {
            let expected = "token ids, int32 or int64 [1, 77]";
            signature("inputs", &listed(inputs), expected)
        })?;
        let mask = inputs
            .iter()
            .find(|port| port.name.contains("mask"))
            .cloned();
        if inputs.len() > 1 + usize::from(mask.is_some()) {
            let expected = "token ids and at most a mask";
            return Err(signature("inputs", &listed(inputs), expected));
        }
        let outputs = session.outputs();
        let output = OUTPUTS
            .iter()
            .find_map(|name| outputs.iter().find(|port| port.name == *name))
            .or_else(|| outputs.iter().find(|port| is_vector(port)))
            .ok_or_else(|| signature("outputs", &listed(outputs), "a vector [1, width]"))?
            .name
            .clone();
        let mut clip = Self {
            session,
            tokeniser,
            ids,
            mask,
            output,
            width: 0,
        };
        // Exports often leave the width open, so the network is asked.
        clip.width = clip.run(&clip.tokens("surface").0)?.len();
        Ok(clip)
    }

    /// The [`CONTEXT`] ids, how many of them are text and marks, and how many tokens were cut off.
    fn tokens(&self, text: &str) -> (Vec<i64>, usize, usize) {
        let mut found = Vec::new();
        self.tokeniser.encode(text, &mut found);
        let room = CONTEXT - 2;
        let cut = found.len().saturating_sub(room);
        found.truncate(room);
        let id = |token: instant_clip_tokenizer::Token| i64::from(token.to_u16());
        let mut ids = vec![id(self.tokeniser.start_of_text())];
        ids.extend(found.into_iter().map(id));
        ids.push(id(self.tokeniser.end_of_text()));
        let used = ids.len();
        // The tower reads its vector at the end mark, which has the largest id, and ignores padding.
        ids.resize(CONTEXT, 0);
        (ids, used, cut)
    }

    fn run(&self, ids: &[i64]) -> Result<Vec<f32>, Fault> {
        let used = 1 + ids.iter().rposition(|&id| id != 0).unwrap_or(0);
        let ones: Vec<i64> = (0..CONTEXT).map(|n| i64::from(n < used)).collect();
        let mut inputs = vec![(self.ids.name.as_str(), integers(&self.ids, ids))];
        if let Some(mask) = &self.mask {
            inputs.push((mask.name.as_str(), integers(mask, &ones)));
        }
        let inputs: Vec<(&str, &Tensor)> = inputs.iter().map(|(name, t)| (*name, t)).collect();
        let outputs = self.session.run(&inputs).map_err(failed)?;
        match outputs.into_iter().find(|(name, _)| *name == self.output) {
            Some((_, Tensor::F32 { shape, data }))
                if shape.first() == Some(&1) && shape.len() == 2 =>
            {
                Ok(data)
            }
            Some((name, other)) => {
                let found = format!("{:?}", other.shape());
                Err(signature(&name, &found, "f32 [1, width]"))
            }
            None => Err(failed(format_args!("no output {}", self.output))),
        }
    }
}

fn find(folder: &Path) -> Option<PathBuf> {
    FILES
        .iter()
        .map(|name| folder.join(name))
        .find(|file| file.is_file())
}

fn is_vector(port: &Port) -> bool {
    let one_row = |dims: &Vec<Dim>| dims.len() == 2;
    port.element_type == ElementType::F32 && port.dims.as_ref().is_some_and(one_row)
}

fn integers(port: &Port, values: &[i64]) -> Tensor {
    let shape = vec![1, values.len()];
    if port.element_type == ElementType::I32 {
        Tensor::I32 {
            shape,
            data: values.iter().map(|&value| value as i32).collect(),
        }
    } else {
        Tensor::I64 {
            shape,
            data: values.to_vec(),
        }
    }
}

impl TextEncoder for Clip {
    fn name(&self) -> &str {
        "clip"
    }

    fn width(&self) -> usize {
        self.width
    }

    fn encode(&self, text: &str) -> Result<Encoded, Fault> {
        let (ids, tokens, cut) = self.tokens(text);
        Ok(Encoded {
            vector: unit(self.run(&ids)?)?,
            tokens,
            cut,
        })
    }
}

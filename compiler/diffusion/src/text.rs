//! The text encoder: from tokens to the vectors that the UNet attends to.

use crate::{
    error::{DiffusionError, Problem},
    folder::TEXT_ENCODER,
    ports,
    tokenizer::CONTEXT,
};
use asperity_nn::{ElementType, Port, Session};

const IDS: &str = "input_ids";
const MASK: &str = "attention_mask";
const OUTPUT: &str = "last_hidden_state";

/// The text encoder of a folder.
pub(crate) struct TextEncoder {
    session: Box<dyn Session>,
    ids: Port,
    mask: Option<Port>,
    output: String,
}

/// [`CONTEXT`] vectors of one text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Embedding {
    pub(crate) width: usize,
    pub(crate) data: Vec<f32>,
}

impl TextEncoder {
    /// Checks the ports of a network.
    pub(crate) fn new(session: Box<dyn Session>) -> Result<Self, DiffusionError> {
        let (ids, mask, output) =
            signature(&*session).map_err(|problem| problem.of(TEXT_ENCODER))?;
        Ok(Self {
            session,
            ids,
            mask,
            output,
        })
    }

    /// The vectors of a text of [`CONTEXT`] ids.
    pub(crate) fn encode(&self, ids: &[i64]) -> Result<Embedding, DiffusionError> {
        self.run(ids).map_err(|problem| problem.of(TEXT_ENCODER))
    }

    fn run(&self, ids: &[i64]) -> Result<Embedding, Problem> {
        let shape = [1, CONTEXT];
        let tensor = ports::integers(&self.ids, &shape, ids);
        // The tower was trained without a mask: every token counts, padding too.
        let mask = self
            .mask
            .as_ref()
            .map(|port| ports::integers(port, &shape, &[1; CONTEXT]));
        let mut inputs = vec![(IDS, &tensor)];
        inputs.extend(mask.iter().map(|mask| (MASK, mask)));
        let when = || "of a text".to_owned();
        let (shape, data) = ports::run(&*self.session, &inputs, &self.output, when)?;
        match shape[..] {
            [1, CONTEXT, width] if width > 0 => Ok(Embedding { width, data }),
            _ => Err(Problem::Port {
                direction: "output",
                name: self.output.clone(),
                found: format!("float32 {shape:?}"),
                expected: format!("float32 [1, {CONTEXT}, width]"),
            }),
        }
    }
}

fn signature(session: &dyn Session) -> Result<(Port, Option<Port>, String), Problem> {
    let integers = [ElementType::I64, ElementType::I32];
    let ids = ports::input(session, IDS, &integers, &[2])?.clone();
    ports::no_others(session, &[IDS, MASK], "input_ids and attention_mask")?;
    let has_mask = session.inputs().iter().any(|port| port.name == MASK);
    let mask = match has_mask {
        true => Some(ports::input(session, MASK, &integers, &[2])?.clone()),
        false => None,
    };
    let output = ports::output(session, OUTPUT, 3)?.name.clone();
    Ok((ids, mask, output))
}

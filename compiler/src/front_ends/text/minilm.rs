//! all-MiniLM-L6-v2: WordPiece tokens in lower case to a vector of 384 numbers.

use super::{
    encoder::{Encoded, TextEncoder, TextError, unit},
    vocabulary::Vocabulary,
    word_piece,
};
use asperity_nn::{Session, Tensor};

/// Width of its vectors.
pub const WIDTH: usize = 384;
/// Tokens it reads at most, `[CLS]` and `[SEP]` included.
pub const MAX_TOKENS: usize = 128;

/// The encoder on a back end.
pub struct MiniLm {
    session: Box<dyn Session>,
    vocabulary: Vocabulary,
}

impl MiniLm {
    /// An encoder of its network and its vocabulary.
    #[must_use]
    pub fn new(session: Box<dyn Session>, vocabulary: Vocabulary) -> Self {
        Self {
            session,
            vocabulary,
        }
    }

    /// Token ids of a text, at most [`MAX_TOKENS`], and how many were cut off.
    ///
    /// # Errors
    /// [`TextError::Tokeniser`] when the vocabulary lacks the marks.
    pub fn tokens(&self, text: &str) -> Result<(Vec<i64>, usize), TextError> {
        let lacking = |name: &str| TextError::Tokeniser(format!("no {name} in the vocabulary"));
        let mark = |name: &str| {
            let id = self.vocabulary.id("", name).ok_or_else(|| lacking(name))?;
            Ok::<i64, TextError>(id.into())
        };
        let mut ids = vec![mark("[CLS]")?];
        word_piece::encode(text, &self.vocabulary, &mut ids).ok_or_else(|| lacking("[UNK]"))?;
        let cut = (ids.len() + 1).saturating_sub(MAX_TOKENS);
        ids.truncate(MAX_TOKENS - 1);
        ids.push(mark("[SEP]")?);
        Ok((ids, cut))
    }
}

impl TextEncoder for MiniLm {
    fn name(&self) -> &str {
        "minilm"
    }

    fn width(&self) -> usize {
        WIDTH
    }

    fn reads(&self, word: &str) -> bool {
        let unknown = self.vocabulary.id("", word_piece::UNKNOWN).map(i64::from);
        self.tokens(word)
            .is_ok_and(|(ids, _)| !ids.iter().any(|id| Some(*id) == unknown))
    }

    fn encode(&self, text: &str) -> Result<Encoded, TextError> {
        let (ids, cut) = self.tokens(text)?;
        let tokens = ids.len();
        let input = Tensor::I64 {
            shape: vec![1, tokens],
            data: ids,
        };
        let outputs = self
            .session
            .run(&[("input_ids", &input)])
            .map_err(|error| TextError::Network(error.to_string()))?;
        match outputs.into_iter().next() {
            Some((_, Tensor::F32 { data, .. })) if data.len() == WIDTH => Ok(Encoded {
                vector: unit(data)?,
                tokens,
                cut,
            }),
            Some((name, other)) => Err(TextError::Signature {
                field: name,
                found: format!("{:?}", other.shape()),
                expected: format!("f32 [1, {WIDTH}]"),
            }),
            None => Err(TextError::Network("no output".into())),
        }
    }
}

//! all-MiniLM-L6-v2: WordPiece tokens in lower case to a vector of 384 numbers.

use super::encoder::{Encoded, TextEncoder, TextError, unit};
use asperity_nn::{Session, Tensor};
use rten_text::{
    models::{Model as _, WordPiece, WordPieceOptions},
    normalizers::{self, BertOptions, Normalizer as _},
    pre_tokenizers::{self, PreTokenizer as _},
};

/// Width of its vectors.
pub const WIDTH: usize = 384;
/// Tokens it reads at most, `[CLS]` and `[SEP]` included.
pub const MAX_TOKENS: usize = 128;

/// The encoder on a back end.
pub struct MiniLm {
    session: Box<dyn Session>,
    // These are the parts of `rten_text::Tokenizer`, which threads cannot share.
    normaliser: normalizers::Bert,
    words: pre_tokenizers::Bert,
    pieces: WordPiece,
}

impl MiniLm {
    /// An encoder of its network and its vocabulary, which has one word piece a line.
    #[must_use]
    pub fn new(session: Box<dyn Session>, vocabulary: &str) -> Self {
        let vocabulary = vocabulary
            .lines()
            .enumerate()
            .map(|(id, piece)| (piece.to_owned(), id as u32))
            .collect();
        Self {
            session,
            normaliser: normalizers::Bert::new(BertOptions {
                lowercase: true,
                strip_accents: true,
            }),
            words: pre_tokenizers::Bert::new(),
            pieces: WordPiece::from_vocab(vocabulary, WordPieceOptions::default()),
        }
    }

    /// Token ids of a text, at most [`MAX_TOKENS`], and how many were cut off.
    ///
    /// # Errors
    /// [`TextError::Tokeniser`] when the vocabulary lacks the marks.
    pub fn tokens(&self, text: &str) -> Result<(Vec<i64>, usize), TextError> {
        let failed = |error: &dyn std::fmt::Display| TextError::Tokeniser(error.to_string());
        let mark = |name: &str| {
            self.pieces
                .get_token_id(name)
                .map(i64::from)
                .ok_or_else(|| failed(&format!("no {name} in the vocabulary")))
        };
        let (normal, _) = self.normaliser.normalize(text).map_err(|e| failed(&e))?;
        let mut ids = vec![mark("[CLS]")?];
        for word in self.words.pre_tokenize(&normal).map_err(|e| failed(&e))? {
            self.pieces
                .encode_with_offsets(word, &mut |_, id| ids.push(i64::from(id)))
                .map_err(|e| failed(&e))?;
        }
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
        let unknown = self.pieces.get_token_id("[UNK]").map(i64::from);
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

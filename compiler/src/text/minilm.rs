//! all-MiniLM-L6-v2: 384 numbers a sentence, WordPiece tokens, lower case.

use super::{Encoded, TextEncoder, TextError, unit};
use asperity_nn::{Session, Tensor};
use rten_text::{
    Tokenizer,
    models::{WordPiece, WordPieceOptions},
    normalizers::{Bert, BertOptions},
    pre_tokenizers,
    tokenizer::TokenizerOptions,
};

/// Width of its vectors.
pub const WIDTH: usize = 384;
/// Tokens it reads at most, `[CLS]` and `[SEP]` included.
pub const MAX_TOKENS: usize = 128;

/// The encoder over a back end.
pub struct MiniLm {
    session: Box<dyn Session>,
    tokeniser: Tokenizer,
}

impl MiniLm {
    /// An encoder from its network and its vocabulary, one word piece a line.
    #[must_use]
    pub fn new(session: Box<dyn Session>, vocabulary: &str) -> Self {
        let vocabulary = vocabulary
            .lines()
            .enumerate()
            .map(|(id, piece)| (piece.to_owned(), id as u32))
            .collect();
        let normaliser = Bert::new(BertOptions {
            lowercase: true,
            strip_accents: true,
        });
        let options = TokenizerOptions {
            cls_token: Some("[CLS]"),
            sep_token: Some("[SEP]"),
        };
        let pieces = WordPiece::from_vocab(vocabulary, WordPieceOptions::default());
        Self {
            session,
            tokeniser: Tokenizer::new(pieces, options)
                .with_normalizer(Box::new(normaliser))
                .with_pre_tokenizer(Box::new(pre_tokenizers::Bert::new())),
        }
    }

    /// Token ids of a text and how many were cut off.
    ///
    /// # Errors
    /// [`TextError::Tokeniser`] when the vocabulary lacks the marks.
    pub fn tokens(&self, text: &str) -> Result<(Vec<i64>, usize), TextError> {
        let encoded = self
            .tokeniser
            .encode(text, None)
            .map_err(|error| TextError::Tokeniser(error.to_string()))?;
        let mut ids: Vec<i64> = encoded.token_ids().iter().map(|&id| i64::from(id)).collect();
        let cut = ids.len().saturating_sub(MAX_TOKENS);
        if let (Some(&end), true) = (ids.last(), cut > 0) {
            ids.truncate(MAX_TOKENS - 1);
            ids.push(end);
        }
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

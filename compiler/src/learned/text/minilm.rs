//! all-MiniLM-L6-v2: WordPiece tokens in lower case to a vector of 384 numbers.

use super::{
    Vocabulary,
    encoder::{Encoded, TextEncoder, failed, signature, unit},
};
use asperity_io::diagnostic::Fault;
use asperity_nn::{Session, Tensor};
use unicode_categories::UnicodeCategories as _;
use unicode_normalization::char::decompose_canonical;

/// Width of its vectors.
pub const WIDTH: usize = 384;
/// Tokens it reads at most, `[CLS]` and `[SEP]` included.
pub const MAX_TOKENS: usize = 128;
/// Tokens of a batch at most: what they come to in the network stays in the second-level cache.
const BATCH_TOKENS: usize = 128;

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
    /// [`Fault`] when the vocabulary lacks the marks.
    pub fn tokens(&self, text: &str) -> Result<(Vec<i64>, usize), Fault> {
        let [start, end] = marks(&self.vocabulary)?;
        let mut ids = vec![start];
        ids.extend(pieces(text, &self.vocabulary)?);
        let cut = (ids.len() + 1).saturating_sub(MAX_TOKENS);
        ids.truncate(MAX_TOKENS - 1);
        ids.push(end);
        Ok((ids, cut))
    }
}

fn lacking(name: &str) -> Fault {
    let what = format!("tokeniser: no {name} in the vocabulary");
    Fault::new(what, "try other words")
}

/// The ids of the marks before and behind a text.
pub(super) fn marks(vocabulary: &Vocabulary) -> Result<[i64; 2], Fault> {
    let mark = |name: &str| vocabulary.id("", name).ok_or_else(|| lacking(name));
    Ok([mark("[CLS]")?.into(), mark("[SEP]")?.into()])
}

/// The ids of a text's pieces, without marks.
pub(super) fn pieces(text: &str, vocabulary: &Vocabulary) -> Result<Vec<i64>, Fault> {
    let mut ids = Vec::new();
    encode(text, vocabulary, &mut ids).ok_or_else(|| lacking(UNKNOWN))?;
    Ok(ids)
}

impl TextEncoder for MiniLm {
    fn name(&self) -> &str {
        "minilm"
    }

    fn width(&self) -> usize {
        WIDTH
    }

    fn reads(&self, word: &str) -> bool {
        let unknown = self.vocabulary.id("", UNKNOWN).map(i64::from);
        let mut ids = Vec::new();
        encode(word, &self.vocabulary, &mut ids).is_some()
            && !ids.iter().any(|id| Some(*id) == unknown)
    }

    fn encode(&self, text: &str) -> Result<Encoded, Fault> {
        let mut encoded = self.encode_all(&[text])?;
        encoded.pop().ok_or_else(|| failed("no output"))
    }

    fn encode_all(&self, texts: &[&str]) -> Result<Vec<Encoded>, Fault> {
        let read: Result<Vec<_>, Fault> = texts.iter().map(|text| self.tokens(text)).collect();
        let read = read?;
        // Without padding, texts of one length make a batch.
        let mut order: Vec<usize> = (0..texts.len()).collect();
        order.sort_by_key(|&text| read[text].0.len());
        let mut encoded: Vec<Option<Encoded>> = vec![None; texts.len()];
        for of_one_length in order.chunk_by(|&a, &b| read[a].0.len() == read[b].0.len()) {
            let tokens = read[of_one_length[0]].0.len();
            for batch in of_one_length.chunks((BATCH_TOKENS / tokens).max(1)) {
                let ids = batch.iter().flat_map(|&text| read[text].0.iter().copied());
                let vectors = self.run(batch.len(), tokens, ids.collect())?;
                for (&text, vector) in batch.iter().zip(vectors.chunks(WIDTH)) {
                    encoded[text] = Some(Encoded {
                        vector: unit(vector.to_vec())?,
                        tokens,
                        cut: read[text].1,
                    });
                }
            }
        }
        Ok(encoded.into_iter().flatten().collect())
    }
}

impl MiniLm {
    /// The vectors of a batch of texts of one length, one after the other.
    fn run(&self, texts: usize, tokens: usize, ids: Vec<i64>) -> Result<Vec<f32>, Fault> {
        let input = Tensor::I64 {
            shape: vec![texts, tokens],
            data: ids,
        };
        let outputs = self.session.run(&[("input_ids", &input)]).map_err(failed)?;
        match outputs.into_iter().next() {
            Some((_, Tensor::F32 { data, .. })) if data.len() == texts * WIDTH => Ok(data),
            Some((name, other)) => {
                let found = format!("{:?}", other.shape());
                Err(signature(&name, &found, &format!("f32 [{texts}, {WIDTH}]")))
            }
            None => Err(failed("no output")),
        }
    }
}

// BERT's tokens of a text, in lower case and without accents.

/// Characters of the longest word that is cut into pieces; a longer one is unknown.
const LONGEST_WORD: usize = 100;
/// Prefix of a piece inside a word.
const INSIDE: &str = "##";
/// The piece that stands for what no piece fits.
const UNKNOWN: &str = "[UNK]";

/// Appends the ids of a text, without marks for its start and end; `None` when the vocabulary
/// lacks the piece for the unknown.
fn encode(text: &str, vocabulary: &Vocabulary, ids: &mut Vec<i64>) -> Option<()> {
    let normal = normalised(text);
    let mut rest = normal.as_str();
    while let Some(first) = rest.chars().next() {
        let length = if stands_alone(first) {
            first.len_utf8()
        } else {
            rest.find(stands_alone).unwrap_or(rest.len())
        };
        let (word, after) = rest.split_at(length);
        if !first.is_whitespace() {
            encode_word(word, vocabulary, ids)?;
        }
        rest = after;
    }
    Some(())
}

/// A text character by character: decomposed, without nonspacing marks, in lower case.
fn normalised(text: &str) -> String {
    let mut normal = String::with_capacity(text.len());
    for character in text.chars() {
        decompose_canonical(character, |part| {
            if !part.is_mark_nonspacing() {
                normal.extend(part.to_lowercase());
            }
        });
    }
    normal
}

/// Returns true for white space, and for a character that ends a word and is a word of its own.
fn stands_alone(character: char) -> bool {
    character.is_ascii_punctuation() || character.is_punctuation() || character.is_whitespace()
}

/// Appends the longest pieces that a word begins with, one after the other, until the word is used
/// up or none fits.
fn encode_word(word: &str, vocabulary: &Vocabulary, ids: &mut Vec<i64>) -> Option<()> {
    let mut rest = word;
    let mut prefix = "";
    let short = word.chars().nth(LONGEST_WORD).is_none();
    while short && let Some((id, length)) = longest(prefix, rest, vocabulary) {
        ids.push(id);
        rest = &rest[length..];
        prefix = INSIDE;
    }
    if !rest.is_empty() {
        ids.push(vocabulary.id("", UNKNOWN)?.into());
    }
    Some(())
}

/// Id and bytes of the longest piece that `rest` begins with, of those with this prefix.
fn longest(prefix: &str, rest: &str, vocabulary: &Vocabulary) -> Option<(i64, usize)> {
    let ends = rest.char_indices().map(|(start, c)| start + c.len_utf8());
    ends.rev().find_map(|end| {
        let id = vocabulary.id(prefix, &rest[..end])?;
        Some((id.into(), end))
    })
}

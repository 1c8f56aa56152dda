//! States of words inside the embedded encoder, from which the reader tells their roles.

use super::{Vocabulary, encoder::failed, minilm};
use asperity_io::diagnostic::Fault;
use asperity_language::{roles, words::Token};
use asperity_nn::{Portable, Tensor};
use std::ops::Range;

/// The states behind layer 3 of 6 in the embedded encoder's graph.
const LAYER: &str = "t101";
/// Pieces of a window at most, its marks included.
const WINDOW: usize = 128;
/// Pieces that are read at most.
const MOST_PIECES: usize = 512;

/// The embedded encoder on the portable engine, as far as the states of its words.
#[derive(Clone, Copy)]
pub struct WordStates {
    network: Network,
    vocabulary: Vocabulary,
}

/// Gives the encoder, which it loads when it is first asked.
type Network = fn() -> Result<&'static Portable, String>;

impl roles::WordStates for WordStates {
    /// None where the network fails, which a test rules out for the embedded one.
    fn states(&self, tokens: &[Token]) -> Vec<Vec<f32>> {
        self.try_states(tokens).unwrap_or_default()
    }
}

impl WordStates {
    /// States of an encoder.
    #[must_use]
    pub fn new(network: Network, vocabulary: Vocabulary) -> Self {
        Self {
            network,
            vocabulary,
        }
    }

    /// The state of each token, the mean over its pieces. Tokens behind those that are read have none.
    ///
    /// # Errors
    /// [`Fault`] when the vocabulary or the network is not that of the embedded encoder.
    pub fn try_states(&self, tokens: &[Token]) -> Result<Vec<Vec<f32>>, Fault> {
        let network = (self.network)().map_err(failed)?;
        let [start, end] = minilm::marks(&self.vocabulary)?;
        let pieces = tokens.iter().map(|token| match token {
            Token::Word(word) => minilm::pieces(word, &self.vocabulary),
            Token::Break(mark) => minilm::pieces(mark.encode_utf8(&mut [0; 4]), &self.vocabulary),
        });
        let pieces: Vec<Vec<i64>> = pieces.collect::<Result<_, _>>()?;
        let mut states = Vec::with_capacity(tokens.len());
        let mut at = 0;
        let mut read = 0;
        while at < pieces.len() {
            let mut ids = vec![start];
            let mut spans = Vec::new();
            for pieces in &pieces[at..] {
                if ids.len() + pieces.len() + 1 > WINDOW {
                    break;
                }
                spans.push(ids.len()..ids.len() + pieces.len());
                ids.extend(pieces);
            }
            read += ids.len();
            if spans.is_empty() || read > MOST_PIECES {
                break;
            }
            ids.push(end);
            let input = Tensor::i64(&[1, ids.len()], ids);
            let inputs = [("input_ids", &input)];
            let layer = network.values(&inputs, &[LAYER]).map_err(failed)?;
            let rows = layer.first().and_then(Tensor::as_f32).unwrap_or_default();
            states.extend(spans.iter().map(|span| mean(rows, span)));
            at += spans.len();
        }
        Ok(states)
    }
}

/// The mean of rows.
fn mean(rows: &[f32], span: &Range<usize>) -> Vec<f32> {
    let mut sum = vec![0.0; minilm::WIDTH];
    for row in rows.chunks(minilm::WIDTH).take(span.end).skip(span.start) {
        sum.iter_mut().zip(row).for_each(|(sum, x)| *sum += x);
    }
    let count = span.len().max(1) as f32;
    sum.into_iter().map(|sum| sum / count).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learned::embedded;
    use asperity_language::words::normalise;

    /// Claim: every token has a state, up to the limit.
    #[test]
    fn tokens_have_states_up_to_the_limit() {
        let states = embedded::word_states();
        let few = normalise("wet gravel, and moss");
        let read = states.try_states(&few).expect("states");
        assert_eq!(read.len(), few.len());
        assert!(read.iter().all(|state| state.len() == roles::STATE));
        let many = normalise(&"wet gravel, and moss. ".repeat(200));
        let read = states.try_states(&many).expect("states");
        assert!(
            read.len() > 400 && read.len() <= MOST_PIECES,
            "{}",
            read.len()
        );
        assert!(states.try_states(&[]).expect("nothing").is_empty());
    }
}

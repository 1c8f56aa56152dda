//! Senses of words on no list: a tactile quality, or something that can be touched.
//!
//! Two logistic regressions on the rows of a [table of words](WordVectors), each scaled to
//! length one. `compiler/model/tools/export_reading.py` fits them, and prints how they do on words of no
//! list (`training/corpora/evaluation/touch_words.tsv`).

use crate::WordVectors;
use std::sync::LazyLock;

/// Lines `touch TAB thing`: the weights of a row, then the offsets.
const WEIGHTS: &str = include_str!("weights.tsv");

static MODEL: LazyLock<Vec<[f32; 2]>> = LazyLock::new(|| {
    let line = |line: &str| {
        let (touch, thing) = line.split_once('\t')?;
        Some([touch.parse().ok()?, thing.parse().ok()?])
    };
    WEIGHTS.lines().filter_map(line).collect()
});

/// Participles say how something feels on less evidence: "boiled", "ironed", "crumbling".
const PARTICIPLES: [(&str, f32); 2] = [("ed", -1.8), ("ing", -0.8)];

/// Sense of a word by the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Sense {
    /// True if the word says how something feels.
    pub(crate) touch: bool,
    /// True if the word names something that can be touched.
    pub(crate) thing: bool,
}

/// The sense of a word; neither for a word that is not in the table, unless it is a participle, which is
/// rather of a craft than of talk: "overstuffed", "limescaled".
pub(crate) fn sense(table: &impl WordVectors, word: &str) -> Sense {
    let ending = PARTICIPLES
        .iter()
        .find(|(ending, _)| word.len() > 4 && word.ends_with(ending));
    let (Some(row), Some((offsets, weights))) = (table.vector(word), MODEL.split_last()) else {
        return Sense {
            touch: ending.is_some_and(|(ending, _)| *ending == "ed"),
            thing: false,
        };
    };
    // Summed in order, so that every machine gives the same bits.
    let mut evidence = *offsets;
    for (weights, x) in weights.iter().zip(&row) {
        evidence[0] += weights[0] * x;
        evidence[1] += weights[1] * x;
    }
    Sense {
        touch: evidence[0] > ending.map_or(0.0, |(_, least)| *least),
        thing: evidence[1] > 0.0,
    }
}

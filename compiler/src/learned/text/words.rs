//! A second view of a text: the words by themselves, from a table made ahead of time.
//!
//! A sentence encoder reads the whole text, and knows little of rare words. The table knows words
//! from a dictionary and from what they stand beside in English. The vector of a text holds both:
//! `[√s·e, √(1 − s)·w]`, e the sentence encoder's and w the sum of the rows of its words, scaled
//! to length one. Its cosine with another is then a mean of both views' cosines. Where no word is
//! in the table, e alone is left.

use super::{
    Vocabulary,
    encoder::{Encoded, TextEncoder, unit},
};
use asperity_io::diagnostic::Fault;
use asperity_language::WordVectors;
use std::borrow::Cow;

/// Share s of the sentence encoder in a cosine.
const SENTENCE: f32 = 0.43;
/// Endings that a word may lose, and what stands in their place: first those that any noun or verb may have.
const ENDINGS: [(&str, &str); 11] = [
    ("ies", "y"),
    ("es", ""),
    ("s", ""),
    ("ed", ""),
    ("ed", "e"),
    ("ing", ""),
    ("ing", "e"),
    ("ier", "y"),
    ("er", ""),
    ("est", ""),
    ("y", ""),
];

/// Number of leading entries that apply to any noun or verb.
const INFLECTIONS: usize = 7;

/// Vectors of words, in 8 bits.
#[derive(Debug, Clone, Copy)]
pub struct WordTable {
    rows: Vocabulary,
    codes: &'static [u8],
    width: usize,
    count: usize,
}

impl WordTable {
    /// A table of `rows`, lines `word TAB row`, and of `bytes`: `width` codes (int8) of each row,
    /// then a scale (float32, little-endian) of each.
    ///
    /// # Errors
    /// [`Fault`] when the bytes do not divide into rows.
    pub fn new(rows: Vocabulary, bytes: &'static [u8], width: usize) -> Result<Self, Fault> {
        let count = bytes.len() / (width + size_of::<f32>());
        if width == 0 || bytes.len() != count * (width + size_of::<f32>()) {
            let count = bytes.len();
            let what = format!("table of words: {count} bytes are no whole number of rows");
            let remedy = "take the table and its width from the same package";
            return Err(Fault::new(what, remedy));
        }
        Ok(Self {
            rows,
            codes: bytes,
            width,
            count,
        })
    }

    /// The row of a word as it stands, or of the same word without one of these endings.
    fn row(&self, word: &str, endings: &[(&str, &str)]) -> Option<usize> {
        let found = |word: &str| {
            let row = self.rows.id("", word)? as usize;
            (row < self.count).then_some(row)
        };
        found(word).or_else(|| {
            endings.iter().find_map(|(ending, instead)| {
                let stem = word.strip_suffix(ending).filter(|stem| stem.len() > 2)?;
                found(&format!("{stem}{instead}"))
            })
        })
    }

    /// Adds the row of a word to a sum; false where there is none.
    fn add(&self, word: &str, sum: &mut [f32]) -> bool {
        let Some(row) = self.row(word, &ENDINGS) else {
            return false;
        };
        let at = self.count * self.width + row * size_of::<f32>();
        let scale = self.codes[at..].first_chunk().copied().unwrap_or_default();
        let scale = f32::from_le_bytes(scale);
        let codes = &self.codes[row * self.width..(row + 1) * self.width];
        for (sum, &code) in sum.iter_mut().zip(codes) {
            *sum += scale * f32::from(code.cast_signed());
        }
        true
    }
}

impl WordVectors for WordTable {
    /// "gravier" is no gravy.
    fn holds(&self, word: &str) -> bool {
        self.row(word, &ENDINGS[..INFLECTIONS]).is_some()
    }

    fn vector(&self, text: &str) -> Option<Vec<f32>> {
        let mut sum = vec![0.0; self.width];
        let text = text.to_lowercase();
        let mut any = false;
        for word in words(&text) {
            any |= self.add(&word, &mut sum);
        }
        any.then(|| unit(sum).ok()).flatten()
    }
}

/// Letters and digits of a lower-case text; a genitive's ending is left out.
fn words(text: &str) -> impl Iterator<Item = Cow<'_, str>> {
    let whole = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '\'' || c == '’'));
    whole
        .map(|word| word.split(['\'', '’']).next().unwrap_or_default())
        .filter(|word| !word.is_empty())
        .map(Cow::Borrowed)
}

/// A sentence encoder with a table of words beside it.
pub struct WithWords<E> {
    sentence: E,
    table: WordTable,
    name: String,
}

impl<E: TextEncoder> WithWords<E> {
    /// Both views in one.
    #[must_use]
    pub fn new(sentence: E, table: WordTable) -> Self {
        let name = format!("{}+words", sentence.name());
        Self {
            sentence,
            table,
            name,
        }
    }

    /// The sentence encoder.
    #[must_use]
    pub fn sentence(&self) -> &E {
        &self.sentence
    }
}

impl<E: TextEncoder> TextEncoder for WithWords<E> {
    fn name(&self) -> &str {
        &self.name
    }

    fn width(&self) -> usize {
        self.sentence.width() + self.table.width
    }

    fn reads(&self, word: &str) -> bool {
        self.sentence.reads(word)
    }

    fn encode(&self, text: &str) -> Result<Encoded, Fault> {
        self.with_words(text, self.sentence.encode(text)?)
    }

    fn encode_all(&self, texts: &[&str]) -> Result<Vec<Encoded>, Fault> {
        let encoded = self.sentence.encode_all(texts)?;
        let pairs = texts.iter().zip(encoded);
        pairs
            .map(|(text, encoded)| self.with_words(text, encoded))
            .collect()
    }
}

impl<E: TextEncoder> WithWords<E> {
    /// Both views of a text, given the sentence encoder's.
    fn with_words(&self, text: &str, mut encoded: Encoded) -> Result<Encoded, Fault> {
        match self.table.vector(text) {
            Some(words) => {
                let of_sentence = SENTENCE.sqrt();
                let of_words = (1.0 - SENTENCE).sqrt();
                encoded.vector.iter_mut().for_each(|x| *x *= of_sentence);
                encoded.vector.extend(words.iter().map(|x| x * of_words));
                // Rounding alone: both parts have length one.
                encoded.vector = unit(encoded.vector)?;
            }
            None => encoded.vector.resize(self.width(), 0.0),
        }
        Ok(encoded)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: &str = "rough\t1\nwool\t0\n";

    fn table() -> WordTable {
        let mut bytes = vec![100, 0, 0, 100_i8.cast_unsigned()];
        bytes.extend(0.01_f32.to_le_bytes());
        bytes.extend(0.03_f32.to_le_bytes());
        WordTable::new(Vocabulary::new(ROWS), bytes.leak(), 2).expect("two rows")
    }

    #[test]
    fn rows_add_up_by_their_scales() {
        let vector = table().vector("Rough wool's").expect("both words");
        assert!((vector[1] / vector[0] - 3.0).abs() < 1e-5, "{vector:?}");
        assert_eq!(
            table().vector("rougher wools"),
            table().vector("rough wool")
        );
        assert_eq!(table().vector("granite"), None);
    }

    #[test]
    fn bytes_that_are_no_table_are_refused() {
        assert!(WordTable::new(Vocabulary::new(ROWS), &[1, 2, 3], 2).is_err());
        assert!(WordTable::new(Vocabulary::new(ROWS), &[], 0).is_err());
    }

    struct Constant;

    impl TextEncoder for Constant {
        fn name(&self) -> &str {
            "constant"
        }
        fn width(&self) -> usize {
            1
        }
        fn encode(&self, _: &str) -> Result<Encoded, Fault> {
            Ok(Encoded {
                vector: vec![1.0],
                tokens: 1,
                cut: 0,
            })
        }
    }

    #[test]
    fn both_views_share_a_cosine() {
        let encoder = WithWords::new(Constant, table());
        assert_eq!((encoder.name(), encoder.width()), ("constant+words", 3));
        let vector = |text: &str| encoder.encode(text).expect("a vector").vector;
        let dot = |x: &[f32], y: &[f32]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f32>();
        // Words at a right angle leave what the sentences share.
        assert!((dot(&vector("wool"), &vector("rough")) - SENTENCE).abs() < 1e-6);
        assert_eq!(vector("granite"), [1.0, 0.0, 0.0]);
    }
}

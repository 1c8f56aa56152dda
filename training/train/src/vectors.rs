//! Text vectors kept between runs: encoding a corpus takes minutes, training on it too.

use crate::{
    error::FitError,
    weights::{self, Table},
};
use asperity::learned::text::{Encoded, TextEncoder};
use asperity_io::diagnostic::Fault;
use serde::{Deserialize, Serialize};
use std::{
    collections::BTreeMap,
    path::Path,
    sync::{Mutex, MutexGuard, PoisonError},
};

/// Largest difference between a kept vector and a fresh one.
const TOLERANCE: f32 = 1e-3;

/// An encoder that remembers, and what it remembered before.
pub struct Remembered<'a> {
    encoder: &'a dyn TextEncoder,
    known: Mutex<BTreeMap<String, Vec<f32>>>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Note {
    encoder: String,
    texts: Vec<String>,
}

impl<'a> Remembered<'a> {
    /// Knows nothing yet.
    #[must_use]
    pub fn new(encoder: &'a dyn TextEncoder) -> Self {
        Self {
            encoder,
            known: Mutex::default(),
        }
    }

    /// Knows what a file of [`save`](Self::save) holds.
    ///
    /// # Errors
    /// [`FitError::Vectors`] for a file of another encoder: one of another name or
    /// width, or whose vector of the first text is another.
    pub fn load(encoder: &'a dyn TextEncoder, path: &Path) -> Result<Self, FitError> {
        let fail = |message: String| FitError::Vectors {
            path: path.to_owned(),
            message,
        };
        let bytes = std::fs::read(path).map_err(|e| fail(e.to_string()))?;
        let note = weights::note(&bytes).map_err(fail)?;
        let note: Note = serde_json::from_str(&note).map_err(|e| fail(e.to_string()))?;
        let width = encoder.width();
        if note.encoder != encoder.name() {
            return Err(fail(format!(
                "holds vectors of the text encoder `{}`",
                note.encoder
            )));
        }
        let vectors = weights::table(&bytes, "vectors", note.texts.len() * width).map_err(fail)?;
        let known: BTreeMap<_, _> = note
            .texts
            .into_iter()
            .zip(vectors.chunks(width).map(<[f32]>::to_vec))
            .collect();
        if let Some((text, vector)) = known.first_key_value() {
            let fresh = encoder.encode(text).map_err(|fault| FitError::Caption {
                caption: text.clone(),
                source: fault.into(),
            })?;
            let apart = fresh.vector.iter().zip(vector).map(|(x, y)| (x - y).abs());
            if apart.fold(0.0, f32::max) > TOLERANCE {
                return Err(fail("holds vectors of another text encoder".into()));
            }
        }
        Ok(Self {
            encoder,
            known: Mutex::new(known),
        })
    }

    /// Writes all it knows, all or nothing.
    ///
    /// # Errors
    /// [`FitError::Output`] when the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), FitError> {
        let fail = |message: String| FitError::Vectors {
            path: path.to_owned(),
            message,
        };
        let known = self.known();
        let vectors: Vec<f32> = known.values().flatten().copied().collect();
        let note = serde_json::to_string(&Note {
            encoder: self.encoder.name().to_owned(),
            texts: known.keys().cloned().collect(),
        });
        let note = note.map_err(|e| fail(e.to_string()))?;
        let table = Table::new(&vectors, self.encoder.width());
        let bytes = weights::write(&[("vectors".to_owned(), table)], &note).map_err(fail)?;
        Ok(asperity_io::output::write_atomic(path, &bytes)?)
    }

    /// Returns true if a text's vector is at hand.
    pub(crate) fn knows(&self, text: &str) -> bool {
        self.known().contains_key(text)
    }

    fn known(&self) -> MutexGuard<'_, BTreeMap<String, Vec<f32>>> {
        // A map is whole after any panic.
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl TextEncoder for Remembered<'_> {
    fn name(&self) -> &str {
        self.encoder.name()
    }

    fn width(&self) -> usize {
        self.encoder.width()
    }

    /// A remembered text says nothing of its tokens.
    fn encode(&self, text: &str) -> Result<Encoded, Fault> {
        let known = self.known().get(text).cloned();
        if let Some(vector) = known {
            return Ok(Encoded {
                vector,
                tokens: 0,
                cut: 0,
            });
        }
        let encoded = self.encoder.encode(text)?;
        self.known().insert(text.to_owned(), encoded.vector.clone());
        Ok(encoded)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::WordBag;

    /// Gives other vectors under the same name.
    struct Reversed;

    impl TextEncoder for Reversed {
        fn name(&self) -> &str {
            WordBag.name()
        }
        fn width(&self) -> usize {
            WordBag.width()
        }
        fn encode(&self, text: &str) -> Result<Encoded, Fault> {
            let mut encoded = WordBag.encode(text)?;
            encoded.vector.reverse();
            Ok(encoded)
        }
    }

    #[test]
    fn what_was_encoded_once_is_read_back_and_another_encoder_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("vectors.safetensors");
        let first = Remembered::new(&WordBag);
        let vector = first.encode("rough sand").unwrap().vector;
        first.encode("silk").unwrap();
        first.save(&path).unwrap();
        let again = Remembered::load(&WordBag, &path).unwrap();
        assert!(again.knows("rough sand") && again.knows("silk"));
        assert_eq!(again.encode("rough sand").unwrap().vector, vector);
        assert!(Remembered::load(&Reversed, &path).is_err());
    }
}

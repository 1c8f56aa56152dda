//! A text encoder that remembers, also from one run to the next: the vectors of a corpus
//! take a minute, and no result depends on when they were made.

use super::{EvaluateError, Watch, cache, watch::pause};
use crate::error::FitError;
use asperity::{
    output::write_atomic,
    text::{Encoded, TextEncoder, TextError},
};
use rayon::prelude::*;
use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
    sync::{Mutex, MutexGuard, PoisonError},
};

/// Texts that are encoded between two looks at the clock.
const CHUNK: usize = 64;
/// Chunks between two savings.
const SAVED_CHUNKS: usize = 16;
/// A text by whose vector an encoder is known.
const PROBE: &str = "a rough surface";
const MAGIC: &[u8; 8] = b"aspvec01";

/// A text encoder with the vectors it gave.
pub(super) struct Memory<'a> {
    encoder: &'a dyn TextEncoder,
    path: PathBuf,
    /// Checksum of the probe's vector: another encoder or back end has another.
    fingerprint: u32,
    known: Mutex<BTreeMap<String, Vec<f32>>>,
}

impl<'a> Memory<'a> {
    /// Reads what an earlier run with the same encoder left in the report's folder.
    pub(super) fn open(encoder: &'a dyn TextEncoder, report: &Path) -> Result<Self, EvaluateError> {
        let path = cache::folder(report)?.join("texts.bin");
        let probe = encoder.encode(PROBE).map_err(|source| FitError::Caption {
            caption: PROBE.into(),
            source,
        })?;
        let fingerprint =
            cache::checksum([bytes(&probe.vector).as_slice(), encoder.name().as_bytes()]);
        // A file of another encoder, or half a file, is no loss.
        let known = fs::read(&path).ok();
        let known = known.and_then(|bytes| parse(&bytes, fingerprint, encoder.width()));
        Ok(Self {
            encoder,
            path,
            fingerprint,
            known: Mutex::new(known.unwrap_or_default()),
        })
    }

    /// By what the encoder is known.
    pub(super) fn fingerprint(&self) -> u32 {
        self.fingerprint
    }

    /// Encodes what is not known yet, and keeps it.
    pub(super) fn learn<'t>(
        &self,
        texts: impl IntoIterator<Item = &'t str>,
        watch: &mut dyn Watch,
    ) -> Result<(), EvaluateError> {
        let mut new: Vec<&str> = {
            let known = self.known();
            texts
                .into_iter()
                .filter(|t| !known.contains_key(*t))
                .collect()
        };
        new.sort_unstable();
        new.dedup();
        if new.is_empty() {
            return Ok(());
        }
        watch.begin("text vectors", new.len());
        let mut done = 0;
        for (index, chunk) in new.chunks(CHUNK).enumerate() {
            if watch.interrupted() || (index + 1) % SAVED_CHUNKS == 0 {
                self.save()?;
            }
            pause(watch, "text vectors")?;
            let vectors: Vec<Vec<f32>> = chunk
                .par_iter()
                .map(|text| self.vector(text))
                .collect::<Result<_, _>>()?;
            let texts = chunk.iter().map(|&text| text.to_owned());
            self.known().extend(texts.zip(vectors));
            done += chunk.len();
            watch.done(done);
        }
        self.save()
    }

    fn save(&self) -> Result<(), EvaluateError> {
        let bytes = serialise(&self.known(), self.fingerprint, self.encoder.width());
        Ok(write_atomic(&self.path, &bytes)?)
    }

    /// The unit vector of a text.
    pub(super) fn vector(&self, text: &str) -> Result<Vec<f32>, EvaluateError> {
        let encoded = self.encode(text).map_err(|source| FitError::Caption {
            caption: text.to_owned(),
            source,
        })?;
        Ok(encoded.vector)
    }

    fn known(&self) -> MutexGuard<'_, BTreeMap<String, Vec<f32>>> {
        // Whole after any panic: an entry is inserted in one go.
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl TextEncoder for Memory<'_> {
    fn name(&self) -> &str {
        self.encoder.name()
    }

    fn width(&self) -> usize {
        self.encoder.width()
    }

    fn encode(&self, text: &str) -> Result<Encoded, TextError> {
        let vector = self.known().get(text).cloned();
        match vector {
            // How many tokens there were is nothing an evaluation asks for.
            Some(vector) => Ok(Encoded {
                vector,
                tokens: 0,
                cut: 0,
            }),
            None => self.encoder.encode(text),
        }
    }
}

fn bytes(vector: &[f32]) -> Vec<u8> {
    vector.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// Magic, fingerprint, width, count; per text its length, its bytes, its vector; CRC-32.
fn serialise(known: &BTreeMap<String, Vec<f32>>, fingerprint: u32, width: usize) -> Vec<u8> {
    let mut all = MAGIC.to_vec();
    for number in [fingerprint, width as u32, known.len() as u32] {
        all.extend(number.to_le_bytes());
    }
    for (text, vector) in known {
        all.extend((text.len() as u32).to_le_bytes());
        all.extend(text.as_bytes());
        all.extend(bytes(vector));
    }
    let crc = cache::checksum([all.as_slice()]);
    all.extend(crc.to_le_bytes());
    all
}

fn parse(all: &[u8], fingerprint: u32, width: usize) -> Option<BTreeMap<String, Vec<f32>>> {
    let (body, crc) = all.split_last_chunk::<4>()?;
    if cache::checksum([body]) != u32::from_le_bytes(*crc) {
        return None;
    }
    let mut rest = body.strip_prefix(MAGIC)?;
    let number = |rest: &mut &[u8]| {
        let (head, tail) = rest.split_first_chunk::<4>()?;
        *rest = tail;
        Some(u32::from_le_bytes(*head))
    };
    if number(&mut rest)? != fingerprint || number(&mut rest)? as usize != width {
        return None;
    }
    let count = number(&mut rest)?;
    let mut known = BTreeMap::new();
    for _ in 0..count {
        let length = number(&mut rest)? as usize;
        let (text, tail) = rest.split_at_checked(length)?;
        let (vector, tail) = tail.split_at_checked(4 * width)?;
        rest = tail;
        let numbers = vector.as_chunks::<4>().0.iter();
        known.insert(
            String::from_utf8(text.to_vec()).ok()?,
            numbers.map(|x| f32::from_le_bytes(*x)).collect(),
        );
    }
    Some(known)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{evaluate::Unwatched, synthetic::WordBag};

    #[test]
    fn vectors_survive_a_run_and_belong_to_their_encoder() {
        let report = tempfile::tempdir().unwrap();
        let memory = Memory::open(&WordBag, report.path()).unwrap();
        memory.learn(["soft moss", "ice"], &mut Unwatched).unwrap();
        let again = Memory::open(&WordBag, report.path()).unwrap();
        assert_eq!(again.known().len(), 2);
        assert_eq!(
            again.vector("soft moss").unwrap(),
            WordBag.encode("soft moss").unwrap().vector
        );
        let all = fs::read(&again.path).unwrap();
        assert!(parse(&all, again.fingerprint, WordBag.width()).is_some());
        assert!(parse(&all, again.fingerprint ^ 1, WordBag.width()).is_none());
        assert!(parse(&all[..all.len() - 1], again.fingerprint, WordBag.width()).is_none());
    }
}

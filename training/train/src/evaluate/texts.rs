//! The text vectors of an evaluation, kept in the report's folder: those of a corpus take a
//! minute, and no result depends on when they were made.

use super::{EvaluateError, Watch, cache, watch::pause};
use crate::{error::FitError, vectors::Remembered};
use asperity::learned::text::TextEncoder;
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Texts that are encoded between two looks at the clock.
const CHUNK: usize = 64;
/// Chunks between two savings.
const SAVED_CHUNKS: usize = 16;
/// A text by whose vector an encoder is known.
const PROBE: &str = "a rough surface";

/// A text encoder with the vectors it gave.
pub(super) struct Texts<'a> {
    pub(super) remembered: Remembered<'a>,
    path: PathBuf,
    /// Checksum of the probe's vector: another encoder or back end has another.
    pub(super) fingerprint: u32,
}

impl<'a> Texts<'a> {
    /// Reads what an earlier run with the same encoder left in the report's folder.
    pub(super) fn open(encoder: &'a dyn TextEncoder, report: &Path) -> Result<Self, EvaluateError> {
        let probe = encode(encoder, PROBE)?;
        let bytes: Vec<u8> = probe.iter().flat_map(|x| x.to_le_bytes()).collect();
        let fingerprint = cache::checksum([bytes.as_slice(), encoder.name().as_bytes()]);
        let path = cache::folder(report)?.join(format!("texts-{fingerprint:08x}.safetensors"));
        // Half a file is no loss.
        let remembered =
            Remembered::load(encoder, &path).unwrap_or_else(|_| Remembered::new(encoder));
        Ok(Self {
            remembered,
            path,
            fingerprint,
        })
    }

    /// Encodes what is not known yet, and keeps it.
    pub(super) fn learn<'t>(
        &self,
        texts: impl IntoIterator<Item = &'t str>,
        watch: &mut dyn Watch,
    ) -> Result<(), EvaluateError> {
        let texts = texts.into_iter();
        let mut new: Vec<&str> = texts.filter(|text| !self.remembered.knows(text)).collect();
        new.sort_unstable();
        new.dedup();
        if new.is_empty() {
            return Ok(());
        }
        watch.begin("text vectors", new.len());
        let mut done = 0;
        for (index, chunk) in new.chunks(CHUNK).enumerate() {
            if watch.interrupted() || (index + 1) % SAVED_CHUNKS == 0 {
                self.remembered.save(&self.path)?;
            }
            pause(watch, "text vectors")?;
            chunk
                .par_iter()
                .try_for_each(|text| self.vector(text).map(drop))?;
            done += chunk.len();
            watch.done(done);
        }
        Ok(self.remembered.save(&self.path)?)
    }

    /// The unit vector of a text.
    pub(super) fn vector(&self, text: &str) -> Result<Vec<f32>, EvaluateError> {
        encode(&self.remembered, text)
    }
}

fn encode(encoder: &dyn TextEncoder, text: &str) -> Result<Vec<f32>, EvaluateError> {
    let encoded = encoder.encode(text).map_err(|fault| FitError::Caption {
        caption: text.to_owned(),
        source: fault.into(),
    })?;
    Ok(encoded.vector)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Unwatched, WordBag};

    #[test]
    fn vectors_survive_a_run_and_half_a_file_is_no_loss() {
        let report = tempfile::tempdir().unwrap();
        let texts = Texts::open(&WordBag, report.path()).unwrap();
        texts.learn(["soft moss", "ice"], &mut Unwatched).unwrap();
        let again = Texts::open(&WordBag, report.path()).unwrap();
        assert!(again.remembered.knows("soft moss") && again.remembered.knows("ice"));
        assert_eq!(
            again.vector("soft moss").unwrap(),
            WordBag.encode("soft moss").unwrap().vector
        );
        let all = std::fs::read(&again.path).unwrap();
        std::fs::write(&again.path, &all[..all.len() / 2]).unwrap();
        let anew = Texts::open(&WordBag, report.path()).unwrap();
        assert!(!anew.remembered.knows("ice"));
    }
}

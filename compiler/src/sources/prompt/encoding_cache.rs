//! Prompts that are read together before they are compiled one by one.
//!
//! The networks of the shipped model treat every row of a batch by itself, and our engine adds every
//! sum in the same order whatever the batch. So what is read together is to the bit what is read
//! alone, and weights are expanded once for many prompts.

use super::{PromptCompiler, PromptError, error::unread, reading::Reading};
use crate::learned::{Decoded, Latent, Projected, text::Encoded};
use std::{
    collections::{HashMap, HashSet},
    hash::Hash,
    sync::{Arc, Mutex, PoisonError},
};

/// Texts, and latents, that are kept; about 4 and 7 KiB each.
const MOST: usize = 4096;

/// A text with what the networks made of it.
pub(super) type Read = Arc<(Encoded, Projected)>;

/// Precomputed results. They equal those computed on demand, so only time depends on them.
#[derive(Debug, Default)]
pub(super) struct EncodingCache {
    readings: Mutex<HashMap<String, Reading>>,
    read: Mutex<HashMap<String, Read>>,
    decoded: Mutex<HashMap<Bits, Arc<Decoded>>>,
}

/// A latent to the bit.
type Bits = [u32; size_of::<Latent>() / 4];

fn bits(z: &Latent) -> Bits {
    z.map(f32::to_bits)
}

impl EncodingCache {
    pub(super) fn reading(&self, prompt: &str) -> Option<Reading> {
        let readings = self.readings.lock().unwrap_or_else(PoisonError::into_inner);
        readings.get(prompt).cloned()
    }

    pub(super) fn read(&self, text: &str) -> Option<Read> {
        let read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        read.get(text).cloned()
    }

    pub(super) fn decoded(&self, z: &Latent) -> Option<Arc<Decoded>> {
        let decoded = self.decoded.lock().unwrap_or_else(PoisonError::into_inner);
        decoded.get(&bits(z)).cloned()
    }
}

impl PromptCompiler {
    /// Reads prompts, and the things that they name, ahead of [`compile`](Self::compile), many at
    /// once. It changes no result. With networks that may treat a batch otherwise than its rows, it
    /// does nothing, and neither does it with what fails: `compile` will say why.
    pub fn read_ahead(&self, prompts: &[&str]) {
        if self.together {
            // What fails here fails again where it is reported.
            let _ = self.try_read_ahead(prompts);
        }
    }

    fn try_read_ahead(&self, prompts: &[&str]) -> Result<(), PromptError> {
        let mut texts: Vec<String> = Vec::new();
        let mut seen = HashSet::new();
        let mut readings = Vec::new();
        for prompt in prompts {
            let reading = self.read(prompt);
            let things = reading.phrase.things().into_iter();
            let things = things.filter(|thing| self.things.get(thing).is_none());
            let things = things.map(|thing| self.read_surface(thing).text());
            for text in std::iter::once(reading.text()).chain(things) {
                if self.cache.read(&text).is_none() && seen.insert(text.clone()) {
                    texts.push(text);
                }
            }
            readings.push(((*prompt).to_owned(), reading));
        }
        keep(&self.cache.readings, readings);
        let plain: Vec<&str> = texts.iter().map(String::as_str).collect();
        let encoded = self.text.encode_all(&plain).map_err(unread)?;
        let vectors: Vec<&[f32]> = encoded.iter().map(|e| e.vector.as_slice()).collect();
        let projected = self.model().project_all(&vectors)?;
        let latents: Vec<Latent> = projected.iter().map(|projected| projected.z).collect();
        let decoded = self.model().decode_all(&latents)?;
        let answers = encoded.into_iter().zip(projected).map(Arc::new);
        keep(&self.cache.read, texts.into_iter().zip(answers).collect());
        let decoded = decoded.into_iter().map(Arc::new);
        keep(
            &self.cache.decoded,
            latents.iter().map(bits).zip(decoded).collect(),
        );
        Ok(())
    }
}

/// Adds answers, instead of all others where there would be too many.
fn keep<K: Eq + Hash, V>(kept: &Mutex<HashMap<K, V>>, answers: Vec<(K, V)>) {
    let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
    if kept.len() + answers.len() > MOST {
        kept.clear();
    }
    kept.extend(answers);
}

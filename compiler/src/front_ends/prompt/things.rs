//! Things that prompts named, so that a library reads each of them once.

use crate::{front_ends::learned::Latent, model::attributes::Attributes};
use std::{
    collections::HashMap,
    sync::{Mutex, PoisonError},
};

/// Things that are kept; about 400 bytes each.
const MOST: usize = 4096;

/// Latents and attributes of things by their words. What is kept is what would be computed again, so
/// nothing depends on it but time.
#[derive(Debug, Default)]
pub(super) struct Things(Mutex<HashMap<String, (Latent, Attributes)>>);

impl Things {
    pub(super) fn get(&self, text: &str) -> Option<(Latent, Attributes)> {
        let things = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        things.get(text).copied()
    }

    /// Keeps a thing while there is room.
    pub(super) fn keep(&self, text: &str, found: (Latent, Attributes)) {
        let mut things = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if things.len() < MOST {
            things.insert(text.to_owned(), found);
        }
    }
}

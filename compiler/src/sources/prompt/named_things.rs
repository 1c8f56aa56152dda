//! Materials that prompts named, so that a library reads each of them once.

use crate::learned::Latent;
use asperity_texture::model::shift::Scales;
use std::{
    collections::HashMap,
    sync::{Mutex, PoisonError},
};

/// Materials that are kept; about 400 bytes each.
const MOST: usize = 4096;

/// A material as a prompt describes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Referent {
    pub(super) z: Latent,
    /// The attributes that its words ask for.
    pub(super) wanted: Scales,
    /// True if it is composed of other materials, so that no word vector describes it.
    pub(super) composed: bool,
}

/// Materials by their words. What is kept is what would be computed again, so
/// nothing depends on it but time.
#[derive(Debug, Default)]
pub(super) struct Things(Mutex<HashMap<String, Referent>>);

impl Things {
    pub(super) fn get(&self, text: &str) -> Option<Referent> {
        let things = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        things.get(text).copied()
    }

    /// Keeps a material while there is room.
    pub(super) fn keep(&self, text: &str, found: Referent) {
        let mut things = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if things.len() < MOST {
            things.insert(text.to_owned(), found);
        }
    }
}

//! The libraries that the page can show: the one at the start, and the last that were dropped.

use crate::{collection::Collection, error::ApiError, http::Status};
use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, PoisonError},
};

/// Dropped libraries that are kept, each of which is in memory.
const MOST: usize = 2;
/// Identifier of the library at the start.
const START: &str = "0";

/// Libraries by identifier, as long as the server runs.
pub(crate) struct LibraryStore {
    start: Option<Arc<Collection>>,
    opened: Mutex<OpenedLibraries>,
}

#[derive(Default)]
struct OpenedLibraries {
    /// Total number dropped.
    count: u64,
    /// The last ones, the newest at the end.
    kept: VecDeque<LibraryHandle>,
}

/// A library and its identifier.
#[derive(Clone)]
pub(crate) struct LibraryHandle {
    pub(crate) id: String,
    pub(crate) library: Arc<Collection>,
}

impl LibraryStore {
    pub(crate) fn new(start: Option<Collection>) -> Self {
        Self {
            start: start.map(Arc::new),
            opened: Mutex::default(),
        }
    }

    /// The library at the start.
    pub(crate) fn start(&self) -> Option<LibraryHandle> {
        self.start.as_ref().map(|library| LibraryHandle {
            id: START.to_owned(),
            library: Arc::clone(library),
        })
    }

    /// Keeps a library that was dropped; the oldest makes room for it.
    pub(crate) fn keep(&self, library: Collection) -> LibraryHandle {
        let mut opened = self.opened.lock().unwrap_or_else(PoisonError::into_inner);
        opened.count += 1;
        let handle = LibraryHandle {
            id: opened.count.to_string(),
            library: Arc::new(library),
        };
        opened.kept.push_back(handle.clone());
        while opened.kept.len() > MOST {
            opened.kept.pop_front();
        }
        handle
    }

    /// The library of this name.
    ///
    /// # Errors
    /// Where there is none, or no longer.
    pub(crate) fn get(&self, id: &str) -> Result<LibraryHandle, ApiError> {
        let opened = self.opened.lock().unwrap_or_else(PoisonError::into_inner);
        let found = opened.kept.iter().find(|handle| handle.id == id).cloned();
        let start = || self.start().filter(|handle| handle.id == id);
        found.or_else(start).ok_or_else(|| {
            ApiError::new(
                Status::NotFound,
                "the server does not have this library, or no longer",
                "drop its file on the page again",
            )
        })
    }
}

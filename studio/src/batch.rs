//! A table of prompts that is dropped on the page: all of them compiled into a library, as `asperity build` does.

use crate::{
    collection::Collection,
    error::{ApiError, refused},
    http::Status,
    prompts::LoadPrompts,
    recipe::Opened,
    texture::hash,
};
use asperity::{
    emit::textures::Textures,
    library::{Build, Manifest, Request},
    pipeline::Clock,
    sources::Registry,
};
use asperity_io::{
    clock::now,
    diagnostic::{Diagnostic, Failures, Fault, all, alone},
    input::Reach,
    shown::counted,
};
use serde::Serialize;
use std::{
    path::Path,
    str,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
};

/// Endings of the files that list textures.
const ENDINGS: [&str; 3] = ["csv", "toml", "jsonl"];
/// A folder that is nowhere: a list that is dropped names no files of this machine.
const NOWHERE: &str = "/nowhere/";

/// Returns true for a file that lists textures, by its name.
pub(crate) fn is_list(file: &str) -> bool {
    let ending = Path::new(file).extension().unwrap_or_default();
    ENDINGS.iter().any(|own| ending.eq_ignore_ascii_case(own))
}

/// The one list that is compiled, if any.
#[derive(Debug, Default)]
pub(crate) struct Batch {
    turn: Mutex<()>,
    done: AtomicUsize,
    total: AtomicUsize,
    stop: AtomicBool,
}

/// How far it is; both 0 where none is compiled.
#[derive(Debug, Serialize)]
pub(crate) struct Progress {
    done: usize,
    total: usize,
}

impl Batch {
    /// Compiles a list; another one waits for it.
    ///
    /// # Errors
    /// As `asperity build`, for a list that names files or a model, and once it is stopped.
    pub(crate) fn run(
        &self,
        file: &str,
        bytes: &[u8],
        load: LoadPrompts,
    ) -> Result<Collection, ApiError> {
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        self.stop.store(false, Ordering::Relaxed);
        let built = self.library(file, bytes, load);
        self.total.store(0, Ordering::Relaxed);
        self.done.store(0, Ordering::Relaxed);
        let library = built?;
        let path = Path::new(file);
        let textures = Textures::from_bytes(path, library).map_err(|e| refused(&e))?;
        let listed = Opened {
            path: file.to_owned(),
            id: hash(bytes),
        };
        Collection::built(textures, listed)
    }

    /// How far it is.
    pub(crate) fn progress(&self) -> Progress {
        Progress {
            done: self.done.load(Ordering::Relaxed),
            total: self.total.load(Ordering::Relaxed),
        }
    }

    /// Begins no further texture of it.
    pub(crate) fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    fn library(&self, file: &str, bytes: &[u8], load: LoadPrompts) -> Result<Vec<u8>, ApiError> {
        let path = Path::new(file);
        let text = str::from_utf8(bytes).map_err(|_| {
            let fault = Fault::new(
                "not UTF-8",
                "save it as UTF-8, as `CSV UTF-8` of a spreadsheet",
            );
            refused(&fault.at(path))
        })?;
        let reach = Reach::Within(NOWHERE.into());
        let manifest = Manifest::within(path, text, reach, &Registry::default());
        let manifest = manifest.map_err(|faults| first_of(&all(faults)))?;
        if !manifest.sources.is_empty() || manifest.setup != Default::default() {
            let what = "it names other files or a model";
            let remedy = "run `asperity build` with it, and drop the library that this writes";
            return Err(refused(&Fault::new(what, remedy).at(path)));
        }
        let request = Request {
            clock: Clock(now),
            stop: Some(&self.stop),
            ..Request::default()
        };
        let build = Build::new(&manifest, &request).map_err(|e| first_of(&e))?;
        self.total.store(build.len(), Ordering::Relaxed);
        let open = || load().map_err(alone);
        let done = || {
            self.done.fetch_add(1, Ordering::Relaxed);
        };
        let built = build.run(&open, &done).map_err(|e| first_of(&e))?;
        let mut library = Vec::with_capacity(built.library.len() as usize);
        built.library.write(&mut library).map_err(|error| {
            let help = "free space in the folder for temporary files";
            ApiError::new(Status::Internal, error.to_string(), help)
        })?;
        Ok(library)
    }
}

/// The first of several failures, and how many others there are.
fn first_of(failures: &Failures) -> ApiError {
    let fault = Fault::new("it holds no texture", "give it a row for each");
    let first: &dyn Diagnostic = failures.first().map_or(&fault, AsRef::as_ref);
    let mut error = refused(first);
    if failures.len() > 1 {
        let others = counted(failures.len() - 1, "other fault", "other faults");
        error.error = format!("{}; and {others}", error.error);
    }
    error
}

//! Finds the library in a fixed order, and reports what was tried.

use std::{
    env,
    ffi::OsStr,
    fmt,
    path::{Path, PathBuf},
};

use thiserror::Error;

use crate::{
    candidates,
    library::{self, Opened},
};

/// Location in which the library was found. The variants are in the order of the search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Source {
    /// Environment variable `ASPERITY_ONNXRUNTIME`: a file, or the folder it lies in.
    Variable,
    /// Environment variable `ORT_DYLIB_PATH`, which other programs read too.
    OrtVariable,
    /// Beside the program.
    Executable,
    /// The system's loader.
    System,
    /// A Python installation with the package `onnxruntime`.
    Python,
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Variable => "ASPERITY_ONNXRUNTIME",
            Self::OrtVariable => "ORT_DYLIB_PATH",
            Self::Executable => "beside the program",
            Self::System => "system library",
            Self::Python => "Python package",
        })
    }
}

/// A library that can be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Discovery {
    /// The file, or the name that the system's loader knows it by.
    pub path: PathBuf,
    /// The version that it reports, for example `1.31.1`.
    pub version: String,
    /// Location in which it was found.
    pub source: Source,
}

/// `1.31.1, /…/libonnxruntime.so.1.31.1 (Python package)`.
impl fmt::Display for Discovery {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}, {} ({})",
            self.version,
            self.path.display(),
            self.source
        )
    }
}

/// A location that was searched without success.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Attempt {
    /// Why it was searched.
    pub source: Source,
    /// The file or folder; `None` if there was no place to search.
    pub path: Option<PathBuf>,
    /// Why it cannot be used.
    pub reason: String,
}

impl fmt::Display for Attempt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.path {
            Some(path) => write!(f, "{}: {} {}", self.source, path.display(), self.reason),
            None => write!(f, "{}: {}", self.source, self.reason),
        }
    }
}

/// No usable library was found.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("ONNX Runtime was not found; tried {}", self.listed())]
pub struct NotFound {
    /// Attempts, in order.
    pub attempts: Vec<Attempt>,
}

impl NotFound {
    /// Returns the remedy: a step for the user, in one sentence.
    #[must_use]
    pub fn remedy(&self) -> String {
        "run `pip install onnxruntime`, or unpack a release of \
         https://github.com/microsoft/onnxruntime/releases and set ASPERITY_ONNXRUNTIME to the \
         library in it"
            .to_owned()
    }

    fn listed(&self) -> String {
        let attempts: Vec<_> = self.attempts.iter().map(Attempt::to_string).collect();
        attempts.join("; ")
    }
}

/// Looks for ONNX Runtime.
///
/// The places are the variables `ASPERITY_ONNXRUNTIME` and `ORT_DYLIB_PATH`, the folder of the
/// program, the system's libraries, and Python installations. The library is opened, checked to be
/// ONNX Runtime 1.17 or newer, and kept open. If a variable is set and what it names cannot be
/// used, nothing else is tried.
///
/// # Errors
/// [`NotFound`] lists what was tried and why each failed.
pub fn discover() -> Result<Discovery, NotFound> {
    find().map(|(discovery, _)| discovery)
}

/// As [`discover`], and the opened library.
pub(crate) fn find() -> Result<(Discovery, Opened), NotFound> {
    let mut search = Search::default();
    for source in [Source::Variable, Source::OrtVariable] {
        if let Some(value) = env::var_os(source.to_string()).filter(|value| !value.is_empty()) {
            let found = search.named(source, Path::new(&value));
            return found.ok_or(NotFound {
                attempts: search.attempts,
            });
        }
        search.fail(source, None, "not set".to_owned());
    }
    let found = search
        .folders(Source::Executable, candidates::beside_executable())
        .or_else(|| search.system())
        .or_else(|| search.folders(Source::Python, candidates::python_packages()));
    found.ok_or(NotFound {
        attempts: search.attempts,
    })
}

type DiscoveredLibrary = (Discovery, Opened);

#[derive(Default)]
struct Search {
    attempts: Vec<Attempt>,
}

impl Search {
    fn fail(&mut self, source: Source, path: Option<PathBuf>, reason: String) {
        self.attempts.push(Attempt {
            source,
            path,
            reason,
        });
    }

    fn open(&mut self, source: Source, path: &Path) -> Option<DiscoveredLibrary> {
        match library::open(path.as_os_str()) {
            Ok(opened) => {
                let discovery = Discovery {
                    path: path.to_owned(),
                    version: opened.version.clone(),
                    source,
                };
                Some((discovery, opened))
            }
            Err(refusal) => {
                self.fail(source, Some(path.to_owned()), refusal.to_string());
                None
            }
        }
    }

    /// A file, or a folder with the library in it.
    fn named(&mut self, source: Source, path: &Path) -> Option<DiscoveredLibrary> {
        if path.is_dir() {
            return self.folders(source, vec![path.to_owned()]);
        }
        if !path.exists() {
            self.fail(source, Some(path.to_owned()), "does not exist".to_owned());
            return None;
        }
        // The loader looks for a bare name along its search path.
        let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        self.open(source, &path)
    }

    fn folders(&mut self, source: Source, folders: Vec<PathBuf>) -> Option<DiscoveredLibrary> {
        let mut any = false;
        for folder in &folders {
            for path in candidates::in_folder(folder) {
                any = true;
                let found = self.open(source, &path);
                if found.is_some() {
                    return found;
                }
            }
        }
        if !any {
            let reason = "no libonnxruntime there".to_owned();
            self.fail(source, folders.into_iter().next(), reason);
        }
        None
    }

    fn system(&mut self) -> Option<DiscoveredLibrary> {
        let names = candidates::SYSTEM_NAMES;
        names
            .iter()
            .find_map(|name| self.open(Source::System, Path::new(OsStr::new(name))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_that_does_not_exist_is_named() {
        let mut search = Search::default();
        assert!(
            search
                .named(Source::Variable, Path::new("/no/such/library.so"))
                .is_none()
        );
        let text = NotFound {
            attempts: search.attempts,
        }
        .to_string();
        assert_eq!(
            text,
            "ONNX Runtime was not found; tried ASPERITY_ONNXRUNTIME: /no/such/library.so does not exist"
        );
    }

    #[test]
    fn a_file_that_is_no_library_is_refused() {
        let mut search = Search::default();
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml");
        assert!(search.named(Source::Variable, &file).is_none());
        let reason = &search.attempts[0].reason;
        assert!(reason.contains("cannot be opened as a library"), "{reason}");
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn another_library_is_refused() {
        let refusal = library::open(OsStr::new("libc.so.6")).err();
        assert_eq!(refusal, Some(library::Refusal::Entry));
    }

    #[test]
    fn a_folder_without_the_library_is_named() {
        let mut search = Search::default();
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        assert!(search.named(Source::Variable, folder).is_none());
        assert_eq!(search.attempts[0].path.as_deref(), Some(folder));
        assert!(
            NotFound {
                attempts: search.attempts
            }
            .remedy()
            .contains("pip install onnxruntime")
        );
    }
}

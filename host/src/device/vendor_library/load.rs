//! Loading a library, and finding its functions. With the two files that call those functions, the
//! only unsafe code of this crate's vendor back ends.
#![allow(
    unsafe_code,
    reason = "a foreign library is loaded, and its functions are found by name"
)]

use std::path::Path;

use super::{LibraryError, LibraryRequest, Source, elf};

/// A loaded library. It is unloaded when it is dropped.
#[derive(Debug)]
pub(in crate::device) struct Library {
    loaded: libloading::Library,
    product: &'static str,
    /// The file, or the name that the system found.
    path: String,
}

impl Library {
    /// Loads the library that is asked for; `setting` is the value of `lib=`.
    ///
    /// # Errors
    /// [`LibraryError`], with what to do.
    pub(in crate::device) fn load(
        source: &Source,
        setting: Option<&str>,
    ) -> Result<Self, LibraryError> {
        let product = source.product;
        match source.requested(setting) {
            LibraryRequest::File(path) => {
                check_file(product, &path)?;
                let loaded = open(&path).map_err(|message| LibraryError::Load {
                    product,
                    path: path.clone(),
                    message,
                })?;
                Ok(Self {
                    loaded,
                    product,
                    path,
                })
            }
            LibraryRequest::System => {
                let mut first = None;
                for &name in source.names {
                    match open(name) {
                        Ok(loaded) => {
                            let path = name.to_owned();
                            return Ok(Self {
                                loaded,
                                product,
                                path,
                            });
                        }
                        Err(message) => first = first.or(Some(message)),
                    }
                }
                Err(LibraryError::NotFound {
                    product,
                    names: source.names.join(", "),
                    variable: source.variable,
                    message: first.unwrap_or_default(),
                })
            }
        }
    }

    /// The file, or the name that the system found.
    pub(in crate::device) fn path(&self) -> &str {
        &self.path
    }

    /// A function of the library.
    ///
    /// # Safety
    /// `F` must be a function pointer of the function's true type, and must not be called after the
    /// library was dropped.
    ///
    /// # Errors
    /// [`LibraryError::Symbol`].
    pub(in crate::device) unsafe fn function<F: Copy>(
        &self,
        symbol: &'static str,
    ) -> Result<F, LibraryError> {
        // SAFETY: the caller vouches for the type.
        match unsafe { self.loaded.get::<F>(symbol) } {
            Ok(found) => Ok(*found),
            Err(_) => Err(LibraryError::Symbol {
                product: self.product,
                path: self.path.clone(),
                symbol,
            }),
        }
    }
}

/// Says what is wrong with a file before the system's loader says less.
fn check_file(product: &'static str, path: &str) -> Result<(), LibraryError> {
    let named = path.to_owned();
    std::fs::File::open(path)
        .and_then(|file| file.metadata())
        .and_then(|found| match found.is_dir() {
            true => Err(std::io::ErrorKind::IsADirectory.into()),
            false => Ok(()),
        })
        .map_err(|error| LibraryError::NoFile {
            product,
            path: named.clone(),
            message: error.to_string(),
        })?;
    if !cfg!(target_os = "linux") {
        return Ok(());
    }
    let here = std::env::consts::ARCH;
    match elf::kind(Path::new(path)) {
        Some(elf::BinaryKind::Foreign) => Err(LibraryError::NotALibrary {
            product,
            path: named,
        }),
        Some(elf::BinaryKind::For(built_for)) if built_for != here => {
            Err(LibraryError::Architecture {
                product,
                path: named,
                built_for,
                here,
            })
        }
        _ => Ok(()),
    }
}

fn open(name: &str) -> Result<libloading::Library, String> {
    // SAFETY: loading runs the library's constructors. The user installed it and asked for it.
    unsafe { libloading::Library::new(name) }.map_err(|error| {
        match std::error::Error::source(&error) {
            Some(cause) => cause.to_string(),
            None => error.to_string(),
        }
    })
}

/// A table of functions of a library, and the same as text for comparison with a description.
macro_rules! symbols {
    ($(#[$meta:meta])* $name:ident { $($field:ident = $symbol:literal: fn($($argument:ty),*) $(-> $result:ty)?;)* }) => {
        $(#[$meta])*
        #[derive(Debug)]
        struct $name {
            $($field: unsafe extern "C" fn($($argument),*) $(-> $result)?,)*
            // Dropped after the functions, which nobody can call then.
            _library: crate::device::vendor_library::Library,
        }

        impl $name {
            /// Name and type of every function.
            #[cfg(test)]
            const ALL: &[(&str, &str)] = &[$(($symbol, stringify!(fn($($argument),*) $(-> $result)?)),)*];

            fn find(library: crate::device::vendor_library::Library) -> Result<Self, crate::device::vendor_library::LibraryError> {
                Ok(Self {
                    // SAFETY: a test compares the types with an openly licensed description, and
                    // the functions live as long as the library beside them.
                    $($field: unsafe { library.function($symbol) }?,)*
                    _library: library,
                })
            }
        }
    };
}
pub(in crate::device) use symbols;

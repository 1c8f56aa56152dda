//! A vendor's shared library, found and loaded at run time.
//!
//! Asperity ships no vendor's library. It is loaded from the user's installation: from the path of
//! the URI's setting `lib=`, else from the path in an environment variable, else by the names that
//! the vendor gives it, where the system looks for libraries.

mod elf;
mod error;
mod load;

pub use error::{LibraryError, VendorError};
pub(super) use load::{Library, symbols};

/// Search names of a vendor's library.
#[derive(Debug, Clone, Copy)]
pub struct Source {
    /// The product, for messages.
    pub product: &'static str,
    /// Environment variable that may hold a path.
    pub variable: &'static str,
    /// Names that the vendor gives the library, the most likely one first.
    pub names: &'static [&'static str],
}

/// Where a library was asked for, in the order of precedence.
#[derive(Debug, Clone, PartialEq, Eq)]
enum LibraryRequest {
    /// A given file.
    File(String),
    /// Any of the names, on the system's search path.
    System,
}

impl Source {
    /// Resolves the requested library: `setting` is the value of `lib=`.
    fn requested(&self, setting: Option<&str>) -> LibraryRequest {
        let variable = std::env::var(self.variable).ok();
        let path = setting.map(str::to_owned).or(variable);
        path.filter(|path| !path.is_empty())
            .map_or(LibraryRequest::System, LibraryRequest::File)
    }
}

//! The compiler as a module of WebAssembly, for exported pages.

use crate::VERSION;
use asperity_io::{
    diagnostic::Diagnostic,
    input::{self, InputError, InputKind},
};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Magic number and version 1 of a WebAssembly module.
const MAGIC: &[u8] = b"\0asm\x01\0\0\0";
/// The section in which the module says of which version it is.
const SECTION: &[u8] = b"asperity-studio";

/// A module that `studio/build-module` built of this version.
#[derive(Debug, Clone)]
pub struct Module(Vec<u8>);

/// A file that is no such module.
#[derive(Debug, Error)]
pub enum ModuleError {
    /// It cannot be read.
    #[error(transparent)]
    Input(#[from] InputError),
    /// Another module, or none.
    #[error("{path}: not the studio's compiler", path = .0.display())]
    Other(PathBuf),
    /// A module of another version.
    #[error("{path}: the compiler of version {version}, this is {VERSION}", path = path.display())]
    Version {
        /// The file.
        path: PathBuf,
        /// Its version.
        version: String,
    },
}

impl Diagnostic for ModuleError {
    fn remedy(&self) -> String {
        match self {
            Self::Input(error) => error.remedy(),
            Self::Other(_) | Self::Version { .. } => {
                "give the file that `studio/build-module` writes, built of this version".into()
            }
        }
    }
}

impl Module {
    /// Reads a module.
    ///
    /// # Errors
    /// [`ModuleError`] for a file that is none, or of another version than the page.
    pub fn open(path: &Path) -> Result<Self, ModuleError> {
        let bytes = input::read(path, InputKind::StudioModule).map_err(|problem| InputError {
            file: path.to_owned(),
            problem,
        })?;
        match version(&bytes) {
            Some(version) if version == VERSION.as_bytes() => Ok(Self(bytes)),
            Some(version) => Err(ModuleError::Version {
                path: path.to_owned(),
                version: String::from_utf8_lossy(version).into_owned(),
            }),
            None => Err(ModuleError::Other(path.to_owned())),
        }
    }

    /// Its bytes.
    pub(crate) fn bytes(&self) -> &[u8] {
        &self.0
    }
}

/// Returns the content of the version section; `None` if there is none, or if the bytes are not a module.
fn version(bytes: &[u8]) -> Option<&[u8]> {
    let mut rest = bytes.strip_prefix(MAGIC)?;
    loop {
        let (&kind, after) = rest.split_first()?;
        let (length, after) = number(after)?;
        let (section, after) = after.split_at_checked(length)?;
        if kind == 0 {
            let (length, named) = number(section)?;
            let (name, content) = named.split_at_checked(length)?;
            if name == SECTION {
                return Some(content);
            }
        }
        rest = after;
    }
}

/// A number of 32 bits in LEB128, and what follows it.
fn number(bytes: &[u8]) -> Option<(usize, &[u8])> {
    let mut value = 0;
    for (at, &byte) in bytes.iter().enumerate().take(5) {
        value |= u64::from(byte & 0x7f) << (7 * at);
        if byte < 0x80 {
            return Some((usize::try_from(value).ok()?, &bytes[at + 1..]));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A module of these sections, (kind, content).
    fn module(sections: &[(u8, &[u8])]) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        for (kind, content) in sections {
            bytes.push(*kind);
            // In two bytes, which is allowed.
            bytes.extend([content.len() as u8 | 0x80, 0]);
            bytes.extend(*content);
        }
        bytes
    }

    fn said(name: &[u8], content: &[u8]) -> Vec<u8> {
        [&[name.len() as u8], name, content].concat()
    }

    #[test]
    fn the_version_is_read_of_its_section_alone() {
        let own = said(SECTION, b"1.2.3");
        let good = module(&[
            (1, b"types"),
            (0, &said(b"name", b"x")),
            (0, &own),
            (11, b"data"),
        ]);
        assert_eq!(version(&good), Some(&b"1.2.3"[..]));
        for (what, bytes) in [
            ("no module", b"asperity-studio".to_vec()),
            ("another kind of section", module(&[(11, &own)])),
            ("none", module(&[(1, b"types")])),
            ("empty", MAGIC.to_vec()),
            ("longer than the file", [MAGIC, &[0, 99]].concat()),
            (
                "a number without end",
                [MAGIC, &[0, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80]].concat(),
            ),
            ("a name longer than its section", module(&[(0, b"\x7fx")])),
        ] {
            assert_eq!(version(&bytes), None, "{what}");
        }
        for end in MAGIC.len()..good.len() - 7 {
            assert_eq!(version(&good[..end]), None, "cut at {end}");
        }
    }
}

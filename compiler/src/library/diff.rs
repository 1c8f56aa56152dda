//! Changes between two versions of a library.

use super::{change::Change, loaded_library::LoadedLibrary};
use crate::sources::asset::parsed;
use asperity_io::diagnostic::Fault;
use serde::Serialize;
use std::{collections::BTreeMap, fmt};

/// Changes between two libraries, or two assets.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Difference {
    /// Textures that are new.
    pub added: Vec<String>,
    /// Textures that are gone.
    pub removed: Vec<String>,
    /// Textures that changed, in order of name.
    pub changed: BTreeMap<String, Change>,
    /// Textures that are the same.
    pub same: usize,
}

/// Compares two libraries by the names of their textures; two assets are compared whatever their
/// names.
///
/// # Errors
/// [`Fault`] for an asset that is damaged.
pub fn diff(old: &LoadedLibrary, new: &LoadedLibrary) -> Result<Difference, Fault> {
    let mut difference = Difference::default();
    if let (false, false, [(name, old)], [(_, new)]) = (
        old.is_library,
        new.is_library,
        &old.textures[..],
        &new.textures[..],
    ) {
        difference.compare(name, old, new)?;
        return Ok(difference);
    }
    let mut left: BTreeMap<&str, &[u8]> = named(old);
    for (name, new) in named(new) {
        match left.remove(name) {
            Some(old) => difference.compare(name, old, new)?,
            None => difference.added.push(name.to_owned()),
        }
    }
    difference.removed = left.into_keys().map(str::to_owned).collect();
    Ok(difference)
}

fn named(shelf: &LoadedLibrary) -> BTreeMap<&str, &[u8]> {
    let textures = shelf.textures.iter();
    textures
        .map(|(name, bytes)| (name.as_str(), bytes.as_slice()))
        .collect()
}

impl Difference {
    fn compare(&mut self, name: &str, old: &[u8], new: &[u8]) -> Result<(), Fault> {
        let change = if old == new {
            None
        } else {
            Change::between(&parsed(old)?, &parsed(new)?)
        };
        match change {
            Some(change) => {
                self.changed.insert(name.to_owned(), change);
            }
            None => self.same += 1,
        }
        Ok(())
    }

    /// Returns true if nothing changed.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.added.is_empty() && self.removed.is_empty() && self.changed.is_empty()
    }
}

/// A line a texture that changed: `+` added, `-` removed, `~` changed; then the counts.
impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for name in &self.removed {
            writeln!(f, "- {name}")?;
        }
        for name in &self.added {
            writeln!(f, "+ {name}")?;
        }
        for (name, change) in &self.changed {
            writeln!(f, "~ {name}: {change}")?;
        }
        let felt = self
            .changed
            .values()
            .filter(|change| !change.felt.is_empty());
        writeln!(
            f,
            "{} added, {} removed, {} changed ({} noticeably), {} unchanged",
            self.added.len(),
            self.removed.len(),
            self.changed.len(),
            felt.count(),
            self.same
        )
    }
}

//! The sources that a manifest can name, as a value: a program may add its own.

use super::{asset, import, kind::SourceKind, prompt, recording, surface};

/// The kinds of sources that manifests may name.
#[derive(Debug, Clone)]
pub struct Registry(Vec<SourceKind>);

/// The kinds of this crate.
impl Default for Registry {
    fn default() -> Self {
        Self(vec![
            prompt::KIND,
            import::KIND,
            recording::KIND,
            surface::KIND,
            asset::KIND,
        ])
    }
}

impl Registry {
    /// With another kind, in the place of one of its key.
    #[must_use]
    pub fn with(mut self, kind: SourceKind) -> Self {
        self.0.retain(|known| known.key != kind.key);
        self.0.push(kind);
        self
    }

    /// The kind of a key.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&SourceKind> {
        self.0.iter().find(|kind| kind.key == key)
    }

    /// All keys of options that only some sources have.
    pub fn options(&self) -> impl Iterator<Item = &'static str> + '_ {
        self.0.iter().flat_map(|kind| kind.options).copied()
    }

    /// All keys.
    pub fn keys(&self) -> impl Iterator<Item = &'static str> + '_ {
        self.0.iter().map(|kind| kind.key)
    }
}

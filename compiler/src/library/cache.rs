//! Textures that were made before, by their keys.
//!
//! An entry is a file named by its key. It begins with a digest of key and content, so an entry that
//! was damaged, moved or written by another version counts as missing. It is written beside its
//! place and renamed: two builds at once cannot disturb each other, because whatever either writes
//! under a key is the same.

use super::{
    facts::Facts,
    key::{Key, Parts},
};
use crate::back_end::output::write_atomic;
use asperity_formats::Asset;
use std::{
    env, fs, io,
    path::{Path, PathBuf},
    sync::atomic::{AtomicBool, Ordering},
};

/// First bytes of an entry: a magic, and the version of what follows.
const MAGIC: &[u8; 8] = b"ASPC\x01\0\0\0";
/// Bytes before the figures: magic, digest, length of the figures.
const HEAD: usize = 8 + 32 + 4;
/// Variable that names a folder for the cache.
const VARIABLE: &str = "ASPERITY_CACHE";

/// A folder of textures by their keys.
#[derive(Debug)]
pub struct Cache {
    folder: PathBuf,
    /// Whether a write failed, after which no more are tried.
    full: AtomicBool,
}

/// The cache of this user: `ASPERITY_CACHE`, else the platform's folder for caches; `None` where no
/// variable names one.
#[must_use]
pub fn default_folder() -> Option<PathBuf> {
    let variable = |name: &str| {
        let value = env::var_os(name).filter(|value| !value.is_empty());
        value.map(PathBuf::from)
    };
    if let Some(folder) = variable(VARIABLE) {
        return Some(folder);
    }
    let platform = if cfg!(windows) {
        variable("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        variable("HOME").map(|home| home.join("Library/Caches"))
    } else {
        // The XDG specification ignores relative paths.
        let xdg = variable("XDG_CACHE_HOME").filter(|folder| folder.is_absolute());
        xdg.or_else(|| variable("HOME").map(|home| home.join(".cache")))
    };
    platform.map(|folder| folder.join("asperity"))
}

impl Cache {
    /// The cache in a folder, which is made when the first entry is written.
    #[must_use]
    pub fn new(folder: PathBuf) -> Self {
        Self {
            folder,
            full: AtomicBool::new(false),
        }
    }

    /// Its folder.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    fn place(&self, key: &Key) -> PathBuf {
        let name = key.to_string();
        self.folder.join(&name[..2]).join(&name[2..])
    }

    /// The texture of a key; `None` if it is not there, damaged, or of another version.
    #[must_use]
    pub fn get(&self, key: &Key) -> Option<(Vec<u8>, Facts)> {
        let mut entry = fs::read(self.place(key)).ok()?;
        let (head, content) = entry.split_at_checked(HEAD)?;
        if !head.starts_with(MAGIC) || head[8..40] != digest(key, &head[40..], content)[..] {
            return None;
        }
        let length = u32::from_le_bytes(head[40..44].try_into().ok()?) as usize;
        let (facts, asset) = content.split_at_checked(length)?;
        let facts = serde_json::from_slice(facts).ok()?;
        Asset::parse(asset).ok()?;
        Some((entry.split_off(HEAD + length), facts))
    }

    /// Keeps a texture under its key. A cache that cannot be written to is no failure; the first
    /// error is returned, and later entries are not tried.
    ///
    /// # Errors
    /// Why the entry could not be written.
    pub fn put(&self, key: &Key, asset: &[u8], facts: &Facts) -> io::Result<()> {
        if self.full.load(Ordering::Relaxed) {
            return Ok(());
        }
        let written = self.write(key, asset, facts);
        if written.is_err() {
            self.full.store(true, Ordering::Relaxed);
        }
        written
    }

    fn write(&self, key: &Key, asset: &[u8], facts: &Facts) -> io::Result<()> {
        let place = self.place(key);
        if let Some(folder) = place.parent() {
            fs::create_dir_all(folder)?;
        }
        let facts = serde_json::to_vec(facts).map_err(io::Error::other)?;
        let length = (facts.len() as u32).to_le_bytes();
        let content = [&facts[..], asset].concat();
        let digest = digest(key, &length, &content);
        let entry = [&MAGIC[..], &digest, &length, &content].concat();
        write_atomic(&place, &entry).map_err(|error| error.source)
    }
}

fn digest(key: &Key, length: &[u8], content: &[u8]) -> [u8; 32] {
    let parts = Parts::new("entry").part(MAGIC).part(key.bytes());
    *parts.part(length).part(content).key().bytes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{back_end::lower::lower, front_ends::builtin};

    #[test]
    fn an_entry_counts_only_as_it_was_written_and_under_its_own_key() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::new(folder.path().join("deep/down"));
        let asset = lower(&builtin::texture(), None).unwrap().bytes;
        let facts = Facts {
            mu: 0.3,
            warnings: vec!["x".into()],
            ..Facts::default()
        };
        let key = Key::of(b"a");
        assert_eq!(cache.get(&key), None);
        cache.put(&key, &asset, &facts).unwrap();
        assert_eq!(cache.get(&key), Some((asset.clone(), facts.clone())));
        let place = cache.place(&key);
        let entry = fs::read(&place).unwrap();
        for at in (0..entry.len()).step_by(97) {
            let mut tampered = entry.clone();
            tampered[at] ^= 1;
            fs::write(&place, &tampered).unwrap();
            assert_eq!(cache.get(&key), None, "byte {at}");
        }
        for cut in [0, 7, HEAD - 1, HEAD, entry.len() - 1] {
            fs::write(&place, &entry[..cut]).unwrap();
            assert_eq!(cache.get(&key), None, "{cut} bytes");
        }
        let other = Key::of(b"b");
        fs::create_dir_all(cache.place(&other).parent().unwrap()).unwrap();
        fs::write(cache.place(&other), &entry).unwrap();
        assert_eq!(cache.get(&other), None);
        cache.put(&other, &asset, &facts).unwrap();
        assert!(cache.get(&other).is_some());
    }

    #[test]
    fn a_cache_that_cannot_be_written_says_so_once() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        let cache = Cache::new(file);
        assert!(cache.put(&Key::of(b"a"), b"", &Facts::default()).is_err());
        assert!(cache.put(&Key::of(b"b"), b"", &Facts::default()).is_ok());
    }
}

//! Textures that were made before, by their keys.
//!
//! An entry is a file named by its key. It begins with a digest of key and content, so an entry that
//! was damaged, moved or written by another version counts as missing. It is written beside its
//! place and renamed: two builds at once cannot disturb each other, because whatever either writes
//! under a key is the same. What lies at its place is replaced, never followed, and a folder in
//! which others can write is not used.

use super::{
    facts::Facts,
    user_folder::{check_folder, make_folder, open_plain, user_folder, variable},
};
use crate::sources::key::{Key, Parts};
use asperity_formats::Asset;
use asperity_io::input::InputKind;
use asperity_io::output::AtomicFile;
use std::{
    io::{self, Read as _},
    path::{Path, PathBuf},
    sync::atomic::{AtomicBool, Ordering},
};

/// First bytes of an entry: a magic, and the version of what follows.
const MAGIC: &[u8; 8] = b"ASPC\x01\0\0\0";
/// Bytes before the figures: magic, digest, length of the figures.
const HEAD: usize = 8 + 32 + 4;
/// The most bytes of an entry: figures, which are a few lines, and an asset.
const MOST: u64 = HEAD as u64 + 1024 * 1024 + InputKind::Asset.max_bytes();
/// Variable that names a folder for the cache.
const VARIABLE: &str = "ASPERITY_CACHE";

/// A folder of textures by their keys.
#[derive(Debug)]
pub struct Cache {
    folder: PathBuf,
    /// True after a failed write; no further writes are tried.
    full: AtomicBool,
}

/// The cache of this user: `ASPERITY_CACHE`, else the platform's folder for caches; `None` where no
/// variable names one.
#[must_use]
pub fn default_folder() -> Option<PathBuf> {
    if let Some(folder) = variable(VARIABLE) {
        return Some(folder);
    }
    user_folder("XDG_CACHE_HOME", ".cache", "Library/Caches")
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

    /// The cache in a folder that is chosen, else that of the user, else in `.asperity-cache` of this one.
    #[must_use]
    pub fn chosen(chosen: Option<PathBuf>, otherwise: &Path) -> Self {
        let folder = chosen.or_else(default_folder);
        Self::new(folder.unwrap_or_else(|| otherwise.join(".asperity-cache")))
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
        let place = self.place(key);
        self.check(&place).ok()?;
        let mut file = open_plain(&place, MOST).ok()?;
        let mut entry = vec![0; HEAD];
        file.read_exact(&mut entry).ok()?;
        // Before the rest is read: a file of holes takes as much memory as it has bytes.
        if !entry.starts_with(MAGIC) {
            return None;
        }
        file.take(MOST).read_to_end(&mut entry).ok()?;
        let (head, content) = entry.split_at_checked(HEAD)?;
        if head[8..40] != digest(key, &head[40..], content)[..] {
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
        // Of several threads that fail at the same time, one tells.
        if written.is_err() && self.full.swap(true, Ordering::Relaxed) {
            return Ok(());
        }
        written
    }

    fn write(&self, key: &Key, asset: &[u8], facts: &Facts) -> io::Result<()> {
        let place = self.place(key);
        make_folder(place.parent().unwrap_or(&self.folder))?;
        self.check(&place)?;
        let facts = serde_json::to_vec(facts).map_err(io::Error::other)?;
        let length = (facts.len() as u32).to_le_bytes();
        let content = [&facts[..], asset].concat();
        let digest = digest(key, &length, &content);
        let entry = [&MAGIC[..], &digest, &length, &content].concat();
        let write = || {
            let mut file = AtomicFile::replacing(&place)?;
            file.fill(&entry)?;
            file.commit()
        };
        write().map_err(|error| error.source)
    }

    /// Checks that the folders of an entry are the user's own.
    fn check(&self, place: &Path) -> io::Result<()> {
        // A user may keep the cache elsewhere by a link.
        check_folder(&self.folder, true)?;
        place
            .parent()
            .map_or(Ok(()), |within| check_folder(within, false))
    }
}

fn digest(key: &Key, length: &[u8], content: &[u8]) -> [u8; 32] {
    let parts = Parts::new("entry").part(MAGIC).part(key.bytes());
    *parts.part(length).part(content).key().bytes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{emit::lower::lower, sources::builtin};
    use std::fs;

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

    /// Whatever another program put where an entry belongs is neither read, waited for nor
    /// written through.
    #[cfg(unix)]
    #[test]
    fn an_entry_is_a_plain_file_or_missing() {
        use std::os::unix::fs::{PermissionsExt as _, symlink};
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::new(folder.path().join("cache"));
        let asset = lower(&builtin::texture(), None).unwrap().bytes;
        let facts = Facts::default();
        let key = Key::of(b"a");
        let place = cache.place(&key);
        cache.put(&key, &asset, &facts).unwrap();
        let entry = fs::read(&place).unwrap();
        let treasure = folder.path().join("treasure");
        let plants: [(&str, &dyn Fn()); 5] = [
            ("a link", &|| symlink(&treasure, &place).unwrap()),
            ("a link to a device", &|| {
                symlink("/dev/zero", &place).unwrap()
            }),
            ("a pipe", &|| {
                let made = std::process::Command::new("mkfifo").arg(&place).status();
                assert!(made.unwrap().success());
            }),
            ("a file of holes", &|| {
                let file = fs::File::create(&place).unwrap();
                file.set_len(1 << 34).unwrap();
            }),
            ("a long file that begins as an entry", &|| {
                fs::write(&place, &entry).unwrap();
                let file = fs::File::options().write(true).open(&place).unwrap();
                file.set_len(MOST + 1).unwrap();
            }),
        ];
        for (what, plant) in plants {
            // What the link points to would be an entry, if it were followed.
            fs::write(&treasure, &entry).unwrap();
            fs::remove_file(&place).unwrap();
            plant();
            assert_eq!(cache.get(&key), None, "{what}");
            cache.put(&key, &asset, &facts).unwrap();
            assert!(fs::symlink_metadata(&place).unwrap().is_file(), "{what}");
            assert!(cache.get(&key).is_some(), "{what}");
            fs::write(&place, b"").unwrap();
            assert_eq!(fs::read(&treasure).unwrap(), entry, "{what}");
        }
        cache.put(&key, &asset, &facts).unwrap();
        for open in [cache.folder(), place.parent().unwrap()] {
            fs::set_permissions(open, fs::Permissions::from_mode(0o777)).unwrap();
            assert_eq!(cache.get(&key), None);
            let error = Cache::new(cache.folder().into()).put(&key, &asset, &facts);
            let error = error.unwrap_err().to_string();
            assert!(error.contains("every user may write"), "{error}");
            fs::set_permissions(open, fs::Permissions::from_mode(0o700)).unwrap();
        }
        assert!(cache.get(&key).is_some());
    }

    #[test]
    fn a_cache_that_cannot_be_written_says_so_once_however_many_write() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        for _ in 0..50 {
            let cache = Cache::new(file.clone());
            let start = std::sync::Barrier::new(8);
            let put = &|n: u8| {
                start.wait();
                cache.put(&Key::of(&[n]), b"", &Facts::default()).is_err()
            };
            let told = std::thread::scope(|scope| {
                let threads = [0, 1, 2, 3, 4, 5, 6, 7].map(|n| scope.spawn(move || put(n)));
                threads.map(|thread| thread.join().unwrap())
            });
            assert_eq!(told.iter().filter(|told| **told).count(), 1);
        }
    }
}

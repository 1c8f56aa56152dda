//! A project: what is made in the studio is kept in a folder as it is made, and is there again tomorrow.
//!
//! | file | holds |
//! |---|---|
//! | `project.json` | what the page shows: the session, its slots, the library of what was chosen |
//! | `ID.asp`, `ID.json` | a texture, and how it was made |
//! | `lock` | nothing; one studio at a time holds it |

use crate::{
    error::{ApiError, refused},
    http::Status,
    texture::{ID_LETTERS, Record, Texture},
};
use asperity_io::{
    diagnostic::Fault,
    output::{self, OutputError},
    shown::counted,
};
use serde_json::Value;
use std::{
    collections::BTreeSet,
    fs::{self, File, TryLockError},
    io,
    path::{Path, PathBuf},
    sync::{Arc, Mutex, PoisonError},
};

const STATE: &str = "project.json";
const LOCK: &str = "lock";
/// Bytes of what the page shows.
pub(crate) const STATE_BYTES: u64 = 4 << 20;

/// A folder that this studio alone writes to.
#[derive(Debug)]
pub struct Project {
    folder: PathBuf,
    /// Locked as long as it is open.
    _lock: File,
    /// The page that writes: the one that asked last.
    page: Mutex<Option<String>>,
}

impl Project {
    /// Opens a project, or begins one in a new or empty folder. Textures that it no longer shows are removed.
    ///
    /// # Errors
    /// [`Fault`] for a folder of other files, one that cannot be written, and a project that another studio has open.
    pub fn open(folder: &Path) -> Result<Self, Fault> {
        let failed = |error: io::Error| {
            let what = format!("the project cannot be opened: {error}");
            Fault::new(what, "give a folder that you may write to, as --project").at(folder)
        };
        fs::create_dir_all(folder).map_err(failed)?;
        let others = fs::read_dir(folder)
            .map_err(failed)?
            .flatten()
            .map(|entry| entry.file_name())
            .filter(|name| name != LOCK)
            .count();
        if others > 0 && !Self::is_one(folder) {
            let what = format!(
                "no project, but {}",
                counted(others, "other file", "other files")
            );
            return Err(Fault::new(what, "give a new or an empty folder").at(folder));
        }
        let lock = File::create(folder.join(LOCK)).map_err(failed)?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let what = "another studio has this project open";
                let remedy = "use that one, or give another folder as --project";
                return Err(Fault::new(what, remedy).at(folder));
            }
            Err(TryLockError::Error(error)) => return Err(failed(error)),
        }
        let project = Self {
            folder: folder.to_owned(),
            _lock: lock,
            page: Mutex::default(),
        };
        project.tidy().map_err(failed)?;
        Ok(project)
    }

    /// Returns true for the folder of a project.
    #[must_use]
    pub fn is_one(folder: &Path) -> bool {
        folder.join(STATE).is_file()
    }

    /// Its name, that of the folder.
    pub(crate) fn name(&self) -> String {
        let name = self.folder.file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    }

    /// Removes the textures that the page shows no longer.
    fn tidy(&self) -> io::Result<()> {
        if !Self::is_one(&self.folder) {
            return fs::write(self.folder.join(STATE), "{}");
        }
        // What cannot be read may still be mended by hand.
        let state = fs::read(self.folder.join(STATE))?;
        let Ok(shown) = serde_json::from_slice(&state) else {
            return Ok(());
        };
        let shown = ids(&shown);
        for entry in fs::read_dir(&self.folder)?.flatten() {
            let path = entry.path();
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            if is_id(&stem) && !shown.contains(&*stem) {
                fs::remove_file(&path)?;
            }
        }
        Ok(())
    }

    /// What was shown last, JSON, for a page, which from then on is the one that writes.
    ///
    /// # Errors
    /// Where it cannot be read.
    pub(crate) fn state(&self, page: &str) -> Result<Vec<u8>, ApiError> {
        *self.page.lock().unwrap_or_else(PoisonError::into_inner) = Some(page.to_owned());
        fs::read(self.folder.join(STATE)).map_err(|error| {
            let error = format!("{}: {error}", self.folder.join(STATE).display());
            ApiError::new(Status::Internal, error, "see that the folder can be read")
        })
    }

    /// Keeps what the page shows: first the textures that it names, of those that `made` knows, and then that, all of it or
    /// nothing.
    ///
    /// # Errors
    /// For what is no JSON object, for a page that another one has followed, and where it cannot be written.
    pub(crate) fn save(
        &self,
        page: &str,
        state: &[u8],
        made: impl Fn(&str) -> Option<Arc<Texture>>,
    ) -> Result<(), ApiError> {
        let shown = serde_json::from_slice(state).ok().filter(Value::is_object);
        let shown = shown.ok_or_else(|| {
            let error = "a project is a JSON object";
            ApiError::new(Status::BadRequest, error, "reload the page")
        })?;
        let mut writer = self.page.lock().unwrap_or_else(PoisonError::into_inner);
        if writer.get_or_insert_with(|| page.to_owned()) != page {
            let error = "the project is open in another tab or window";
            let help = "go on there, or reload this page to go on here with what is shown there";
            return Err(ApiError::new(Status::Conflict, error, help));
        }
        let new = ids(&shown)
            .into_iter()
            .filter(|id| !self.files(id)[1].exists());
        for texture in new.filter_map(made) {
            self.keep(&texture).map_err(|error| refused(&error))?;
        }
        output::write_atomic(&self.folder.join(STATE), state).map_err(|error| refused(&error))
    }

    /// Keeps a texture: its record last, without which it does not count.
    fn keep(&self, texture: &Texture) -> Result<(), OutputError> {
        let [asset, record] = self.files(texture.id());
        // Plain structures of numbers and strings always serialise.
        let written = serde_json::to_vec(&texture.record()).unwrap_or_default();
        output::write_atomic(&asset, texture.asset())?;
        output::write_atomic(&record, &written)
    }

    /// A texture that was kept; `None` where it was not, or is damaged.
    pub(crate) fn texture(&self, id: &str) -> Option<Texture> {
        if !is_id(id) {
            return None;
        }
        let [asset, record] = self.files(id).map(fs::read);
        let record: Record = serde_json::from_slice(&record.ok()?).ok()?;
        let texture = Texture::restored(asset.ok()?, record).ok()?;
        (texture.id() == id).then_some(texture)
    }

    fn files(&self, id: &str) -> [PathBuf; 2] {
        ["asp", "json"].map(|ending| self.folder.join(format!("{id}.{ending}")))
    }
}

/// The names of textures in what the page shows.
fn ids(shown: &Value) -> BTreeSet<&str> {
    match shown {
        Value::String(text) if is_id(text) => BTreeSet::from([text.as_str()]),
        Value::Array(values) => values.iter().flat_map(ids).collect(),
        Value::Object(fields) => fields.values().flat_map(ids).collect(),
        _ => BTreeSet::new(),
    }
}

/// Returns true for what may be the name of a texture, and is no path.
fn is_id(text: &str) -> bool {
    text.len() == ID_LETTERS && text.bytes().all(|b| b.is_ascii_hexdigit())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{recipe::Operation, texture::Making};
    use asperity::{emit::lower::lower, sources::builtin};

    fn texture() -> Texture {
        let asset = lower(&builtin::texture(), None).unwrap();
        let operation = |_: &str| Operation::Compile {
            prompt: "grit".into(),
            seed: 3,
        };
        let making = Making {
            made: Some(serde_json::json!({"t": 0.1 + 0.2})),
            ..Making::default()
        };
        Texture::new(asset.bytes, making, operation).unwrap()
    }

    #[test]
    fn a_project_is_a_folder_of_its_own_that_one_studio_has_open() {
        let folder = tempfile::tempdir().unwrap();
        let own = folder.path().join("new/desk");
        let project = Project::open(&own).unwrap();
        assert!(Project::is_one(&own) && project.name() == "desk");
        assert_eq!(project.state("a").unwrap(), b"{}");
        let said = Project::open(&own).unwrap_err().to_string();
        assert!(said.contains("another studio"), "{said}");
        for state in [&b"[]"[..], b"", b"{"] {
            assert!(project.save("a", state, |_| None).is_err());
        }
        project.save("a", b"{\"at\":1}", |_| None).unwrap();
        project.state("b").unwrap();
        let late = project.save("a", b"{}", |_| None).unwrap_err();
        assert_eq!(late.status, Status::Conflict, "the newest page writes");
        drop(project);
        let again = Project::open(&own).unwrap();
        again.save("a", b"{\"at\":2}", |_| None).unwrap();
        assert_eq!(again.state("b").unwrap(), b"{\"at\":2}");
        let said = Project::open(folder.path()).unwrap_err().to_string();
        assert!(said.contains("1 other file"), "{said}");
    }

    #[test]
    fn a_texture_is_kept_to_the_byte_as_long_as_it_is_shown() {
        let folder = tempfile::tempdir().unwrap();
        let project = Project::open(folder.path()).unwrap();
        let texture = Arc::new(texture());
        let shown = texture.shown(None);
        let state = format!(
            "{{\"entries\":[{{\"texture\":{{\"id\":{:?}}}}}]}}",
            texture.id()
        );
        let made = |id: &str| (id == texture.id()).then(|| Arc::clone(&texture));
        project.save("", state.as_bytes(), made).unwrap();
        let kept = project.texture(texture.id()).unwrap();
        assert_eq!(kept.shown(None), shown);
        assert!(shown.contains("--seed 3"), "{shown}");
        for id in ["", "../project", &"f".repeat(ID_LETTERS)] {
            assert!(project.texture(id).is_none(), "{id}");
        }
        drop(project);
        let project = Project::open(folder.path()).unwrap();
        assert!(project.texture(texture.id()).is_some());
        let [asset, record] = project.files(texture.id());
        let whole = fs::read(&asset).unwrap();
        fs::write(&asset, &whole[..whole.len() - 1]).unwrap();
        assert!(project.texture(texture.id()).is_none(), "it is damaged");
        project.save("", b"{}", |_| None).unwrap();
        drop(project);
        drop(Project::open(folder.path()).unwrap());
        assert!(!asset.exists() && !record.exists());
        let project = Project::open(folder.path()).unwrap();
        folder.close().unwrap();
        assert!(
            project.save("", state.as_bytes(), made).is_err(),
            "it is said"
        );
    }
}

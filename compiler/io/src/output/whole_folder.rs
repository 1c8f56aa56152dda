//! A folder whose files appear together.

use super::{
    error::OutputError, folder::NewFolder, stream::is_standard_output, unfinished::unfinished,
};
use std::{
    fs,
    io::{self, Write as _},
    path::{Path, PathBuf},
};

/// A folder that is filled with files, also in folders below it and by several threads. They lie in a hidden folder
/// within until [`commit`](Self::commit) gives all of them their names. If it is dropped before, or interrupted, nothing
/// of it stays.
#[derive(Debug)]
pub struct WholeFolder {
    target: PathBuf,
    within: PathBuf,
    /// Removed after what is in it. `None` where the folder was there.
    made: Option<NewFolder>,
}

impl WholeFolder {
    /// Starts to fill a folder, which is made if its parent exists.
    ///
    /// # Errors
    /// [`OutputError`] for a folder in which there is something already, and where none can be made.
    pub fn create(target: &Path) -> Result<Self, OutputError> {
        let fail = |doing, source| OutputError {
            path: target.to_owned(),
            doing,
            source,
        };
        if is_standard_output(target) {
            let source = io::Error::from(io::ErrorKind::NotADirectory);
            return Err(fail("standard output cannot take several files", source));
        }
        let made = if target.is_dir() {
            let entries = fs::read_dir(target).map_err(|e| fail("cannot list the folder", e))?;
            if entries.take(1).count() > 0 {
                let source = io::Error::from(io::ErrorKind::DirectoryNotEmpty);
                return Err(fail("these files need a folder of their own", source));
            }
            None
        } else {
            Some(NewFolder::make(target)?)
        };
        // Under the lock, so that an interrupt sees it.
        let mut list = unfinished();
        let within = fs::canonicalize(target)
            .and_then(|folder| {
                tempfile::Builder::new()
                    .prefix(".asperity-")
                    .tempdir_in(folder)
            })
            .map_err(|e| fail("cannot write into the folder", e))?
            .keep();
        list.insert(within.clone());
        drop(list);
        Ok(Self {
            target: target.to_owned(),
            within,
            made,
        })
    }

    /// Writes a file; `name` is its path within the folder, parts separated by `/`. A file of this name that was written
    /// before is replaced.
    ///
    /// # Errors
    /// [`OutputError`] that names the file.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), OutputError> {
        let written = self.create_file(name).and_then(|mut file| {
            // Without the lock, which all threads share.
            file.write_all(bytes)
        });
        written.map_err(|source| OutputError {
            path: self.target.join(name),
            doing: "cannot write it",
            source,
        })
    }

    fn create_file(&self, name: &str) -> io::Result<fs::File> {
        let mut list = unfinished();
        let mut folder = self.within.clone();
        let (folders, file) = name.rsplit_once('/').unwrap_or(("", name));
        for part in folders.split_terminator('/') {
            folder.push(part);
            if list.insert(folder.clone()) {
                fs::create_dir(&folder)?;
            }
        }
        let path = folder.join(file);
        let file = fs::File::create(&path)?;
        list.insert(path);
        Ok(file)
    }

    /// Gives every file its name.
    ///
    /// # Errors
    /// [`OutputError`] where one cannot be renamed: then some have their names.
    pub fn commit(mut self) -> Result<(), OutputError> {
        let fail = |source| OutputError {
            path: self.target.clone(),
            doing: "cannot finish it",
            source,
        };
        // Under the lock: an interrupt waits until every file has its name.
        let list = unfinished();
        for entry in fs::read_dir(&self.within).map_err(fail)? {
            let entry = entry.map_err(fail)?;
            fs::rename(entry.path(), self.target.join(entry.file_name())).map_err(fail)?;
        }
        drop(list);
        if let Some(made) = self.made.take() {
            made.keep();
        }
        Ok(())
    }
}

impl Drop for WholeFolder {
    fn drop(&mut self) {
        let mut list = unfinished();
        // Once all have their names, it is empty.
        let _ = fs::remove_dir_all(&self.within);
        list.retain(|path| !path.starts_with(&self.within));
        drop(list);
        self.made = None;
    }
}

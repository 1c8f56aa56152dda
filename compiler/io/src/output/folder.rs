//! Named files in one folder.

use super::{
    error::{OpenError, OutputError},
    outputs::Outputs,
    stream::is_standard_output,
    unfinished::unfinished,
};
use std::{
    fs, io,
    path::{Path, PathBuf},
};

/// Writes named files into a folder, which is made if its parent exists. All of them are complete
/// before the first appears under its name.
///
/// # Errors
/// [`OutputError`]; a folder that was made is removed again.
pub fn write_folder(folder: &Path, files: &[(String, &[u8])]) -> Result<(), OutputError> {
    write_folder_beside(&[], folder, files).map_err(|error| match error {
        OpenError::Output(error) => error,
        // Without inputs, only the names can be at fault.
        _ => OutputError {
            path: folder.to_owned(),
            doing: "two files have the same name",
            source: io::ErrorKind::AlreadyExists.into(),
        },
    })
}

/// [`write_folder`] for a command that reads `inputs`, none of which may be written to.
///
/// # Errors
/// [`OpenError`] for a file that is an input, and where one cannot be written; a folder that was
/// made is removed again.
pub fn write_folder_beside(
    inputs: &[PathBuf],
    folder: &Path,
    files: &[(String, &[u8])],
) -> Result<(), OpenError> {
    let fail = |doing, source| OutputError {
        path: folder.to_owned(),
        doing,
        source,
    };
    if is_standard_output(folder) {
        let source = io::Error::from(io::ErrorKind::NotADirectory);
        return Err(fail("standard output cannot take several files", source).into());
    }
    let made = if folder.is_dir() {
        None
    } else {
        Some(NewFolder::make(folder)?)
    };
    let mut outputs = Outputs::beside(inputs);
    for (name, bytes) in files {
        let file = outputs.open(&folder.join(name))?;
        outputs.fill(file, bytes)?;
        // There may be more files than a process may have open.
        outputs.file(file).close()?;
    }
    outputs.commit()?;
    if let Some(made) = made {
        made.keep();
    }
    Ok(())
}

/// A folder that was made for files. It is removed again, if it is empty, unless it is kept. Its path has no links, as
/// those of the files in it, so that an interrupt finds them in order.
#[derive(Debug)]
pub struct NewFolder(PathBuf);

impl NewFolder {
    /// Makes a folder whose parent exists.
    ///
    /// # Errors
    /// [`OutputError`], also where there is a file or a folder already.
    pub fn make(folder: &Path) -> Result<Self, OutputError> {
        let fail = |doing, source| OutputError {
            path: folder.to_owned(),
            doing,
            source,
        };
        let mut list = unfinished();
        fs::create_dir(folder).map_err(|e| match e.kind() {
            io::ErrorKind::AlreadyExists if !folder.is_dir() => {
                fail("is a file", io::ErrorKind::NotADirectory.into())
            }
            _ => fail("cannot create the folder", e),
        })?;
        let path = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
        list.insert(path.clone());
        Ok(Self(path))
    }

    /// Lets it stay.
    pub fn keep(self) {
        unfinished().remove(&self.0);
        std::mem::forget(self);
    }
}

impl Drop for NewFolder {
    fn drop(&mut self) {
        unfinished().remove(&self.0);
        // A folder that is not empty holds finished files and stays.
        let _ = fs::remove_dir(&self.0);
    }
}

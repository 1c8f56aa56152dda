//! A folder that is there in full or not at all.

use super::ExportError;
use asperity_io::output::OutputError;
use std::{
    fs, io,
    path::{Path, PathBuf},
};

/// By this file a model folder is known.
const MARK: &str = "model.json";

/// Refuses a `target` that cannot become a model folder. Returns true if it is there.
pub(super) fn check(target: &Path) -> Result<bool, ExportError> {
    let existing = fs::symlink_metadata(target).is_ok();
    if existing && !is_replaceable(target) {
        return Err(ExportError::Occupied {
            path: target.to_owned(),
        });
    }
    fs::metadata(parent(target)).map_err(fail(target, "cannot reach its folder"))?;
    Ok(existing)
}

fn fail(target: &Path, doing: &'static str) -> impl FnOnce(io::Error) -> OutputError {
    let path = target.to_owned();
    move |source| OutputError {
        path,
        doing,
        source,
    }
}

/// Writes the files into a folder beside `target` and renames it over.
pub(super) fn write(target: &Path, files: &[(&'static str, Vec<u8>)]) -> Result<(), ExportError> {
    let fail = |doing| fail(target, doing);
    let parent = parent(target);
    let existing = check(target)?;
    let cannot = "cannot write beside it";
    let staged = tempfile::Builder::new()
        .prefix(".asperity-")
        .tempdir_in(&parent)
        .map_err(fail(cannot))?;
    for (name, bytes) in files {
        fs::write(staged.path().join(name), bytes).map_err(fail(cannot))?;
    }
    open_to_others(staged.path()).map_err(fail(cannot))?;
    if existing {
        // Two renames: for a moment there is no model, never half of one.
        let old = tempfile::Builder::new()
            .prefix(".asperity-")
            .tempdir_in(&parent)
            .map_err(fail(cannot))?;
        let aside = old.path().join("old");
        fs::rename(target, &aside).map_err(fail("cannot replace it"))?;
        if let Err(source) = fs::rename(staged.path(), target) {
            let _ = fs::rename(&aside, target);
            return Err(fail("cannot replace it")(source).into());
        }
    } else {
        fs::rename(staged.path(), target).map_err(fail("cannot finish it"))?;
    }
    // It has another name now, and stays.
    let _ = staged.keep();
    Ok(())
}

fn parent(target: &Path) -> PathBuf {
    match target.parent() {
        Some(parent) if parent != Path::new("") => parent.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// An empty folder, or a model.
fn is_replaceable(target: &Path) -> bool {
    let empty = || fs::read_dir(target).is_ok_and(|mut entries| entries.next().is_none());
    target.is_dir() && (target.join(MARK).is_file() || empty())
}

#[cfg(unix)]
fn open_to_others(folder: &Path) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt as _;
    // Temporary folders are private; a model is not.
    fs::set_permissions(folder, fs::Permissions::from_mode(0o755))
}

#[cfg(not(unix))]
fn open_to_others(_: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_model_replaces_a_model_and_leaves_nothing_beside() {
        let parent = tempfile::tempdir().unwrap();
        let target = parent.path().join("model");
        let old = [(MARK, b"old".to_vec()), ("gone.onnx", b"x".to_vec())];
        write(&target, &old).unwrap();
        write(&target, &[(MARK, b"new".to_vec())]).unwrap();
        assert_eq!(names(parent.path()), ["model"]);
        assert_eq!(names(&target), [MARK]);
        assert_eq!(fs::read(target.join(MARK)).unwrap(), b"new");
    }

    #[test]
    fn a_folder_of_something_else_is_left_alone() {
        let parent = tempfile::tempdir().unwrap();
        let target = parent.path().join("photos");
        fs::create_dir(&target).unwrap();
        fs::write(target.join("cat.png"), b"cat").unwrap();
        let error = write(&target, &[(MARK, b"new".to_vec())]).unwrap_err();
        assert!(matches!(error, ExportError::Occupied { .. }));
        assert_eq!(names(&target), ["cat.png"]);
        assert_eq!(names(parent.path()), ["photos"]);
    }
}

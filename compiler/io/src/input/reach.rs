//! Which files a list may name: any, or only those in its own folder.
//!
//! A list that others sent may name any file that its reader can read, and what is made of them
//! tells what is in them. Within a folder, a path that could lead out is refused before anything is
//! asked about the file.

use std::{
    fs, io,
    path::{Component, Path, PathBuf},
};
use thiserror::Error;

/// Which files a list may name.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Reach {
    /// Any that its reader can read.
    #[default]
    Anywhere,
    /// Those in a folder, by its path without links.
    Within(PathBuf),
}

/// The way in which a path leaves the folder of its list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum Outside {
    /// It begins at the root, or at a drive.
    #[error("an absolute path")]
    Absolute,
    /// It goes up.
    #[error("a path with `..`")]
    Up,
    /// A symbolic link on the way leads out, or nowhere.
    #[error("a link that leaves the folder")]
    Link,
}

impl Reach {
    /// The reach of a list that may name only files in its own folder.
    ///
    /// # Errors
    /// Why the folder cannot be found.
    pub fn beside(list: &Path) -> io::Result<Self> {
        let folder = match list.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        Ok(Self::Within(fs::canonicalize(folder)?))
    }

    /// Checks a path that a list states, which is `file` when seen from here. A file that is not
    /// there is no fault: whoever opens it says so.
    ///
    /// # Errors
    /// How the path leads out.
    pub fn check(&self, stated: &Path, file: &Path) -> Result<(), Outside> {
        let Self::Within(root) = self else {
            return Ok(());
        };
        for component in stated.components() {
            match component {
                Component::Normal(_) | Component::CurDir => {}
                Component::ParentDir => return Err(Outside::Up),
                Component::RootDir | Component::Prefix(_) => return Err(Outside::Absolute),
            }
        }
        // Of a file that is not there, the folders above may still be links.
        let mut there = file;
        loop {
            match fs::canonicalize(there) {
                Ok(found) if found.starts_with(root) => return Ok(()),
                Ok(_) => return Err(Outside::Link),
                Err(_) if fs::symlink_metadata(there).is_ok() => return Err(Outside::Link),
                Err(_) => {}
            }
            there = match there.parent() {
                Some(above) if above != Path::new("") => above,
                _ => return Ok(()),
            };
        }
    }

    /// Checks a folder, and all that lies in it, as [`check`](Self::check) does.
    ///
    /// # Errors
    /// How the path, or a file of the folder, leads out.
    pub fn check_folder(&self, stated: &Path, folder: &Path) -> Result<(), Outside> {
        self.check(stated, folder)?;
        if *self == Self::Anywhere {
            return Ok(());
        }
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let file = entry.path();
            self.check(Path::new(&entry.file_name()), &file)?;
        }
        Ok(())
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    #[test]
    fn only_what_lies_in_the_folder_is_within_reach() {
        let outer = tempfile::tempdir().unwrap();
        let folder = outer.path().join("lists");
        fs::create_dir_all(folder.join("sub/model")).unwrap();
        for file in [
            "lists/in.asp",
            "lists/sub/in.asp",
            "out.asp",
            "lists/sub/model/a.onnx",
        ] {
            fs::write(outer.path().join(file), "").unwrap();
        }
        let link = |to: &Path, name: &str| symlink(to, folder.join(name)).unwrap();
        link(&outer.path().join("out.asp"), "leaves.asp");
        link(Path::new("../out.asp"), "climbs.asp");
        link(outer.path(), "up");
        link(&folder.join("in.asp"), "stays.asp");
        link(Path::new("gone.asp"), "dangling.asp");
        let reach = Reach::beside(&folder.join("list.toml")).unwrap();
        let absolute = folder.join("in.asp");
        for (stated, outside) in [
            ("in.asp", None),
            ("./sub/in.asp", None),
            ("stays.asp", None),
            ("gone.asp", None),
            ("gone/gone.asp", None),
            (absolute.to_str().unwrap(), Some(Outside::Absolute)),
            ("../out.asp", Some(Outside::Up)),
            ("sub/../in.asp", Some(Outside::Up)),
            ("leaves.asp", Some(Outside::Link)),
            ("climbs.asp", Some(Outside::Link)),
            ("up/out.asp", Some(Outside::Link)),
            ("up/gone.asp", Some(Outside::Link)),
            ("dangling.asp", Some(Outside::Link)),
        ] {
            let file = folder.join(stated);
            let checked = reach.check(Path::new(stated), &file);
            assert_eq!(checked.err(), outside, "{stated}");
            assert_eq!(Reach::Anywhere.check(Path::new(stated), &file), Ok(()));
        }
        let model =
            |reach: &Reach| reach.check_folder(Path::new("sub/model"), &folder.join("sub/model"));
        assert_eq!(model(&reach), Ok(()));
        link(&outer.path().join("out.asp"), "sub/model/b.onnx");
        assert_eq!(model(&reach), Err(Outside::Link));
        assert_eq!(model(&Reach::Anywhere), Ok(()));
    }
}

//! Folders of the user's own, and plain files in them: what others could have put there is not opened.

use std::{
    env,
    fs::{self, DirBuilder, File, Metadata, OpenOptions},
    io,
    path::{Path, PathBuf},
};

/// Asperity's part of a folder of this user: that of an XDG variable, else below the home folder; on macOS the one named
/// last, on Windows that for local data. `None` where no variable names one.
#[must_use]
pub fn user_folder(xdg: &str, home: &str, macos: &str) -> Option<PathBuf> {
    let platform = if cfg!(windows) {
        variable("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        variable("HOME").map(|folder| folder.join(macos))
    } else {
        // The XDG specification ignores relative paths.
        let xdg = variable(xdg).filter(|folder| folder.is_absolute());
        xdg.or_else(|| variable("HOME").map(|folder| folder.join(home)))
    };
    platform.map(|folder| folder.join("asperity"))
}

/// A path that an environment variable holds.
pub(super) fn variable(name: &str) -> Option<PathBuf> {
    let value = env::var_os(name).filter(|value| !value.is_empty());
    value.map(PathBuf::from)
}

/// Checks a folder: the user's own, and none in which every user may write, rename and remove.
/// `links` says whether the folder may be reached through a symbolic link.
///
/// # Errors
/// Why its files are not to be relied on, or [`io::ErrorKind::NotFound`].
pub(super) fn check_folder(folder: &Path, links: bool) -> io::Result<()> {
    let metadata = if links {
        fs::metadata(folder)?
    } else {
        fs::symlink_metadata(folder)?
    };
    if !metadata.is_dir() {
        return Err(io::ErrorKind::NotADirectory.into());
    }
    #[cfg(unix)]
    own(&metadata, rustix::process::geteuid().as_raw()).map_err(|why| {
        let why = format!("{why}; choose another folder with --cache");
        io::Error::new(io::ErrorKind::PermissionDenied, why)
    })?;
    Ok(())
}

#[cfg(unix)]
fn own(metadata: &Metadata, user: u32) -> Result<(), &'static str> {
    use std::os::unix::fs::MetadataExt as _;
    const OTHERS_WRITE: u32 = 0o002;
    const STICKY: u32 = 0o1000;
    if metadata.uid() != user {
        return Err("another user owns the folder");
    }
    if metadata.mode() & OTHERS_WRITE != 0 && metadata.mode() & STICKY == 0 {
        return Err("every user may write to the folder");
    }
    Ok(())
}

/// Makes a folder, and those above it, for the user alone. One that is there stays as it is.
pub(super) fn make_folder(folder: &Path) -> io::Result<()> {
    let mut builder = DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(folder)
}

/// Opens a regular file of `most` bytes at most. A symbolic link is not followed, and neither a
/// pipe nor a device is waited for.
///
/// # Errors
/// Why it cannot be opened, and [`io::ErrorKind::InvalidData`] for anything else.
pub(super) fn open_plain(path: &Path, most: u64) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.read(true);
    #[cfg(unix)]
    {
        use rustix::fs::OFlags;
        use std::os::unix::fs::OpenOptionsExt as _;
        let flags = OFlags::NOFOLLOW | OFlags::NONBLOCK;
        options.custom_flags(flags.bits().cast_signed());
    }
    #[cfg(windows)]
    {
        use std::os::windows::fs::OpenOptionsExt as _;
        // A link is then opened itself, and is no regular file.
        const FILE_FLAG_OPEN_REPARSE_POINT: u32 = 0x0020_0000;
        options.custom_flags(FILE_FLAG_OPEN_REPARSE_POINT);
    }
    let file = options.open(path)?;
    let is_plain = |found: Metadata| found.is_file() && found.len() <= most;
    if is_plain(file.metadata()?) {
        Ok(file)
    } else {
        Err(io::ErrorKind::InvalidData.into())
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::{MetadataExt as _, PermissionsExt as _, symlink};

    #[test]
    fn a_folder_counts_only_if_it_is_the_users_own_and_closed_to_others() {
        let folder = tempfile::tempdir().unwrap();
        let (folder, link) = (folder.path().join("own"), folder.path().join("link"));
        make_folder(&folder).unwrap();
        symlink(&folder, &link).unwrap();
        assert!(check_folder(&folder, false).is_ok());
        assert!(check_folder(&link, true).is_ok() && check_folder(&link, false).is_err());
        let metadata = fs::metadata(&folder).unwrap();
        assert_eq!(metadata.mode() & 0o777, 0o700);
        assert!(
            own(&metadata, metadata.uid() + 1)
                .unwrap_err()
                .contains("another user")
        );
        for (mode, counts) in [(0o755, true), (0o775, true), (0o1777, true), (0o777, false)] {
            fs::set_permissions(&folder, fs::Permissions::from_mode(mode)).unwrap();
            assert_eq!(check_folder(&folder, false).is_ok(), counts, "{mode:o}");
        }
    }
}

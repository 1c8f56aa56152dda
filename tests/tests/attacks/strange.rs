//! What a path can lead to besides a file with bytes.

use asperity_tests::draw::Draw;
use std::{
    fs::{self, File, Permissions},
    os::unix::fs::{PermissionsExt as _, symlink},
    path::Path,
    process::Command,
};

/// What stands in the place of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Strange {
    Missing,
    Empty,
    Folder,
    Unreadable,
    LinkToItself,
    LinkToNothing,
    LinkToParent,
    Zero,
    Null,
    Random,
    Full,
    Sparse,
    Socket,
    Pipe,
}

use Strange::*;

impl Strange {
    /// One of them; pipes seldom, because a command waits for each.
    pub(crate) fn drawn(must_be_refused: bool, draw: &mut Draw) -> Self {
        const ALL: [Strange; 13] = [
            Missing,
            Empty,
            Folder,
            Unreadable,
            LinkToItself,
            LinkToNothing,
            LinkToParent,
            Zero,
            Null,
            Random,
            Full,
            Sparse,
            Socket,
        ];
        // In a folder of materials, only what the system takes for a file is read.
        const REFUSED: [Strange; 2] = [Empty, Sparse];
        if must_be_refused {
            return REFUSED[draw.below(REFUSED.len())];
        }
        if draw.below(15) == 0 {
            return Pipe;
        }
        ALL[draw.below(ALL.len())]
    }

    /// Makes it.
    pub(crate) fn make(self, path: &Path) {
        // A name that the system does not take stays missing.
        match self {
            Missing => {}
            Empty => drop(File::create(path)),
            Folder => drop(fs::create_dir(path)),
            Unreadable => {
                let _ = fs::write(path, b"nobody reads this");
                let _ = fs::set_permissions(path, Permissions::from_mode(0o000));
            }
            LinkToItself => drop(symlink(path, path)),
            LinkToNothing => drop(symlink("nothing", path)),
            LinkToParent => drop(symlink("..", path)),
            Zero => drop(symlink("/dev/zero", path)),
            Null => drop(symlink("/dev/null", path)),
            Random => drop(symlink("/dev/urandom", path)),
            Full => drop(symlink("/dev/full", path)),
            Sparse => drop(File::create(path).and_then(|file| file.set_len(1 << 40))),
            // The name of a socket is short; a missing file is a case as well.
            Socket => drop(std::os::unix::net::UnixListener::bind(path)),
            Pipe => drop(Command::new("mkfifo").arg(path).output()),
        }
    }
}

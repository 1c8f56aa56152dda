//! Targets of a path other than a file with bytes.

use asperity_tests::draw::Draw;
use std::{
    fs::{self, File, Permissions},
    os::unix::fs::{PermissionsExt as _, symlink},
    path::Path,
    process::Command,
};

/// A substitute for a regular file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Strange {
    Missing,
    Empty,
    Folder,
    Unreadable,
    LinkToItself,
    LinkToNothing,
    LinkToParent,
    LinkToFile,
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
    /// All of them.
    pub(crate) const ALL: [Self; 15] = [
        Pipe,
        Missing,
        Empty,
        Folder,
        Unreadable,
        LinkToItself,
        LinkToNothing,
        LinkToParent,
        LinkToFile,
        Zero,
        Null,
        Random,
        Full,
        Sparse,
        Socket,
    ];

    /// Draws a substitute; pipes seldom, because a command waits for each.
    pub(crate) fn drawn(must_be_refused: bool, draw: &mut Draw) -> Self {
        // In a folder of materials, only what the system takes for a file is read.
        const REFUSED: [Strange; 2] = [Empty, Sparse];
        if must_be_refused {
            return REFUSED[draw.below(REFUSED.len())];
        }
        if draw.below(15) == 0 {
            return Pipe;
        }
        Self::ALL[1 + draw.below(Self::ALL.len() - 1)]
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
            // A valid file of another kind, which nobody may write to.
            LinkToFile => {
                let mut folders = path.ancestors().skip(1);
                let good = folders.find_map(|folder| folder.join("good.asp").canonicalize().ok());
                drop(good.map(|good| symlink(good, path)));
            }
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

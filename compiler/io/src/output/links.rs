//! Where a path leads.

use std::{
    fs,
    path::{Path, PathBuf},
};

/// Links that are followed at most, as the system does.
const MOST_LINKS: usize = 40;

/// The path without symbolic links, also of a file that is not there yet.
pub(super) fn followed(path: &Path) -> PathBuf {
    if let Ok(there) = fs::canonicalize(path) {
        return there;
    }
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        // The target of a link is relative to the link's folder.
        match fs::read_link(&path) {
            Ok(to) => path = folder(&path).join(to),
            Err(_) => break,
        }
    }
    let within = folder(&path);
    let within = fs::canonicalize(within).unwrap_or_else(|_| within.to_owned());
    match path.file_name() {
        Some(name) => within.join(name),
        None => path,
    }
}

/// The folder that a path is in.
pub(super) fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

//! Remedies for system errors on opening, reading or writing a file.

use std::io::{Error, ErrorKind};

/// The remedy of a cause that lies in the system rather than in the path; `None` for any other.
#[must_use]
pub fn remedy(error: &Error) -> Option<&'static str> {
    if is_out_of_files(error) {
        return Some(
            "close other files, or allow more open ones: `ulimit -n`, or the limit of the service",
        );
    }
    Some(match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "free space on the disk, or give a path on another one"
        }
        ErrorKind::FileTooLarge => {
            "allow larger files: `ulimit -f`, or a file system that holds them"
        }
        ErrorKind::OutOfMemory => {
            "free memory, or allow more: `ulimit -v`, or the container's limit"
        }
        // A thread or a lock that the system does not give now.
        ErrorKind::WouldBlock => {
            "allow more processes and threads: `ulimit -u`, or the limit of the container or service"
        }
        ErrorKind::ReadOnlyFilesystem => "give a path on a file system that can be written to",
        _ => return None,
    })
}

/// Returns true if this process, or the whole system, has reached its limit of open files.
fn is_out_of_files(error: &Error) -> bool {
    // ENFILE and EMFILE have no kind of their own, and these numbers on every Unix.
    #[cfg(unix)]
    return matches!(error.raw_os_error(), Some(23 | 24));
    // ERROR_TOO_MANY_OPEN_FILES.
    #[cfg(not(unix))]
    return error.raw_os_error() == Some(4);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_of_the_system_are_told_apart_from_permissions() {
        #[cfg(unix)]
        for (errno, named) in [
            (23, "ulimit -n"),
            (24, "ulimit -n"),
            (27, "ulimit -f"),
            (28, "space"),
            (30, "file system"),
        ] {
            let told = remedy(&Error::from_raw_os_error(errno));
            assert!(
                told.is_some_and(|told| told.contains(named)),
                "{errno}: {told:?}"
            );
        }
        for path in [ErrorKind::NotFound, ErrorKind::PermissionDenied] {
            assert_eq!(remedy(&path.into()), None);
        }
    }
}

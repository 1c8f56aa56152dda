//! Where the library may be, by convention of the platform.

use std::{
    env,
    ffi::OsStr,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

/// Names under which the system's loader may know the library.
pub(crate) const SYSTEM_NAMES: &[&str] = if cfg!(windows) {
    &["onnxruntime.dll"]
} else if cfg!(target_os = "macos") {
    &[
        "libonnxruntime.dylib",
        "/opt/homebrew/lib/libonnxruntime.dylib",
    ]
} else {
    &["libonnxruntime.so", "libonnxruntime.so.1"]
};

/// Returns true if a file is the library itself, not a provider library or a source file.
fn is_library(name: &OsStr) -> bool {
    let Some(name) = name.to_str() else {
        return false;
    };
    if cfg!(windows) {
        return name.eq_ignore_ascii_case("onnxruntime.dll");
    }
    if cfg!(target_os = "macos") {
        return name.starts_with("libonnxruntime.") && name.ends_with(".dylib");
    }
    name == "libonnxruntime.so" || name.starts_with("libonnxruntime.so.")
}

/// The libraries in a folder in descending order of name; none if the folder cannot be read.
pub(crate) fn in_folder(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut found: Vec<PathBuf> = entries
        .filter(|entry| is_library(&entry.file_name()))
        .map(|entry| entry.path())
        .collect();
    found.sort_unstable_by(|a, b| b.cmp(a));
    found
}

/// The folder of the running program, and `lib` beside it.
pub(crate) fn beside_executable() -> Vec<PathBuf> {
    let Ok(executable) = env::current_exe() else {
        return Vec::new();
    };
    let folder = executable.parent().unwrap_or(Path::new(""));
    vec![folder.to_owned(), folder.join("lib"), folder.join("../lib")]
}

/// The `onnxruntime/capi` folders of the Python installations that answer.
pub(crate) fn python_packages() -> Vec<PathBuf> {
    let interpreters: &[&str] = if cfg!(windows) {
        &["python", "py"]
    } else {
        &["python3"]
    };
    let packages = interpreters
        .iter()
        .filter_map(|interpreter| ask(interpreter));
    packages
        .map(|package| package.join("capi"))
        .filter(|folder| folder.is_dir())
        .collect()
}

/// The folder of the package, as an interpreter sees it.
///
/// The package is not imported. The working folder is not searched, since a folder of that name
/// there is not an installation.
fn ask(interpreter: &str) -> Option<PathBuf> {
    const QUESTION: &str = "import sys; sys.path = [p for p in sys.path if p]; \
        from importlib.util import find_spec; s = find_spec('onnxruntime'); \
        print(s.submodule_search_locations[0] if s else '')";
    let output = Command::new(interpreter)
        .args(["-c", QUESTION])
        .stdin(Stdio::null())
        .stderr(Stdio::null())
        .output()
        .ok()?;
    let answer = String::from_utf8(output.stdout).ok()?;
    let answer = answer.trim();
    (output.status.success() && !answer.is_empty()).then(|| PathBuf::from(answer))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(target_os = "linux")]
    fn only_the_library_itself_counts() {
        let accepted = [
            "libonnxruntime.so",
            "libonnxruntime.so.1",
            "libonnxruntime.so.1.31.1",
        ];
        let refused = [
            "libonnxruntime_providers_shared.so",
            "onnxruntime.dll",
            "libonnxruntime.a",
        ];
        assert!(accepted.iter().all(|name| is_library(OsStr::new(name))));
        assert!(!refused.iter().any(|name| is_library(OsStr::new(name))));
    }

    #[test]
    fn a_missing_folder_has_no_libraries() {
        assert!(in_folder(Path::new("no such folder")).is_empty());
    }
}

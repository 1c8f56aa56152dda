//! Outputs that would destroy an input, or each other.

use crate::diagnostic::Diagnostic;
use std::{
    fs,
    path::{Path, PathBuf},
};
use thiserror::Error;

/// An output that is also an input, or another output.
#[derive(Debug, Error)]
#[error("{output}: it is also {other}", output = output.display())]
pub struct SameFile {
    /// The output.
    pub output: PathBuf,
    /// What else it is: `an input` or `another output`.
    pub other: &'static str,
}

impl Diagnostic for SameFile {
    fn remedy(&self) -> String {
        "give every output a path of its own".into()
    }

    fn is_usage(&self) -> bool {
        true
    }
}

/// Refuses outputs that are also inputs or other outputs, by whatever path or link they are
/// reached. Pipes and devices are written to, not replaced, so they may appear twice.
///
/// # Errors
/// [`SameFile`] with the first such output.
pub fn distinct(inputs: &[&Path], outputs: &[&Path]) -> Result<(), SameFile> {
    let fail = |output: &Path, other| {
        Err(SameFile {
            output: output.to_owned(),
            other,
        })
    };
    for (index, output) in outputs.iter().enumerate() {
        if fs::metadata(output).is_ok_and(|m| !m.is_file()) {
            continue;
        }
        let file = resolved(output);
        if inputs.iter().any(|input| resolved(input) == file) {
            return fail(output, "an input");
        }
        if outputs[..index].iter().any(|other| resolved(other) == file) {
            return fail(output, "another output");
        }
    }
    Ok(())
}

/// The path without links; of a file that is not there yet, its folder without links.
fn resolved(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| {
        let folder = match path.parent() {
            Some(parent) if parent != Path::new("") => parent,
            _ => Path::new("."),
        };
        let folder = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
        folder.join(path.file_name().unwrap_or_default())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_file_by_two_paths_is_found() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::write(at("in.json"), b"{}").unwrap();
        fs::create_dir(at("sub")).unwrap();
        let input = at("in.json");
        let detour = at("sub/../in.json");
        assert!(distinct(&[&input], &[&at("out.asp")]).is_ok());
        let same = distinct(&[&input], &[&detour]).unwrap_err();
        assert_eq!(same.other, "an input");
        let (new, again) = (at("new.asp"), at("sub/../new.asp"));
        let twice = distinct(&[], &[&new, &again]).unwrap_err();
        assert_eq!(twice.other, "another output");
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(&input, at("link")).unwrap();
            assert!(distinct(&[&input], &[&at("link")]).is_err());
            let null = Path::new("/dev/null");
            assert!(distinct(&[], &[null, null]).is_ok());
        }
    }
}

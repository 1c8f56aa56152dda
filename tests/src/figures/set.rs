//! A set of figures, as its file holds it.

use serde::{Deserialize, Serialize};
use std::{
    collections::BTreeMap,
    error::Error,
    fmt, fs, io,
    path::{Path, PathBuf},
    process::Command,
};

/// A figure, as pages print it: a number, or lines such as a table.
pub type Figure = String;

/// Figures of one command.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Set {
    /// The command that measures them.
    pub command: String,
    /// Machine, compiler and settings, where figures depend on them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub conditions: Option<String>,
    /// When they were measured; none where a test of `.ci/run` holds them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured: Option<Measured>,
    /// The figures by name.
    pub figures: BTreeMap<String, Figure>,
}

/// What was measured, so that a later change of it can be told.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// The commit that was checked out.
    pub commit: String,
    /// Files and folders that decide the figures, from the top of the project.
    pub paths: Vec<PathBuf>,
    /// CRC-32 over their tracked files, in hexadecimal.
    pub crc32: String,
}

/// A file of figures that cannot be used.
#[derive(Debug)]
pub struct SetError {
    file: PathBuf,
    cause: String,
}

impl fmt::Display for SetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.file.display(), self.cause)
    }
}

impl Error for SetError {}

impl Set {
    /// Figures that a test holds.
    pub fn new<const N: usize>(command: &str, figures: [(&str, Figure); N]) -> Self {
        let named = figures.map(|(name, figure)| (name.to_owned(), figure));
        Self {
            command: command.to_owned(),
            conditions: None,
            measured: None,
            figures: named.into(),
        }
    }

    /// These figures, under `conditions`.
    #[must_use]
    pub fn under(mut self, conditions: String) -> Self {
        self.conditions = Some(conditions);
        self
    }

    /// These figures as of what `paths` hold now.
    ///
    /// # Errors
    /// [`io::Error`] where git does not run or a file cannot be read.
    pub fn of_now(mut self, root: &Path, paths: &[&str]) -> io::Result<Self> {
        let paths: Vec<PathBuf> = paths.iter().map(PathBuf::from).collect();
        self.measured = Some(Measured {
            commit: git(root, &["rev-parse", "--short=12", "HEAD"])?
                .trim()
                .to_owned(),
            crc32: crc32(root, &paths)?,
            paths,
        });
        Ok(self)
    }

    /// The set of a file.
    ///
    /// # Errors
    /// [`SetError`] for a file that cannot be read or is no set.
    pub fn read(file: &Path) -> Result<Self, SetError> {
        let error = |cause: String| SetError {
            file: file.to_owned(),
            cause,
        };
        let text = fs::read_to_string(file).map_err(|cause| error(cause.to_string()))?;
        toml::from_str(&text).map_err(|cause| error(cause.to_string()))
    }

    /// Writes the set.
    ///
    /// # Errors
    /// [`SetError`] for a file that cannot be written.
    pub fn write(&self, file: &Path) -> Result<(), SetError> {
        let error = |cause: String| SetError {
            file: file.to_owned(),
            cause,
        };
        let text = toml::to_string_pretty(self).map_err(|cause| error(cause.to_string()))?;
        let text = format!("# Written by its command. Pages quote it between markers.\n{text}");
        fs::write(file, text).map_err(|cause| error(cause.to_string()))
    }

    /// Whether what was measured has changed since; `None` where a test holds the figures.
    ///
    /// # Errors
    /// [`io::Error`] where git does not run or a file cannot be read.
    pub fn is_stale(&self, root: &Path) -> io::Result<Option<bool>> {
        let now = |m: &Measured| Ok(crc32(root, &m.paths)? != m.crc32);
        self.measured.as_ref().map(now).transpose()
    }
}

/// CRC-32 over names and contents of the tracked files under `paths`.
fn crc32(root: &Path, paths: &[PathBuf]) -> io::Result<String> {
    let mut arguments = vec!["ls-files", "-z", "--"];
    arguments.extend(paths.iter().filter_map(|path| path.to_str()));
    let mut crc = crc32fast::Hasher::new();
    for file in git(root, &arguments)?.split_terminator('\0') {
        crc.update(file.as_bytes());
        crc.update(&fs::read(root.join(file))?);
    }
    Ok(format!("{:08x}", crc.finalize()))
}

fn git(root: &Path, arguments: &[&str]) -> io::Result<String> {
    let output = Command::new("git")
        .current_dir(root)
        .args(arguments)
        .output()?;
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    let text = output.status.success().then_some(output.stdout);
    text.and_then(|bytes| String::from_utf8(bytes).ok())
        .ok_or_else(|| io::Error::other(format!("git {}: {error}", arguments.join(" "))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_comes_back_from_its_file() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("set.toml");
        let set = Set::new("cargo test", [("table", "| a |\n|---|\n| 1 |".to_owned())]);
        set.write(&file).unwrap();
        assert_eq!(Set::read(&file).unwrap(), set);
        fs::write(&file, "command = 3").unwrap();
        assert!(Set::read(&file).is_err());
    }

    #[test]
    fn a_set_is_stale_once_what_it_measures_has_changed() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        fs::create_dir(root.join("src")).unwrap();
        fs::write(root.join("src/a"), "one").unwrap();
        fs::write(root.join("b"), "one").unwrap();
        let who = ["-c", "user.name=a", "-c", "user.email=a@b"];
        git(root, &["init", "-q"]).unwrap();
        git(root, &["add", "-A"]).unwrap();
        git(root, &[&who[..], &["commit", "-qm", "one"]].concat()).unwrap();
        let set = Set::new("x", []).of_now(root, &["src"]).unwrap();
        assert_eq!(set.is_stale(root).unwrap(), Some(false));
        fs::write(root.join("b"), "two").unwrap();
        assert_eq!(set.is_stale(root).unwrap(), Some(false));
        fs::write(root.join("src/a"), "two").unwrap();
        assert_eq!(set.is_stale(root).unwrap(), Some(true));
        assert_eq!(Set::new("x", []).is_stale(root).unwrap(), None);
    }
}

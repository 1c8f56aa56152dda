//! A set of figures, as its file holds it.

use serde::{Deserialize, Serialize};
use std::{
    collections::BTreeMap,
    error::Error,
    fmt, fs, io,
    path::{Path, PathBuf},
    process::Command,
};

/// Figures of one command.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Set {
    /// The command that measures them.
    pub command: String,
    /// Machine, compiler and settings, where figures depend on them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub conditions: Option<String>,
    /// When they were measured; none where a test holds them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured: Option<Measured>,
    /// The figures by name, as pages print them: a number, or lines such as a table.
    #[serde(default)]
    pub figures: BTreeMap<String, String>,
}

/// Inputs of the measurement, to detect later changes.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// The commit that was checked out.
    #[serde(default)]
    pub commit: String,
    /// Files and folders that decide the figures, from the top of the project.
    pub paths: Vec<PathBuf>,
    /// CRC-32 over their files, in hexadecimal; empty where nobody knows it any more, so that the set is stale.
    #[serde(default)]
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
    pub fn new(
        command: &str,
        figures: impl IntoIterator<Item = (impl Into<String>, String)>,
    ) -> Self {
        let named = figures
            .into_iter()
            .map(|(name, figure)| (name.into(), figure));
        Self {
            command: command.to_owned(),
            conditions: None,
            measured: None,
            figures: named.collect(),
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
    /// [`io::Error`] where a file cannot be read.
    pub fn of_now(mut self, root: &Path, paths: Vec<PathBuf>) -> io::Result<Self> {
        self.measured = Some(Measured {
            commit: commit(root),
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

    /// Returns true if the measured files have changed since; `None` where a test holds the figures.
    ///
    /// # Errors
    /// [`io::Error`] where a file cannot be read.
    pub fn is_stale(&self, root: &Path) -> io::Result<Option<bool>> {
        let now = |m: &Measured| Ok(crc32(root, &m.paths)? != m.crc32);
        self.measured.as_ref().map(now).transpose()
    }
}

/// CRC-32 over names and contents of the files under `paths`, without pages, which measure nothing.
fn crc32(root: &Path, paths: &[PathBuf]) -> io::Result<String> {
    let mut crc = crc32fast::Hasher::new();
    for path in paths {
        let measures = |file: &PathBuf| file.extension().is_none_or(|e| e != "md");
        for file in files(root, path)?.into_iter().filter(measures) {
            crc.update(file.to_string_lossy().as_bytes());
            crc.update(&fs::read(root.join(file))?);
        }
    }
    Ok(format!("{:08x}", crc.finalize()))
}

/// The files under a path, from `root` and in order, without hidden ones and what is built.
///
/// # Errors
/// [`io::Error`] for a folder that cannot be read.
pub fn files(root: &Path, path: &Path) -> io::Result<Vec<PathBuf>> {
    if !root.join(path).is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let mut names = Vec::new();
    for entry in fs::read_dir(root.join(path))? {
        names.push(entry?.file_name());
    }
    names.sort();
    let mut found = Vec::new();
    for name in names {
        let built = ["target", "__pycache__", "node_modules"]
            .iter()
            .any(|built| name == *built);
        if !built && !name.to_string_lossy().starts_with('.') {
            found.extend(files(root, &path.join(name))?);
        }
    }
    Ok(found)
}

/// The commit that is checked out, where git says so.
fn commit(root: &Path) -> String {
    let head = ["rev-parse", "--short=12", "HEAD"];
    let output = Command::new("git").current_dir(root).args(head).output();
    let said = output.ok().filter(|output| output.status.success());
    let text = said.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    text.unwrap_or_else(|| "unknown".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::iter::empty;

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
        let set = Set::new("x", empty::<(String, String)>())
            .of_now(root, vec!["src".into()])
            .unwrap();
        assert_eq!(set.is_stale(root).unwrap(), Some(false));
        fs::write(root.join("b"), "two").unwrap();
        fs::write(root.join("src/page.md"), "two").unwrap();
        assert_eq!(set.is_stale(root).unwrap(), Some(false));
        fs::write(root.join("src/a"), "two").unwrap();
        assert_eq!(set.is_stale(root).unwrap(), Some(true));
        assert_eq!(
            Set::new("x", empty::<(String, String)>())
                .is_stale(root)
                .unwrap(),
            None
        );
    }
}

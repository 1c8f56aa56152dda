//! The lock file: which model and versions a library was built with.

use super::manifest::CONFINED_REMEDY;
use asperity_io::{
    diagnostic::Fault,
    input::{self, InputKind, InputProblem, Reach},
    output::{AtomicFile, OutputError},
    toml_error::TomlError,
};
use serde::Deserialize;
use std::{
    fs, io,
    path::{Path, PathBuf},
};

/// Version of the lock file.
const FORMAT: u32 = 1;
/// Remedy for a file that this version did not write.
const WRITE_ANEW: &str = "remove it, and build once without --locked to write it anew";

/// Versions that, with its entry, determine the bytes of every texture.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Pinned {
    /// Version of this program.
    pub asperity: String,
    /// Name of the learned model.
    pub model: String,
    /// CRC-32 of its files.
    pub model_crc32: u32,
    /// Name of the text encoder.
    pub text_encoder: String,
    /// CRC-32 of its files.
    pub text_encoder_crc32: u32,
    /// Inference back end.
    pub backend: String,
    /// Version of the prompt reader: [`asperity_language::reading::VERSION`].
    pub reader: String,
}

/// A lock file beside its manifest.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lock {
    file: PathBuf,
    /// The file itself, behind any link that led to it.
    target: PathBuf,
    found: Option<Pinned>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Raw {
    format: u32,
    asperity: String,
    model: String,
    model_crc32: String,
    text_encoder: String,
    text_encoder_crc32: String,
    backend: String,
    /// Locks of version 0.1.0 did not pin it.
    #[serde(default)]
    reader: String,
}

impl Pinned {
    /// Every field by name, as text.
    fn fields(&self) -> [(&'static str, String); 7] {
        [
            ("asperity", self.asperity.clone()),
            ("model", self.model.clone()),
            ("model_crc32", format!("{:08x}", self.model_crc32)),
            ("text_encoder", self.text_encoder.clone()),
            (
                "text_encoder_crc32",
                format!("{:08x}", self.text_encoder_crc32),
            ),
            ("backend", self.backend.clone()),
            ("reader", self.reader.clone()),
        ]
    }
}

impl Lock {
    /// The lock of a manifest: `FILE.lock`, which may not be there.
    ///
    /// # Errors
    /// [`Fault`] for a lock file that cannot be read.
    pub fn beside(manifest: &Path) -> Result<Self, Fault> {
        Self::within(manifest, &Reach::Anywhere)
    }

    /// The lock of a manifest that may name only files within reach.
    ///
    /// # Errors
    /// As [`beside`](Self::beside), and for a link that leads elsewhere.
    pub fn within(manifest: &Path, reach: &Reach) -> Result<Self, Fault> {
        let mut name = manifest.as_os_str().to_owned();
        name.push(".lock");
        let file = PathBuf::from(name);
        let stated = Path::new(file.file_name().unwrap_or_default());
        if let Err(outside) = reach.check(stated, &file) {
            let what = format!("{outside}, and the manifest is confined to its folder");
            return Err(Fault::new(what, CONFINED_REMEDY).at(file));
        }
        let text = match input::read_text(&file, InputKind::Settings) {
            Ok(text) => text,
            Err(InputProblem::Unreadable(error)) if error.kind() == io::ErrorKind::NotFound => {
                if fs::symlink_metadata(&file).is_ok() {
                    let what = "a symbolic link to a file that is not there";
                    return Err(Fault::new(what, WRITE_ANEW).at(file));
                }
                return Ok(Self {
                    target: file.clone(),
                    file,
                    found: None,
                });
            }
            Err(problem) => return Err(Fault::from(problem).at(file)),
        };
        // Its text is not repeated: a link in its place leads to any file.
        let raw: Raw = toml::from_str(&text).map_err(|error| {
            let line = TomlError::new(&text, &error).line as u64;
            let fault = Fault::new("not what a lock file of asperity has", WRITE_ANEW);
            fault.at(&file).line(line)
        })?;
        if raw.format != FORMAT {
            let what = format!("format {}, this version reads {FORMAT}", raw.format);
            return Err(Fault::new(what, WRITE_ANEW).at(file));
        }
        // A number that is none differs from every CRC but 0, which no model has.
        let number = |text: &str| u32::from_str_radix(text, 16).unwrap_or(0);
        let found = Some(Pinned {
            model_crc32: number(&raw.model_crc32),
            text_encoder_crc32: number(&raw.text_encoder_crc32),
            asperity: raw.asperity,
            model: raw.model,
            text_encoder: raw.text_encoder,
            backend: raw.backend,
            reader: raw.reader,
        });
        let target = fs::canonicalize(&file).unwrap_or_else(|_| file.clone());
        Ok(Self {
            file,
            target,
            found,
        })
    }

    /// The lock file.
    #[must_use]
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// Returns the differences from the lock, a line each; empty if there is no lock.
    #[must_use]
    pub fn drift(&self, now: &Pinned) -> Vec<String> {
        let Some(found) = &self.found else {
            return Vec::new();
        };
        let pairs = found.fields().into_iter().zip(now.fields());
        pairs
            .filter(|((_, was), (_, is))| was != is)
            .map(|((name, was), (_, is))| format!("{name} was {was}, is {is}"))
            .collect()
    }

    /// Refuses what the lock does not pin, and a lock that is not there.
    ///
    /// # Errors
    /// [`Fault`] for either.
    pub fn hold(&self, now: &Pinned) -> Result<(), Fault> {
        let drift = self.drift(now);
        let fault = if self.found.is_none() {
            let remedy = "build once without --locked, and commit the lock file";
            Fault::new("there is no lock file", remedy)
        } else if drift.is_empty() {
            return Ok(());
        } else {
            let remedy = "use the pinned model and version, or build without --locked to pin these";
            Fault::new(drift.join("; "), remedy)
        };
        Err(fault.at(&self.file))
    }

    /// Writes the lock file where it pins something else, and returns a warning for everything that it pinned before
    /// and for a file that cannot be written.
    #[must_use]
    pub fn update(&self, now: &Pinned) -> Vec<String> {
        let file = self.file.display();
        let mut warnings: Vec<String> = self
            .drift(now)
            .iter()
            .map(|drift| format!("{file}: {drift}; it pins that now"))
            .collect();
        if let Some(text) = self.text(now)
            && let Err(error) = self.write(&text)
        {
            warnings.push(format!("{error}: {}; nothing is pinned", error.source));
        }
        warnings
    }

    /// Writes the file that was read, or where none was: a link that appeared meanwhile is replaced.
    fn write(&self, text: &str) -> Result<(), OutputError> {
        let mut file = AtomicFile::replacing(&self.target)?;
        file.fill(text.as_bytes())?;
        file.commit()
    }

    /// The text of a lock file; `None` where the lock holds it already.
    #[must_use]
    pub fn text(&self, now: &Pinned) -> Option<String> {
        if self.found.as_ref() == Some(now) {
            return None;
        }
        let mut text = format!(
            "# Written by `asperity build`. Commit it with the manifest; --locked refuses drift.\nformat = {FORMAT}\n"
        );
        for (name, value) in now.fields() {
            // JSON's escapes are TOML's.
            let quoted = serde_json::Value::from(value);
            text += &format!("{name} = {quoted}\n");
        }
        Some(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SYNTAX: &str = "not what a lock file of asperity has";

    fn pinned() -> Pinned {
        Pinned {
            asperity: "0.1.0".into(),
            model: "re\"ference".into(),
            model_crc32: 0xdead,
            text_encoder: "minilm".into(),
            text_encoder_crc32: 7,
            backend: "portable".into(),
            reader: "1".into(),
        }
    }

    #[test]
    fn a_lock_reads_back_and_names_what_drifts() {
        let folder = tempfile::tempdir().unwrap();
        let manifest = folder.path().join("library.toml");
        let none = Lock::beside(&manifest).unwrap();
        let error = none.hold(&pinned()).unwrap_err();
        assert_eq!(error.what, "there is no lock file");
        fs::write(none.file(), none.text(&pinned()).unwrap()).unwrap();
        let lock = Lock::beside(&manifest).unwrap();
        assert!(lock.hold(&pinned()).is_ok() && lock.text(&pinned()).is_none());
        let other = Pinned {
            model_crc32: 0xbeef,
            ..pinned()
        };
        let error = lock.hold(&other).unwrap_err().to_string();
        assert!(
            error.contains("model_crc32 was 0000dead, is 0000beef"),
            "{error}"
        );
        fs::write(lock.file(), "format = 1\nwhat = 2\n").unwrap();
        let error = Lock::beside(&manifest).unwrap_err();
        assert_eq!((error.line, &*error.what), (Some(2), SYNTAX));
    }

    /// A link in the place of a lock leads to any file: its text is not shown, and nothing is written through it.
    #[cfg(unix)]
    #[test]
    fn a_link_shows_and_writes_nothing_of_what_it_leads_to() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        let (list, other) = (folder.path().join("x.csv"), folder.path().join("other"));
        let lock = folder.path().join("x.csv.lock");
        symlink(&other, &lock).unwrap();
        for text in ["root:secret:0\n", "secret = 4\n", "format = \"secret\"\n"] {
            fs::write(&other, text).unwrap();
            let error = Lock::beside(&list).unwrap_err();
            assert_eq!(error.what, SYNTAX);
            assert!(!error.to_string().contains("secret"), "{error}");
        }
        fs::remove_file(&other).unwrap();
        let error = Lock::beside(&list).unwrap_err();
        assert_eq!(error.what, "a symbolic link to a file that is not there");
        // A lock that is kept elsewhere is one.
        let plain = Lock {
            file: other.clone(),
            target: other.clone(),
            found: None,
        };
        fs::write(&other, plain.text(&pinned()).unwrap()).unwrap();
        let linked = Lock::beside(&list).unwrap();
        assert!(linked.hold(&pinned()).is_ok());
        let later = Pinned {
            reader: "2".into(),
            ..pinned()
        };
        assert_eq!(linked.update(&later).len(), 1);
        assert!(Lock::beside(&list).unwrap().hold(&later).is_ok());
        assert!(fs::symlink_metadata(&lock).unwrap().is_symlink());
        // A link that appears during a build leads nowhere.
        let target = folder.path().join("target");
        let late = Lock::beside(&folder.path().join("y.csv")).unwrap();
        symlink(&target, late.file()).unwrap();
        assert_eq!(late.update(&pinned()), [""; 0]);
        assert!(!target.exists() && late.file().is_file());
    }
}

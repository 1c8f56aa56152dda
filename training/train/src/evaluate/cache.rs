//! Finished parts, kept beside the report so that a rerun goes on where one stopped.

use super::EvaluateError;
use asperity_io::output::write_atomic;
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::{
    fs,
    path::{Path, PathBuf},
};

/// Changes whenever a part measures something else: older results are then measured anew.
const VERSION: u32 = 2;
/// Folder of the cache inside the report's.
const FOLDER: &str = "cache";

/// Results of parts on disk.
pub(super) struct Cache {
    folder: PathBuf,
    /// Key prefix on which all results depend.
    base: String,
}

#[derive(Serialize, Deserialize)]
struct Entry<T> {
    key: String,
    result: T,
}

impl Cache {
    /// The cache of a report, for results that depend on `base`.
    pub(super) fn open(report: &Path, base: &str) -> Result<Self, EvaluateError> {
        let folder = folder(report)?;
        Ok(Self {
            folder,
            base: format!("{VERSION} {base}"),
        })
    }

    /// The result of this name if it was computed under the same `key`, else, where it
    /// is `asked` for, what `compute` gives, kept.
    pub(super) fn part<T: Serialize + DeserializeOwned>(
        &self,
        name: &str,
        key: &str,
        asked: bool,
        compute: impl FnOnce() -> Result<T, EvaluateError>,
    ) -> Result<Option<T>, EvaluateError> {
        let key = format!("{} {key}", self.base);
        let path = self.folder.join(format!("{name}.json"));
        // What cannot be read is computed again.
        let kept = fs::read(&path).ok();
        let kept = kept.and_then(|bytes| serde_json::from_slice::<Entry<T>>(&bytes).ok());
        if let Some(entry) = kept.filter(|entry| entry.key == key) {
            return Ok(Some(entry.result));
        }
        if !asked {
            return Ok(None);
        }
        let entry = Entry {
            key,
            result: compute()?,
        };
        let fail = |e: serde_json::Error| EvaluateError::Encode {
            file: path.display().to_string(),
            message: e.to_string(),
        };
        let bytes = serde_json::to_vec(&entry).map_err(fail)?;
        write_atomic(&path, &bytes)?;
        // As a rerun will read it: numbers may lose their last bit on the way.
        let read: Entry<T> = serde_json::from_slice(&bytes).map_err(fail)?;
        Ok(Some(read.result))
    }
}

/// The folder of the cache, made if need be.
pub(super) fn folder(report: &Path) -> Result<PathBuf, EvaluateError> {
    let folder = report.join(FOLDER);
    fs::create_dir_all(&folder).map_err(|source| asperity_io::output::OutputError {
        path: folder.clone(),
        doing: "cannot make the folder",
        source,
    })?;
    Ok(folder)
}

/// CRC-32 of anything.
pub(super) fn checksum<'a>(pieces: impl IntoIterator<Item = &'a [u8]>) -> u32 {
    let crc = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);
    let mut digest = crc.digest();
    for piece in pieces {
        digest.update(&(piece.len() as u64).to_le_bytes());
        digest.update(piece);
    }
    digest.finalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_is_computed_once_a_key() {
        let folder = tempfile::tempdir().unwrap();
        let mut calls = 0;
        let mut ask = |base: &str, key: &str, asked: bool| {
            let cache = Cache::open(folder.path(), base).unwrap();
            let result: Option<usize> = cache
                .part("a", key, asked, || {
                    calls += 1;
                    Ok(calls)
                })
                .unwrap();
            result
        };
        assert_eq!(ask("m", "1", false), None);
        assert_eq!(
            (ask("m", "1", true), ask("m", "1", false)),
            (Some(1), Some(1))
        );
        assert_eq!(
            (ask("m", "2", true), ask("n", "2", true)),
            (Some(2), Some(3))
        );
    }
}

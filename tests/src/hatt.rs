//! The HaTT materials, where they are present: for tests only, nothing of them is
//! kept here.

use std::path::{Path, PathBuf};

/// The XML files of the materials, sorted, from the folder in `ASPERITY_HATT`, or from
/// `../shared/hatt/models` beside the workspace. Empty, and said so, where there is none.
#[must_use]
pub fn materials(test: &str) -> Vec<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/hatt/models");
    let folder = std::env::var_os("ASPERITY_HATT").map_or(beside, PathBuf::from);
    let mut files: Vec<_> = std::fs::read_dir(&folder)
        .into_iter()
        .flatten()
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| {
            path.extension()
                .is_some_and(|ext| ext.eq_ignore_ascii_case("xml"))
        })
        .collect();
    files.sort();
    if files.is_empty() {
        println!(
            "SKIPPED {test}: no HaTT materials in {}; set ASPERITY_HATT to their folder",
            folder.display()
        );
    }
    files
}

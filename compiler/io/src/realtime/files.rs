//! Access to the files of `/proc` and `/sys`.

use std::{fs, path::PathBuf};

/// The files of a system.
pub(super) struct Files(pub(super) PathBuf);

impl Files {
    /// The text of a file without the space around it; `None` if it is missing or empty.
    pub(super) fn text(&self, path: &str) -> Option<String> {
        let text = fs::read_to_string(self.0.join(path)).ok()?;
        let text = text.trim();
        (!text.is_empty() && text != "(null)").then(|| text.to_owned())
    }

    pub(super) fn number<T: std::str::FromStr>(&self, path: &str) -> Option<T> {
        self.text(path)?.parse().ok()
    }

    /// Names of what a folder holds, in order.
    pub(super) fn names(&self, path: &str) -> Vec<String> {
        let entries = fs::read_dir(self.0.join(path))
            .into_iter()
            .flatten()
            .flatten();
        let mut names: Vec<String> = entries
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    /// Processors of the machine.
    pub(super) fn processors(&self) -> usize {
        let online = self.text("sys/devices/system/cpu/online");
        online.map_or(1, |list| listed(&list).len().max(1))
    }
}

/// The processors of a list such as `0-2,5`.
pub(super) fn listed(list: &str) -> Vec<usize> {
    let ranges = list.split(',').filter_map(|range| {
        let (first, last) = range.split_once('-').unwrap_or((range, range));
        let range = first.trim().parse().ok()?..=last.trim().parse().ok()?;
        (range.end() - range.start() < 1 << 16).then_some(range)
    });
    ranges.flatten().collect()
}

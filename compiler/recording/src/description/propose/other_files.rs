//! Files of a folder that are not read, though they hold a recording: what becomes of them.

use crate::description::{Meaning, meaning};
use asperity_io::{
    input::{Format, HEAD},
    table::Layout,
};
use std::{fs::File, io::Read as _, path::Path};

/// Names the format of a file that may hold a recording, and the way to convert it; `None` for any other file.
pub(super) fn remedy(path: &Path) -> Option<String> {
    if !path.is_file() {
        return None;
    }
    let mut head = Vec::new();
    let file = File::open(path).ok()?;
    file.take(HEAD as u64).read_to_end(&mut head).ok()?;
    let format = Format::of(&head);
    if let Some(format) = format.filter(|format| format.holds_data()) {
        return Some(format!("is {}; {}", format.name(), format.remedy()));
    }
    let layout = Layout::of(&head, &|_| false).ok()?;
    let told = layout.columns.iter().any(|name| {
        matches!(
            meaning(name),
            Meaning::Channel { .. } | Meaning::Clock(Some(_))
        )
    });
    let is_table = format.is_none() && layout.columns.len() > 1 && told;
    is_table.then(|| "is a table; rename it to end in .csv or .txt".to_owned())
}

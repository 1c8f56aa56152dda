//! File names of textures.

use std::collections::HashSet;

/// File names of assets: the names of the textures, freed of what a file system refuses.
pub(super) fn file_names(names: &[&str]) -> Vec<String> {
    file_names_ending(names, "asp")
}

/// [`file_names`] with another ending.
pub(super) fn file_names_ending(names: &[&str], ending: &str) -> Vec<String> {
    let mut taken = HashSet::new();
    names
        .iter()
        .map(|name| {
            let safe: String = name
                .chars()
                .map(|c| if r#"/\<>:"|?*"#.contains(c) { '_' } else { c })
                .collect();
            let safe = if safe.starts_with('.') {
                format!("_{safe}")
            } else {
                safe
            };
            let mut file = format!("{safe}.{ending}");
            let mut next = 2;
            // Some file systems take upper and lower case for the same.
            while !taken.insert(file.to_lowercase()) {
                file = format!("{safe} ({next}).{ending}");
                next += 1;
            }
            file
        })
        .collect()
}

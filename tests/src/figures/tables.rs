//! The sections of a Markdown file that a command writes, as a set.

use super::Set;
use std::{collections::BTreeMap, io, path::Path};

/// The set with a figure for each section of `text`, and for how many `rows` all tables have, as of what its
/// paths hold now.
///
/// A set that is new begins as a file with its command, the paths that decide its figures, and no figures.
///
/// # Errors
/// [`io::Error`] for a set without paths, or where a file cannot be read.
pub fn renewed(mut set: Set, text: &str, root: &Path) -> io::Result<Set> {
    let measured = set.measured.take();
    let paths = measured
        .ok_or_else(|| io::Error::other("the set names no measured.paths"))?
        .paths;
    set.figures = sections(text);
    let lines = |what: &str| {
        let lines = set.figures.values().flat_map(|section| section.lines());
        lines.filter(|line| line.starts_with(what)).count()
    };
    // Each table has a head.
    let rows = lines("| ") - lines("|---");
    set.figures.insert("rows".to_owned(), rows.to_string());
    set.of_now(root, paths)
}

/// Returns the text below each heading of the second and third level, by the words of the heading.
fn sections(text: &str) -> BTreeMap<String, String> {
    let mut sections = BTreeMap::<String, String>::new();
    let mut name = None;
    for line in text.lines() {
        if let Some(heading) = line.strip_prefix("## ").or(line.strip_prefix("### ")) {
            let words = heading.split(|c: char| !c.is_alphanumeric());
            let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
            name = Some(words.join("_").to_lowercase());
        } else if let Some(name) = &name {
            *sections.entry(name.clone()).or_default() += &format!("{line}\n");
        }
    }
    sections.retain(|_, body| !body.trim().is_empty());
    for body in sections.values_mut() {
        let trimmed = body.trim();
        // A line by itself is quoted within a line.
        let end = if trimmed.contains('\n') { "\n" } else { "" };
        *body = format!("{trimmed}{end}");
    }
    sections
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::iter::empty;

    #[test]
    fn each_section_is_a_figure_and_rows_are_counted() {
        let table = "x:\n\n| a | b |\n|---|---:|\n| 1 | 2 |\n| 3 | 4 |";
        let text = format!(
            "head\n\n## wall\n\n{table}\n\n## Above\n\n### Two words, 3\n\n{table}\n\n## line\n\na\n"
        );
        let root = crate::figures::root();
        let set = Set::new("x", empty::<(String, String)>())
            .of_now(&root, vec!["Cargo.toml".into()])
            .unwrap();
        let set = renewed(set, &text, &root).unwrap();
        assert_eq!(set.figures["rows"], "4");
        assert_eq!(set.figures["wall"], format!("{table}\n"));
        assert!(set.figures.contains_key("two_words_3") && !set.figures.contains_key("above"));
        assert_eq!(set.figures["line"], "a");
        assert_eq!(set.is_stale(&root).unwrap(), Some(false));
        assert!(renewed(Set::new("x", empty::<(String, String)>()), &text, &root).is_err());
    }
}

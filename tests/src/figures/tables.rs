//! The tables that a command of the lab writes as Markdown, as a set.

use super::Set;
use std::{collections::BTreeMap, io, path::Path};

/// A command that writes tables, and what decides them.
struct Tables {
    set: &'static str,
    command: &'static str,
    paths: &'static [&'static str],
}

const TABLES: [Tables; 1] = [Tables {
    set: "stability",
    command: "asperity-lab stability --hatt HATT --out target/stability, then cargo run -p asperity-tests --bin \
              figures -- --tables stability target/stability/tables.md",
    paths: &[
        "runtime/src",
        "device-sim/src",
        "lab/experiments/src/stability",
    ],
}];

/// A figure for each section of the tables, by its heading, and how many `rows` all have.
///
/// # Errors
/// [`io::Error`] for a set that no command is known of, or where a file cannot be read.
pub fn set(name: &str, text: &str, root: &Path) -> io::Result<Set> {
    let known = TABLES.iter().find(|tables| tables.set == name);
    let tables = known.ok_or_else(|| io::Error::other(format!("no tables are called {name}")))?;
    let mut set = Set::new(tables.command, []);
    set.figures = sections(text);
    let lines = |what: &str| {
        let lines = set.figures.values().flat_map(|section| section.lines());
        lines.filter(|line| line.starts_with(what)).count()
    };
    // Each table has a head.
    let rows = lines("| ") - lines("|---");
    set.figures.insert("rows".to_owned(), rows.to_string());
    set.of_now(root, tables.paths)
}

fn sections(text: &str) -> BTreeMap<String, String> {
    let text = format!("\n{text}");
    let sections = text.split("\n## ").skip(1);
    let sections = sections.filter_map(|section| section.split_once('\n'));
    sections
        .map(|(name, body)| (name.trim().replace(' ', "_"), format!("{}\n", body.trim())))
        .collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn each_section_is_a_figure_and_rows_are_counted() {
        let table = "x:\n\n| a | b |\n|---|---:|\n| 1 | 2 |\n| 3 | 4 |";
        let text = format!("head\n\n## wall\n\n{table}\n\n## two words\n\n{table}\n");
        let root = crate::figures::root();
        let set = super::set("stability", &text, &root).unwrap();
        assert_eq!(set.figures["rows"], "4");
        assert_eq!(set.figures["wall"], format!("{table}\n"));
        assert!(set.figures.contains_key("two_words"));
        assert!(super::set("none", &text, &root).is_err());
    }
}

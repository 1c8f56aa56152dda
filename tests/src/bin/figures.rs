//! Fills the figures of every page from their sets: `cargo run -p asperity-tests --bin figures`.
//!
//! `--report FILE` first writes the set that `asperity-train evaluate` measured, `--tables SET FILE` renews a set from the
//! sections of a Markdown file that its command wrote. With `--check` the program writes nothing and fails where a page
//! differs, or has more or fewer figures without markers than [`ALLOWED`] says. It prints the sets whose subject has
//! changed since they were measured, as lines `stale: …`.

#![forbid(unsafe_code)]

use asperity_tests::figures::{
    Set, evaluation, files, folder, page, root, tables, unmarked::unmarked,
};
use std::{collections::BTreeMap, env, error::Error, fs, path::Path};

/// Pages and how many figures each may have outside markers: definitions, limits, examples, and what is not yet
/// quoted from a set.
const ALLOWED: &str = "unmarked.toml";

fn main() -> Result<(), Box<dyn Error>> {
    let (root, folder) = (root(), folder());
    let arguments: Vec<String> = env::args().skip(1).collect();
    let check = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => false,
        ["--check"] => true,
        ["--report", file] => {
            let report = fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?;
            evaluation::set(&report, &root)?.write(&folder.join("retrieval.toml"))?;
            false
        }
        ["--tables", name, file] => {
            let text = fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?;
            let file = folder.join(name).with_extension("toml");
            let renewed = tables::renewed(Set::read(&file)?, &text, &root);
            let set = renewed.map_err(|error| format!("{}: {error}", file.display()))?;
            set.write(&file)?;
            false
        }
        _ => {
            return Err(
                "usage: figures [--check | --report REPORT.JSON | --tables SET TABLES.MD]".into(),
            );
        }
    };
    let mut sets = BTreeMap::new();
    for file in fs::read_dir(&folder)? {
        let file = file?.path();
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        if file.extension().is_some_and(|e| e == "toml") && !file.ends_with(ALLOWED) {
            sets.insert(name.into_owned(), Set::read(&file)?);
        }
    }
    let allowed: BTreeMap<String, usize> =
        toml::from_str(&fs::read_to_string(folder.join(ALLOWED))?)?;
    let mut faults = Vec::new();
    let mut quoted = 0;
    for name in pages(&root)? {
        let file = root.join(&name);
        let text = fs::read_to_string(&file).map_err(|error| format!("{name}: {error}"))?;
        let (filled, figures) =
            page::fill(&text, &sets).map_err(|(line, what)| format!("{name}:{line}: {what}"))?;
        quoted += figures.len();
        for figure in figures.iter().filter(|f| f.said != f.right) {
            let (said, right) = (figure.said.trim(), figure.right.trim());
            let at = format!("{name}:{}: {}", figure.line, figure.name);
            faults.push(format!("{at} is {right}, the page says {said}"));
        }
        if !check && filled != text {
            fs::write(&file, &filled)?;
        }
        let lines = unmarked(&filled);
        let most = allowed.get(&name).copied().unwrap_or_default();
        if lines.len() != most {
            faults.push(format!(
                "{name}: {} figures outside markers, {most} in docs/figures/{ALLOWED}; lines {lines:?}",
                lines.len()
            ));
        }
    }
    for (name, set) in &sets {
        if set.is_stale(&root)? == Some(true) {
            println!("stale: docs/figures/{name}.toml: `{}`", set.command);
        }
    }
    println!("{} sets, {quoted} figures in pages", sets.len());
    if check && !faults.is_empty() {
        return Err(faults.join("\n").into());
    }
    for fault in faults.iter().filter(|_| !check) {
        println!("{fault}");
    }
    Ok(())
}

/// Pages that state figures: all but the changes of the past and inputs of tests.
fn pages(root: &Path) -> Result<Vec<String>, Box<dyn Error>> {
    let page = |name: &String| {
        let apart = name == "CHANGELOG.md" || name.contains("tests/cases/");
        name.ends_with(".md") && !apart
    };
    let all = files(root, Path::new(""))?.into_iter();
    Ok(all
        .map(|file| file.to_string_lossy().replace('\\', "/"))
        .filter(page)
        .collect())
}

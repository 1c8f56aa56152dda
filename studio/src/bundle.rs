//! The page's modules as one script and its style sheets as one, for web servers from which a file after another comes
//! slowly. It knows JavaScript as the page writes it: imports of names, a line each, and exports of what a line declares.

use crate::page::{self, File};

/// The page's entry.
const ENTRY: &str = "studio.js";
/// Modules that run in threads of their own, each with what it imports.
const THREADS: [&str; 5] = [
    "limiter.js",
    "offline/worker.js",
    "output/shift.js",
    "plots/csv.js",
    "worklet.js",
];
const STYLE: &str = "studio.css";

/// Returns the page's files with all modules and style sheets in one each: name and bytes.
pub(crate) fn files() -> Vec<(&'static str, Vec<u8>)> {
    let mut threads = Vec::new();
    for entry in THREADS {
        add(entry, &mut threads);
    }
    let is_script = |file: &File| file.name.ends_with(".js");
    let kept = page::FILES.iter().filter(|file| {
        let alone = !is_script(file) && !file.name.ends_with(".css");
        alone || threads.iter().any(|name| name == file.name)
    });
    let mut files: Vec<(&str, Vec<u8>)> = kept
        .map(|file| match file.name {
            page::INDEX => (file.name, index().into_bytes()),
            name => (name, file.bytes.to_vec()),
        })
        .collect();
    files.push((ENTRY, script().into_bytes()));
    files.push((STYLE, styles().concat().into_bytes()));
    files
}

fn text(name: &str) -> &'static str {
    let file = page::file(name).map_or(&b""[..], |file| file.bytes);
    std::str::from_utf8(file).unwrap_or_default()
}

/// The lines of the page that name its style sheets.
fn style_links() -> impl Iterator<Item = &'static str> {
    text(page::INDEX)
        .lines()
        .filter(|line| line.contains("rel=\"stylesheet\""))
}

fn styles() -> Vec<&'static str> {
    let names = style_links().filter_map(|line| line.split('"').nth(3));
    names.map(text).collect()
}

/// The page, which names one style sheet.
fn index() -> String {
    let kept = |line: &&str| !style_links().any(|link| link == *line) || line.contains(STYLE);
    let lines: Vec<&str> = text(page::INDEX).lines().filter(kept).collect();
    lines.join("\n") + "\n"
}

/// An import: the names as a pattern of `const`, and the module.
fn import(line: &str) -> Option<(String, &str)> {
    let (names, from) = line.strip_prefix("import {")?.split_once("} from \"")?;
    Some((names.replace(" as ", ": "), from.strip_suffix("\";")?))
}

/// The name that a line exports.
fn export(line: &str) -> Option<&str> {
    let declared = line.strip_prefix("export ")?;
    let mut words = declared.split(|c: char| !c.is_alphanumeric() && c != '_' && c != '$');
    words.find(|word| !matches!(*word, "async" | "function" | "class" | "const" | ""))
}

/// A module's name below the page, of what another one imports.
fn resolved(importer: &str, from: &str) -> String {
    let mut folders: Vec<&str> = importer.split('/').collect();
    folders.pop();
    for part in from.split('/') {
        match part {
            "." => {}
            ".." => drop(folders.pop()),
            _ => folders.push(part),
        }
    }
    folders.join("/")
}

/// Adds a module after those that it imports, each once.
fn add(name: &str, order: &mut Vec<String>) {
    if order.iter().any(|known| known == name) {
        return;
    }
    for (_, from) in text(name).lines().filter_map(import) {
        add(&resolved(name, from), order);
    }
    order.push(name.to_owned());
}

/// The lines of a module without what only its readers need: indentation and comments.
fn code(text: &str) -> impl Iterator<Item = &str> {
    let mut is_comment = false;
    text.lines().map(str::trim).filter(move |line| {
        let begins = line.starts_with("/*");
        is_comment |= begins;
        let keeps = !is_comment && !line.starts_with("//") && !line.is_empty();
        is_comment &= !line.ends_with("*/");
        keeps
    })
}

/// Every module in a function of its own, which gives what it exports.
fn script() -> String {
    let mut order = Vec::new();
    add(ENTRY, &mut order);
    let variable = |name: &str| {
        let at = order.iter().position(|known| known == name);
        format!("module{}", at.unwrap_or_default())
    };
    let mut script = String::from("\"use strict\";\n");
    for name in &order {
        let mut exports = Vec::new();
        script += &format!("// {name}\nconst {} = (() => {{\n", variable(name));
        for line in code(text(name)) {
            if let Some((names, from)) = import(line) {
                let from = variable(&resolved(name, from));
                script += &format!("const {{{names}}} = {from};\n");
                continue;
            }
            exports.extend(export(line));
            script += line.strip_prefix("export ").unwrap_or(line);
            script.push('\n');
        }
        script += &format!("return {{ {} }};\n}})();\n", exports.join(", "));
    }
    script
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_that_imports_or_exports_is_understood() {
        for file in page::FILES.iter().filter(|file| file.name.ends_with(".js")) {
            for line in text(file.name).lines() {
                assert!(
                    !line.starts_with("import") || import(line).is_some(),
                    "{line}"
                );
                let declares = ["function", "async function", "class", "const"];
                let is_plain = line.strip_prefix("export ").is_none_or(|rest| {
                    let mut declares = declares.iter();
                    declares.any(|word| rest.starts_with(&format!("{word} ")))
                        && export(line).is_some()
                });
                assert!(is_plain && !line.starts_with("export const ["), "{line}");
                assert!(!line.contains("import.meta"), "{line}");
                // A text of several lines would lose its indentation, which shaders do not need.
                let is_whole = line.matches('`').count() % 2 == 0;
                assert!(is_whole || file.name == "lit.js", "{line}");
                let ends = line
                    .split_once("*/")
                    .is_none_or(|(_, after)| after.is_empty());
                assert!(!line.trim_start().starts_with("/*") || ends, "{line}");
            }
        }
        assert_eq!(
            import("import { a, b as c } from \"../x.js\";"),
            Some((" a, b: c ".into(), "../x.js"))
        );
        assert_eq!(export("export async function run(x) {"), Some("run"));
        assert_eq!(resolved("a/b.js", "../c/d.js"), "c/d.js");
    }

    #[test]
    fn modules_stand_after_what_they_import() {
        let mut order = Vec::new();
        add(ENTRY, &mut order);
        for (at, name) in order.iter().enumerate() {
            for (_, from) in text(name).lines().filter_map(import) {
                let from = resolved(name, from);
                let place = order.iter().position(|known| *known == from);
                assert!(place.is_some_and(|place| place < at), "{name}: {from}");
            }
        }
        let names: Vec<&str> = files().iter().map(|(name, _)| *name).collect();
        assert!(names.contains(&"worklet.js") && !names.contains(&"loader.js"));
        assert_eq!(styles().len(), style_links().count());
    }
}

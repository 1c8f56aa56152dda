//! Unsafe code is where `SECURITY.md` says, and nowhere else in the product.

use asperity_tests::figures::{files, root};
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

/// Folders of the product.
const PRODUCT: [&str; 8] = [
    "bindings", "cli", "compiler", "formats", "host", "lab", "runtime", "studio",
];

/// The package of a source file.
fn package(file: &Path) -> String {
    let manifest = (file.ancestors().skip(1))
        .map(|folder| folder.join("Cargo.toml"))
        .find(|manifest| manifest.is_file())
        .expect("a package");
    let text = fs::read_to_string(manifest).unwrap();
    let name = text.lines().find_map(|line| line.strip_prefix("name = "));
    name.expect("a name").trim_matches('"').to_owned()
}

#[test]
fn the_crates_with_unsafe_code_are_those_that_the_page_names() {
    let root = root();
    let allows = |file: &PathBuf| {
        let text = fs::read_to_string(file).unwrap();
        let blocks = ["#[allow(", "#![allow(", "#[expect(", "#![expect("]
            .into_iter()
            .flat_map(|opening| text.split(opening).skip(1));
        blocks
            .filter_map(|rest| rest.split_once(')'))
            .any(|(lints, _)| lints.contains("unsafe_code"))
    };
    let found: BTreeSet<String> = PRODUCT
        .iter()
        .flat_map(|folder| files(&root, Path::new(folder)).unwrap())
        .filter(|file| file.extension().is_some_and(|ending| ending == "rs"))
        .filter(|file| !file.components().any(|part| part.as_os_str() == "tests"))
        .map(|file| root.join(file))
        .filter(allows)
        .map(|file| package(&file))
        .collect();
    let page = fs::read_to_string(root.join("SECURITY.md")).unwrap();
    let (_, list) = page
        .split_once("use it, each block with its reason:")
        .unwrap();
    let (list, _) = list.split_once(" |").unwrap();
    let named: BTreeSet<String> = list
        .split('`')
        .skip(1)
        .step_by(2)
        .map(str::to_owned)
        .collect();
    assert_eq!(found, named);
    let counted = ["three", "four", "five", "six", "seven", "eight"][named.len() - 3];
    let contributing = fs::read_to_string(root.join("CONTRIBUTING.md")).unwrap();
    assert!(
        contributing.contains(&format!("the {counted} crates that need it")),
        "{counted}"
    );
}

//! Operations on a built library: compare, rename, split.

use super::{library::manifest, *};
use asperity::emit::pack::{NamedAsset, encode};

#[test]
fn a_difference_is_told_in_figures_and_by_the_exit_status() {
    let inputs = inputs();
    let folder = inputs.path();
    let write = |name: &str, mu: &str, extra: &str| {
        let other = material("Wood").replace("<mu>0.4</mu>", mu);
        fs::write(folder.join("wood.xml"), other).expect("a material");
        let manifest = format!("[[texture]]\nname = \"w\"\nimport = \"wood.xml\"\n{extra}");
        fs::write(folder.join("m.toml"), manifest).expect("a manifest");
        good(folder, &["build", "m.toml", "--no-cache", "-o", name]);
    };
    write("old.aspl", "<mu>0.4</mu>", "");
    write(
        "new.aspl",
        "<mu>0.5</mu>",
        "[[texture]]\nname = \"g\"\nasset = \"good.asp\"\n",
    );
    assert!(good(folder, &["diff", "old.aspl", "old.aspl"]).contains("1 unchanged"));
    let output = asperity(folder, &["diff", "old.aspl", "new.aspl"]);
    assert_eq!(output.status.code(), Some(1));
    let said = text(&output.stdout);
    assert!(
        said.contains("+ g\n") && said.contains("~ w: μ 0.400 → 0.500"),
        "{said}"
    );
    assert_eq!(text(&output.stderr), "");
    let output = asperity(
        folder,
        &["diff", "old.aspl", "new.aspl", "--json", "--within", "1"],
    );
    assert_eq!(output.status.code(), Some(1));
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(json["added"][0], "g");
    assert_eq!(json["changed"]["w"]["spectrum_db"][1], 0.0);
}

#[test]
fn textures_are_renamed_and_a_name_is_given_once() {
    let inputs = manifest();
    let folder = inputs.path();
    good(folder, &["import", "hatt", "mixed/a.xml", "-o", "a.aspl"]);
    good(folder, &["merge", "a.aspl", "good.asp", "-o", "two.aspl"]);
    good(
        folder,
        &["rename", "two.aspl", "A", "B", "-o", "renamed.aspl"],
    );
    good(folder, &["extract", "renamed.aspl", "B", "-o", "b.asp"]);
    let asset = bytes(folder, "b.asp");
    assert_eq!(
        asperity_formats::Asset::parse(&asset)
            .expect("an asset")
            .name(),
        "B"
    );
    good(
        folder,
        &["rename", "renamed.aspl", "B", "A", "-o", "back.aspl"],
    );
    assert!(bytes(folder, "back.aspl") == bytes(folder, "two.aspl"));
    let other = asperity_formats::Asset::parse(&bytes(folder, "good.asp"))
        .expect("it")
        .name()
        .to_owned();
    refused(
        folder,
        &["rename", "two.aspl", "A", &other, "-o", "x.aspl"],
        &["already"],
    );
    refused(
        folder,
        &["rename", "two.aspl", "nobody", "x", "-o", "x.aspl"],
        &["nobody"],
    );
    let output = asperity(
        folder,
        &["rename", "two.aspl", "A", "a\u{7}", "-o", "x.aspl"],
    );
    assert_eq!(output.status.code(), Some(2));
    refused(
        folder,
        &[
            "merge",
            "a.aspl",
            "renamed.aspl",
            "none.aspl",
            "-o",
            "x.aspl",
        ],
        &["none.aspl"],
    );
}

/// Names that a system obeys, refuses or hides become files that every system takes.
#[test]
fn split_writes_safe_files_and_says_which_names_they_lack() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    good(folder, &["builtin", "-o", "a.asp"]);
    let names = ["NUL", "txt\u{202e}psa", ".ssh", "oak", "OAK"];
    let mut parts = Vec::new();
    for (index, name) in names.iter().enumerate() {
        let part = format!("{index}.asp");
        good(folder, &["rename", "a.asp", "0", name, "-o", &part]);
        parts.push(part);
    }
    let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
    good(
        folder,
        &[&["merge"], &parts[..], &["-o", "all.aspl"]].concat(),
    );
    let split = asperity(folder, &["split", "all.aspl", "-o", "files"]);
    assert!(split.status.success(), "{}", text(&split.stderr));
    let wanted = [
        "OAK.asp",
        "_.ssh.asp",
        "_NUL.asp",
        "oak (2).asp",
        "txt_psa.asp",
    ];
    assert_eq!(entries(&folder.join("files")), wanted);
    let told = text(&split.stderr);
    assert_eq!(told.matches("is written as").count(), 4, "{told}");
    assert!(
        told.contains("\"NUL\" is written as \"_NUL.asp\""),
        "{told}"
    );
    assert!(!told.contains('\u{202e}'), "{told}");
}

/// The JSON of a library is made and printed part by part; it is one text, and a damaged texture leaves none of it.
#[test]
fn a_large_library_is_inspected_part_by_part() {
    let inputs = inputs();
    let folder = inputs.path();
    let asset = fs::read(folder.join("good.asp")).expect("an asset");
    // More than are in memory together.
    let names: Vec<String> = (0..1030).map(|n| format!("t{n:04}")).collect();
    let named: Vec<NamedAsset<'_>> = names
        .iter()
        .map(|name| NamedAsset {
            name,
            bytes: &asset,
        })
        .collect();
    let mut library = encode(&named).expect("a library");
    fs::write(folder.join("many.aspl"), &library).expect("a library");
    let said = good(folder, &["inspect", "many.aspl", "--json"]);
    assert_eq!(said.lines().count(), 1);
    let json: serde_json::Value = serde_json::from_str(&said).expect("JSON");
    let textures = json["textures"].as_array().expect("textures");
    let found: Vec<&str> = textures.iter().filter_map(|t| t["name"].as_str()).collect();
    assert_eq!(
        (json["format_version"].as_u64(), found),
        (Some(1), names.iter().map(String::as_str).collect())
    );
    let one = good(
        folder,
        &["inspect", "many.aspl", "--texture", "t0777", "--json"],
    );
    let one: serde_json::Value = serde_json::from_str(&one).expect("JSON");
    assert_eq!(textures[777], one);
    // What `list` and the table say is of the model that the JSON shows.
    let list = good(folder, &["list", "many.aspl", "--json"]);
    let list: serde_json::Value = serde_json::from_str(&list).expect("JSON");
    assert_eq!(list["textures"][777]["attributes"], one["attributes"]);
    let last = library.len() - 1;
    library[last] ^= 1;
    fs::write(folder.join("many.aspl"), &library).expect("a library");
    refused(folder, &["inspect", "many.aspl", "--json"], &["t1029"]);
    let output = asperity(folder, &["inspect", "many.aspl", "--json"]);
    assert_eq!(text(&output.stdout), "");
}

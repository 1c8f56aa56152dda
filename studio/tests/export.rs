//! A page as static files: what a server would answer, whoever serves them.

use crate::gallery::{NAMES, packed, started, stop, textures};
use asperity_io::diagnostic::Diagnostic as _;
use asperity_studio::{Collection, Exported, export};
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    fs,
    path::Path,
    sync::atomic::{AtomicUsize, Ordering},
};

/// Every file below a folder, by its path from there.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let entry = entry.expect("an entry");
        let name = entry.file_name().into_string().expect("a name");
        if entry.path().is_dir() {
            let below = files(&entry.path());
            found.extend(
                below
                    .into_iter()
                    .map(|(file, bytes)| (format!("{name}/{file}"), bytes)),
            );
        } else {
            found.insert(name, fs::read(entry.path()).expect("bytes"));
        }
    }
    found
}

fn json_of(bytes: &[u8]) -> Value {
    serde_json::from_slice(bytes).expect("JSON")
}

/// Writes the page of a collection; its files, and what was reported.
fn exported(collection: &Path, to: &Path) -> (BTreeMap<String, Vec<u8>>, Exported) {
    let collection =
        Collection::open(collection).unwrap_or_else(|_| panic!("{}", collection.display()));
    let done = AtomicUsize::new(0);
    let said = export(collection, None, to, || {
        done.fetch_add(1, Ordering::Relaxed);
    })
    .expect("room");
    assert_eq!(done.into_inner(), said.textures);
    (files(to), said)
}

/// The server's answers, without what it knows of its own machine.
fn anywhere(mut answer: Value, folder: &Path) -> Value {
    if let Some(command) = answer["command"].as_str() {
        let here = format!("{}/", folder.display());
        answer["command"] = command.replace(&here, "").into();
    }
    for field in ["places", "editable"] {
        if let Some(object) = answer.as_object_mut() {
            object.remove(field);
        }
    }
    answer
}

#[test]
fn the_files_are_the_answers_of_a_server_and_name_no_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = fs::canonicalize(folder.path()).expect("a folder");
    let all = textures();
    let (library, assets) = (folder.join("my.aspl"), folder.join("assets"));
    fs::write(&library, packed(&all)).expect("room");
    fs::create_dir(&assets).expect("room");
    for (name, bytes) in NAMES.iter().zip(&all) {
        fs::write(assets.join(format!("{name}.asp")), bytes).expect("room");
    }
    for (n, collection) in [&library, &assets].into_iter().enumerate() {
        let (found, said) = exported(collection, &folder.join(format!("page{n}")));
        assert_eq!((said.textures, said.files), (3, found.len()));
        assert_eq!(
            said.bytes,
            found.values().map(|bytes| bytes.len() as u64).sum::<u64>()
        );
        let site = started(collection);
        for (name, bytes) in &found {
            assert!(
                !bytes
                    .windows(folder.as_os_str().len())
                    .any(|part| part == folder.as_os_str().as_encoded_bytes()),
                "{name} names a folder"
            );
            let bundled = ["index.html", "studio.css", "studio.js"].contains(&name.as_str());
            if !name.starts_with("api/") && !bundled {
                assert!(site.get(name).body == *bytes, "{name}");
            }
        }
        let page = String::from_utf8(found["index.html"].clone()).expect("text");
        let policy = site
            .get("")
            .header("content-security-policy")
            .expect("a policy")
            .to_owned();
        let policy = policy
            .strip_suffix("; frame-ancestors 'none'")
            .expect("what a page cannot state");
        assert!(page.contains(&format!(
            "<meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">"
        )));

        let about = json_of(&found["api/about.json"]);
        let live = site.get("api/about.json").json();
        for (field, value) in about.as_object().expect("an object") {
            let expected = match &**field {
                "exported" => json!(true),
                "opens" | "prompts" => json!(false),
                "folder" => Value::Null,
                "words" | "sliders" => json!([]),
                "compiler" => Value::Null,
                "files" => json!(["asp", "png", "normal.png"]),
                _ => live[field].clone(),
            };
            assert_eq!(*value, expected, "{field}");
        }
        let columns = json_of(&found["api/library/0.json"]);
        let live = site.get("api/library/0.json").json();
        for at in 0..3 {
            let shown = json_of(&found[&format!("api/library/0/{at}.json")]);
            let picked = site.get(&format!("api/library/0/{at}.json")).json();
            assert_eq!(anywhere(shown.clone(), &folder), anywhere(picked, &folder));
            let id = shown["id"].as_str().expect("a name");
            assert_eq!(columns["textures"][at], id);
            for ending in ["asp", "worklet.asp", "png", "unlit.png", "normal.png"] {
                let file = format!("api/texture/{id}.{ending}");
                assert!(site.get(&file).body == found[&file], "{file}");
            }
        }
        for field in ["names", "prompts", "rough_db", "mu", "bytes"] {
            assert_eq!(columns[field], live[field], "{field}");
        }
        stop(site);
    }
}

#[test]
fn another_folder_gives_the_same_bytes_and_twins_share_their_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let bytes = &textures()[0];
    let mut written = Vec::new();
    for place in ["a", "b"] {
        let place = folder.path().join(place);
        fs::create_dir_all(place.join("assets")).expect("room");
        for name in ["one.asp", "two.asp"] {
            fs::write(place.join("assets").join(name), bytes).expect("room");
        }
        written.push(exported(&place.join("assets"), &place.join("page")).0);
    }
    assert!(written[0] == written[1]);
    let textures = written[0]
        .keys()
        .filter(|name| name.starts_with("api/texture/"));
    assert_eq!(textures.count(), 5);
}

#[test]
fn a_texture_that_is_damaged_meanwhile_ends_it_and_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let (assets, page) = (folder.path().join("assets"), folder.path().join("page"));
    fs::create_dir(&assets).expect("room");
    let mut bytes = textures()[1].clone();
    fs::write(assets.join("cork.asp"), &bytes).expect("room");
    let collection = Collection::open(&assets).unwrap_or_else(|_| panic!("it is good"));
    let last = bytes.len() - 9;
    bytes[last] ^= 1;
    fs::write(assets.join("cork.asp"), &bytes).expect("room");
    let error = export(collection, None, &page, || ()).expect_err("it is damaged");
    assert!(error.to_string().starts_with("cork: "), "{error}");
    assert!(!error.remedy().is_empty());
    assert!(!page.exists());
}

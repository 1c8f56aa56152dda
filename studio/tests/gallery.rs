//! Libraries on the page: what the gallery shows, and what is taken of them.

use crate::client::{Reply, SHARED, Site};
use asperity::{
    emit::{lower::lower, raise::raise},
    emit::{
        pack::{NamedAsset, encode},
        sections::renamed,
    },
    library::{LoadedLibrary, diff},
    model::attributes,
    sources::builtin,
    views::preview,
};
use asperity_formats::Asset;
use asperity_studio::{Collection, Limits};
use serde_json::{Value, json};
use std::{fs, path::Path};

pub(crate) const NAMES: [&str; 3] = ["-dash", "cork", "wet ice"];

/// Three textures that differ, the second with a picture.
pub(crate) fn textures() -> Vec<Vec<u8>> {
    let one = |(n, name): (usize, &&str)| {
        let mut texture = builtin::texture();
        texture.friction.mu = 0.2 + 0.1 * n as f64;
        texture.provenance.prompt = (n == 2).then(|| "wet ice".to_owned());
        let png = preview::png(&texture, 64).expect("a picture");
        let bytes = lower(&texture, (n == 1).then_some(&png[..]))
            .expect("an asset")
            .bytes;
        renamed(&bytes, name).expect("a name")
    };
    NAMES.iter().enumerate().map(one).collect()
}

pub(crate) fn packed(textures: &[Vec<u8>]) -> Vec<u8> {
    let named: Vec<_> = NAMES
        .iter()
        .zip(textures)
        .map(|(name, bytes)| NamedAsset { name, bytes })
        .collect();
    encode(&named).expect("a library")
}

pub(crate) fn started(path: &Path) -> Site {
    let collection = Collection::open(path).unwrap_or_else(|_| panic!("{}", path.display()));
    Site::start(Some(collection), Limits::default())
}

pub(crate) fn stop(site: Site) {
    site.stopper.stop();
    site.thread.join().expect("it ends");
}

fn drop_on(site: &Site, name: &str, bytes: &[u8]) -> Value {
    let reply = site.post(&format!("api/open?name={name}"), bytes);
    assert_eq!(reply.status, 200, "{reply:?}");
    reply.json()["library"].clone()
}

fn pick(site: &Site, library: &Value, at: usize) -> Reply {
    let id = library["id"].as_str().expect("a name");
    site.get(&format!("api/library/{id}/{at}.json"))
}

#[test]
fn a_library_and_a_folder_are_shown_and_give_their_textures() {
    let folder = tempfile::tempdir().expect("a folder");
    let all = textures();
    let (file, assets) = (folder.path().join("my.aspl"), folder.path().join("assets"));
    fs::write(&file, packed(&all)).expect("room");
    fs::create_dir(&assets).expect("room");
    for (name, bytes) in NAMES.iter().zip(&all) {
        fs::write(assets.join(format!("{name}.asp")), bytes).expect("room");
    }
    for path in [&file, &assets] {
        let site = started(path);
        let library = site.get("api/about.json").json()["library"].clone();
        let columns = site.get("api/library/0.json").json();
        assert_eq!(
            (&columns["id"], &columns["name"]),
            (&library["id"], &library["name"])
        );
        assert_eq!(columns["names"], json!(NAMES));
        assert_eq!(columns["prompts"], json!([null, null, "wet ice"]));
        assert_eq!(columns["certainty"], json!([null, null, null]));
        for (at, bytes) in all.iter().enumerate() {
            let asset = Asset::parse(bytes).expect("an asset");
            let found = attributes::of(&raise(&asset));
            for (column, value) in [
                ("rough_db", json!(found.rough_db)),
                ("sharp_hz", json!(found.sharp_hz)),
                ("hard_hz", json!(found.hard_hz)),
                ("mu", json!(found.mu)),
                ("bytes", json!(bytes.len())),
            ] {
                assert_eq!(columns[column][at], value, "{column} {at}");
            }
            let texture = pick(&site, &library, at).json();
            let id = texture["id"].as_str().expect("a name");
            assert!(site.get(&format!("api/texture/{id}.asp")).body == *bytes);
            let shown = path.display();
            let expected = match NAMES[at] {
                _ if path == &assets => Value::Null,
                "-dash" => json!(format!("asperity extract -o _-dash.asp -- {shown} -dash")),
                "cork" => json!(format!("asperity extract {shown} cork -o cork.asp")),
                _ => json!(format!(
                    "asperity extract {shown} 'wet ice' -o 'wet ice.asp'"
                )),
            };
            assert_eq!(texture["command"], expected);
            let png = site.get(&format!("api/library/0/{at}.png"));
            assert_eq!(png.header("content-type"), Some("image/png"));
            match asset.preview_png() {
                Some(stored) => assert!(png.body == stored),
                None => assert_eq!(preview::width(&png.body), Some(96)),
            }
            let again = site.get(&format!("api/library/0/{at}.png"));
            assert!(again.body == png.body);
        }
        stop(site);
    }
}

#[test]
fn the_last_two_dropped_libraries_are_kept_beside_that_of_the_start() {
    let folder = tempfile::tempdir().expect("a folder");
    let library = packed(&textures());
    let file = folder.path().join("start.aspl");
    fs::write(&file, &library).expect("room");
    let site = started(&file);
    let dropped = ["a.aspl", "b.aspl", "c.aspl"].map(|name| drop_on(&site, name, &library));
    let found = |library: &Value| {
        let id = library["id"].as_str().expect("a name");
        site.get(&format!("api/library/{id}.json")).status
    };
    assert_eq!(dropped.each_ref().map(found), [404, 200, 200]);
    assert_eq!(found(&json!({ "id": "0" })), 200);
    let texture = pick(&site, &dropped[2], 1).json();
    assert_eq!(
        texture["command"],
        "asperity extract c.aspl cork -o cork.asp"
    );
    // It stays what it was, whatever becomes of its library.
    let id = texture["id"].as_str().expect("a name");
    let file = site.get(&format!("api/texture/{id}.asp"));
    assert!(file.body == textures()[1]);
    stop(site);
}

#[test]
fn what_changed_between_two_libraries_is_what_the_command_prints() {
    let site = &*SHARED;
    let folder = tempfile::tempdir().expect("a folder");
    let old = textures();
    let mut now = old.clone();
    now[1] = renamed(&old[2], "cork").expect("a name");
    let files = [("old.aspl", packed(&old)), ("now.aspl", packed(&now[..2]))];
    let [before, after] = files.each_ref().map(|(name, bytes)| {
        fs::write(folder.path().join(name), bytes).expect("room");
        drop_on(site, name, bytes)["id"].clone()
    });
    let ids = |a: &Value, b: &Value| {
        let [a, b] = [a, b].map(|id| id.as_str().expect("a name"));
        format!("api/difference/{a}/{b}.json")
    };
    for (from, to, path) in [
        (0, 1, ids(&before, &after)),
        (1, 0, ids(&after, &before)),
        (0, 0, ids(&before, &before)),
    ] {
        let library = |at: usize| LoadedLibrary::open(&folder.path().join(files[at].0));
        let [a, b] = [from, to].map(|at| library(at).expect("a library"));
        let expected = diff(&a, &b).expect("two libraries");
        let expected = serde_json::to_value(&expected).expect("JSON");
        let found = site.get(&path);
        assert_eq!(
            String::from_utf8_lossy(&found.body),
            format!("{expected:#}\n")
        );
    }
    for path in [
        "api/difference/gone/gone.json",
        "api/difference/1.json",
        "api/difference/",
    ] {
        assert_eq!(site.get(path).status, 404, "{path}");
    }
    assert_eq!(site.post(&ids(&before, &after), b"").status, 405);
}

#[test]
fn libraries_and_places_that_are_not_there_are_said_so() {
    let site = &*SHARED;
    let library = drop_on(site, "three.aspl", &packed(&textures()));
    let id = library["id"].as_str().expect("a name");
    for (method, path, body, status, named) in [
        (
            "GET",
            "api/library/gone.json".to_owned(),
            &b""[..],
            404,
            "does not have this library",
        ),
        (
            "GET",
            format!("api/library/{id}/3.png"),
            b"",
            404,
            "three.aspl: no texture 3",
        ),
        (
            "GET",
            format!("api/library/{id}/3.json"),
            b"",
            404,
            "it has 3 textures",
        ),
        (
            "GET",
            format!("api/library/{id}/-1.json"),
            b"",
            404,
            "nothing has this address",
        ),
        (
            "GET",
            format!("api/library/{id}/1"),
            b"",
            404,
            "nothing has this address",
        ),
        (
            "POST",
            format!("api/library/{id}/1.json"),
            b"{}",
            405,
            "GET",
        ),
        ("POST", format!("api/library/{id}.json"), b"{}", 405, "GET"),
        (
            "GET",
            format!("api/library/{id}/../{id}.json"),
            b"",
            404,
            "nothing",
        ),
        ("GET", "api/library/".to_owned(), b"", 404, "nothing"),
    ] {
        let reply = site.request(method, &path, "", body);
        assert_eq!(reply.status, status, "{method} {path}: {reply:?}");
        let json = reply.json();
        assert!(json["error"].to_string().contains(named), "{path}: {json}");
    }
    // Damage behind a good index is found when the file is dropped.
    let mut damaged = packed(&textures());
    let last = damaged.len() - 9;
    damaged[last] ^= 1;
    let reply = site.post("api/open?name=bad.aspl", &damaged);
    assert_eq!(reply.status, 422, "{reply:?}");
    let error = reply.json()["error"].to_string();
    assert!(error.contains("bad.aspl: texture"), "{error}");
}

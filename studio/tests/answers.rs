//! Answers to the page, byte for byte equal to the compiler's own output.

use crate::client::{SHARED, Site};
use asperity::{
    driver,
    emit::{lower::lower, pack::encode, sections::without_preview},
    learned::inference::Backend,
    pipeline::Request,
    sources::{
        SourceOutput, Tools, builtin,
        prompt::{Options, PromptCompiler},
    },
    views::{
        inspect::{self, Document},
        preview,
    },
};
use asperity_formats::Asset;
use asperity_studio::{Collection, Limits};
use std::{fs, path::Path};

#[test]
fn every_answer_has_the_headers_that_bind_the_page() {
    let site = &*SHARED;
    for (path, content_type) in [
        ("", "text/html; charset=utf-8"),
        ("index.html", "text/html; charset=utf-8"),
        ("studio.css", "text/css; charset=utf-8"),
        ("studio.js", "text/javascript; charset=utf-8"),
        ("worklet.js", "text/javascript; charset=utf-8"),
        ("icon.svg", "image/svg+xml"),
        ("asperity.wasm", "application/wasm"),
        ("api/about.json", "application/json"),
        ("none", "application/json"),
    ] {
        let reply = site.get(path);
        assert_eq!(reply.header("content-type"), Some(content_type), "{path}");
        let policy = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' \
            blob: data:; connect-src 'self'; worker-src 'self'; font-src 'self'; base-uri 'none'; form-action \
            'none'; frame-ancestors 'none'";
        for (header, value) in [
            ("content-security-policy", policy),
            ("x-content-type-options", "nosniff"),
            ("referrer-policy", "no-referrer"),
            ("cross-origin-resource-policy", "same-origin"),
            ("cache-control", "no-store"),
        ] {
            assert_eq!(reply.header(header), Some(value), "{path}");
        }
        let head = site
            .request("HEAD", path, "Connection: close\r\n", b"")
            .head;
        assert_eq!(head, reply.head.replace("keep-alive", "close"), "{path}");
    }
    let committed = Path::new(env!("CARGO_MANIFEST_DIR")).join("page/asperity.wasm");
    assert!(site.get("asperity.wasm").body == fs::read(committed).expect("the module"));
}

#[test]
fn the_address_without_its_slash_leads_to_the_page() {
    let site = &*SHARED;
    let bare = site.page.trim_end_matches('/');
    let request = format!("GET {bare} HTTP/1.1\r\nHost: {}\r\n\r\n", site.address);
    let reply = site.send(request.as_bytes());
    assert_eq!(
        (reply.status, reply.header("location")),
        (308, Some(&*site.page))
    );
}

#[test]
fn a_prompt_gives_the_bytes_and_the_reports_of_the_compiler() {
    let site = &*SHARED;
    let prompt_compiler = PromptCompiler::embedded(&Backend::Portable).expect("the model");
    for (prompt, seed) in [("wet ice", 0), ("rough 'abrasive' sheet", 3)] {
        let body = serde_json::json!({ "prompt": prompt, "seed": seed }).to_string();
        let json = site.post("api/compile", body.as_bytes()).json();
        let options = Options {
            seed,
            ..Options::default()
        };
        let compiled = prompt_compiler
            .compile(prompt, &options)
            .expect("a texture");
        let bytes = &compiled.lowered.bytes;
        let asset = Asset::parse(bytes).expect("an asset");
        let id = json["id"].as_str().expect("a name");
        let file = |ending: &str| site.get(&format!("api/texture/{id}.{ending}"));
        assert!(file("asp").body == *bytes);
        assert!(file("worklet.asp").body == without_preview(bytes).expect("an asset"));
        assert!(file("png").body == asset.preview_png().expect("a picture"));
        let inspected = inspect::json(&Document::of(&asset)) + "\n";
        assert_eq!(file("json").body, inspected.as_bytes());
        assert_eq!(
            json["inspect"].to_string(),
            serde_json::from_str::<serde_json::Value>(&inspected)
                .expect("JSON")
                .to_string()
        );
        for map in ["unlit.png", "normal.png", "height.png"] {
            let reply = file(map);
            assert_eq!(preview::width(&reply.body), Some(preview::SIZE), "{map}");
            assert_eq!(reply.header("content-type"), Some("image/png"));
            assert_eq!(
                reply.header("cache-control"),
                Some("private, max-age=31536000, immutable")
            );
        }
        assert_eq!(json["name"], asset.name());
        assert_eq!(json["seed"], seed);
        assert_eq!(json["asset_bytes"], bytes.len());
        assert_eq!(json["model_rate_hz"], json["worklet_rate_hz"]);
        assert_eq!(
            json["preview"],
            serde_json::json!({ "pixels": 256, "width_mm": 60.0 })
        );
        for field in ["words", "reading", "phrase", "certainty", "nearest"] {
            assert!(
                !json["compiled"][field].is_null(),
                "{field} of {}",
                json["compiled"]
            );
        }
        assert!(
            json["command"]
                .as_str()
                .expect("a command")
                .starts_with("asperity compile '")
        );
    }
}

#[test]
fn an_asset_at_a_rate_that_the_worklet_does_not_serve_is_converted_for_it() {
    let site = &*SHARED;
    let request = Request {
        rate_hz: Some(1500.0),
        ..Request::default()
    };
    let source = SourceOutput::new(builtin::texture());
    let compiled = driver::compile(&source, &request, &Tools::default()).expect("a texture");
    let bytes = compiled.lowered.bytes;
    let json = site.post("api/open?name=grit.asp", &bytes).json()["texture"].clone();
    assert_eq!(
        (&json["model_rate_hz"], &json["worklet_rate_hz"]),
        (&1500.0.into(), &1600.0.into())
    );
    assert!(json["compiled"].is_null() && json["command"].is_null());
    let id = json["id"].as_str().expect("a name");
    assert!(site.get(&format!("api/texture/{id}.asp")).body == bytes);
    let worklet = site.get(&format!("api/texture/{id}.worklet.asp")).body;
    let asset = Asset::parse(&worklet).expect("an asset");
    assert_eq!(asset.grid().sample_rate_hz(), 1600.0);
}

#[test]
fn a_library_and_a_folder_are_checked_and_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let asset = lower(&builtin::texture(), None).expect("an asset").bytes;
    let named = |name: &str| {
        let bytes = asperity::emit::sections::renamed(&asset, name).expect("a name");
        (name.to_owned(), bytes)
    };
    let two = [named("a"), named("b")];
    let entries: Vec<_> = two
        .iter()
        .map(|(name, bytes)| asperity::emit::pack::NamedAsset { name, bytes })
        .collect();
    let library = encode(&entries).expect("a library");
    fs::write(at("two.aspl"), &library).expect("room");
    fs::create_dir(at("assets")).expect("room");
    for (name, bytes) in &two {
        fs::write(at("assets").join(format!("{name}.asp")), bytes).expect("room");
    }
    fs::write(at("assets/notes.txt"), "x").expect("room");
    for (path, is_folder) in [("two.aspl", false), ("assets", true)] {
        let collection = Collection::open(&at(path)).unwrap_or_else(|_| panic!("{path}"));
        let site = Site::start(Some(collection), Limits::default());
        let about = site.get("api/about.json").json();
        assert_eq!(
            about["library"],
            serde_json::json!({ "id": "0", "name": path, "textures": 2 })
        );
        assert_eq!(about["folder"].is_string(), is_folder);
        assert_eq!(about["version"], env!("CARGO_PKG_VERSION"));
        let words = about["words"].as_array().expect("words");
        assert!(
            words.iter().any(|word| word == "cork") && words.iter().any(|word| word == "bumpy")
        );
        site.stopper.stop();
        site.thread.join().expect("it ends");
    }
    fs::create_dir(at("empty")).expect("room");
    fs::write(at("damaged.aspl"), &library[..library.len() - 9]).expect("room");
    fs::write(at("assets/c.asp"), &asset[..99]).expect("room");
    fs::write(at("one.asp"), &asset).expect("room");
    assert_eq!(
        Collection::open(&at("one.asp"))
            .expect("an asset")
            .textures(),
        1
    );
    for (path, named) in [
        ("empty", "no asset"),
        ("damaged.aspl", "library"),
        ("assets", "c.asp"),
        ("missing.aspl", "missing.aspl"),
    ] {
        let failures = Collection::open(&at(path)).err().unwrap_or_default();
        assert_eq!(failures.len(), 1, "{path}");
        assert!(
            failures[0].to_string().contains(named),
            "{path}: {}",
            failures[0]
        );
    }
}

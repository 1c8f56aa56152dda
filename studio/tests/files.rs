//! Files out and in: the bytes of the calls that the commands use, whatever the kind.

use crate::client::{SHARED, Site};
use asperity::{
    driver,
    emit::lower::lower,
    emit::{
        pack::{NamedAsset, encode},
        sections::renamed,
    },
    interchange::{self, ClipFormat, Format, Language, Options, SourceOptions, export_source},
    passes::reduce::Fidelity,
    pipeline::Request,
    sources::{
        Source, Tools, builtin,
        effects::{self, Effects},
        hatt::Hatt,
        model_file::{self, ModelFile},
    },
    views::{
        listen::{self, Gesture},
        plot, preview,
    },
};
use asperity_formats::Asset;
use serde_json::{Value, json};
use std::fs;

/// A texture without a picture, under a name of its own.
fn asset(name: &str) -> Vec<u8> {
    let bytes = lower(&builtin::texture(), None).expect("an asset").bytes;
    renamed(&bytes, name).expect("a name")
}

fn open(site: &Site, name: &str, bytes: &[u8]) -> Value {
    let reply = site.post(&format!("api/open?name={name}"), bytes);
    assert_eq!(reply.status, 200, "{name}: {reply:?}");
    reply.json()
}

fn download(texture: &Value, ending: &str) -> Vec<u8> {
    let id = texture["id"].as_str().expect("a name");
    let reply = SHARED.get(&format!("api/texture/{id}.{ending}"));
    assert_eq!(reply.status, 200, "{ending}: {reply:?}");
    reply.body
}

#[test]
fn every_file_of_a_texture_has_the_bytes_of_its_command() {
    let bytes = asset("fine grit");
    let texture = &open(&SHARED, "a.b.asp", &bytes)["texture"];
    let asset = Asset::parse(&bytes).expect("an asset");
    assert!(download(texture, "plot.png") == plot::of_asset(&asset).expect("a sheet"));
    let session = Gesture::asked(None, None, false);
    let heard = listen::listen(&asset, &session, None, 0).expect("a sound");
    assert!(download(texture, "listen.wav") == heard.wav);
    let mut options = SourceOptions {
        header: Some("a.b.h"),
        ..SourceOptions::default()
    };
    let c = export_source(Language::C, "fine grit", &bytes, &options).expect("a text");
    assert!(download(texture, "export.c") == c.text);
    assert!(download(texture, "export.h") == c.header.expect("a header"));
    options.header = None;
    let rust = export_source(Language::Rust, "fine grit", &bytes, &options).expect("a text");
    assert!(download(texture, "export.rs") == rust.text);
    // The defaults of the command, one by one.
    let options = Options {
        session: interchange::session(None, None, None, false),
        rate_hz: None,
        seed: 0,
        full_scale_m_s2: None,
        tap_full_scale_m_s2: None,
        size_px: preview::SIZE,
    };
    for format in Format::ALL {
        let Format::Clip(format) = format else {
            continue;
        };
        let exported = interchange::export(&asset, format, &options).expect("a file");
        let ending = format!("export.{}", format.name());
        assert!(download(texture, &ending) == exported.bytes, "{ending}");
    }
}

/// A HaTT material with four models at the corners of its grid.
fn board() -> String {
    let list = |tag: &str, values: &[f64]| {
        let values: String = values
            .iter()
            .map(|x| format!("<value>{x}</value>"))
            .collect();
        format!("<{tag}>{values}</{tag}>")
    };
    let (speeds, forces) = ([0.0, 200.0, 200.0, 0.0], [0.0, 0.0, 4.0, 4.0]);
    let mut xml = String::from(
        "<modelSet><material>Board</material><AccelUnits>m/s^2</AccelUnits><SpeedUnits>mm/s</SpeedUnits>\
         <ForceUnits>N</ForceUnits><SampleRate>1000</SampleRate><mu>0.4</mu><numMod>4</numMod><numTri>2</numTri>\
         <maxSpeed>200</maxSpeed><maxForce>4</maxForce><numARCoeff>1</numARCoeff><numMACoeff>0</numMACoeff>",
    );
    xml += &list("speedList", &speeds);
    xml += &list("forceList", &forces);
    xml += &list("tri", &[1.0, 2.0, 3.0]);
    xml += &list("tri", &[1.0, 3.0, 4.0]);
    for (n, (speed, force)) in speeds.iter().zip(forces).enumerate() {
        xml += &format!("<model><modNum>{}</modNum>", n + 1);
        xml += &list("ARcoeff", &[1.0, 0.0]);
        xml += &list("ARlsf", &[std::f64::consts::FRAC_PI_2]);
        xml += &list("MAcoeff", &[1.0]);
        xml += &list("MAlsf", &[]);
        xml += &format!("<var>0.01</var><gain>1</gain><speedMod>{speed}</speedMod>");
        xml += &format!("<forceMod>{force}</forceMod></model>");
    }
    xml + "</modelSet>"
}

/// Returns the asset that `asperity import` writes for such a file on a disk.
fn imported(source: &dyn Source, fidelity: Fidelity, preview_px: Option<u32>) -> Vec<u8> {
    let request = Request {
        fidelity,
        preview_px,
        ..Request::default()
    };
    let compiled = driver::compile(source, &request, &Tools::default());
    compiled.expect("a texture").lowered.bytes
}

#[test]
fn files_of_other_tools_open_to_the_bytes_of_their_import() {
    let folder = tempfile::tempdir().expect("a folder");
    let clip = |format: ClipFormat| {
        let bytes = asset("gravel");
        let asset = Asset::parse(&bytes).expect("an asset");
        let exported = interchange::export(&asset, format, &Options::default());
        exported.expect("a file").bytes
    };
    let model = model_file::to_json(&builtin::texture());
    let size = Some(preview::SIZE);
    for (name, bytes, kind) in [
        ("Models_Board.xml", board().into_bytes(), "hatt"),
        ("grit.json", model, "model"),
        ("gravel.haptic", clip(ClipFormat::Haptic), "haptic"),
        ("gravel.ahap", clip(ClipFormat::Ahap), "ahap"),
        // The content tells, not the name.
        ("gravel.txt", clip(ClipFormat::Hjif), "hjif"),
    ] {
        let file = folder.path().join(name);
        fs::write(&file, &bytes).expect("room");
        let effects = |kind| Effects {
            file: file.clone(),
            kind,
            options: effects::Options::default(),
        };
        let expected = match kind {
            "hatt" => imported(&Hatt::new(&file), Fidelity::Full, None),
            "model" => imported(&ModelFile { file: file.clone() }, Fidelity::Full, size),
            "haptic" => imported(&effects(effects::EffectsKind::Haptic), Fidelity::Auto, size),
            "ahap" => imported(&effects(effects::EffectsKind::Ahap), Fidelity::Auto, size),
            _ => imported(&effects(effects::EffectsKind::Hjif), Fidelity::Auto, size),
        };
        let texture = &open(&SHARED, name, &bytes)["texture"];
        assert!(download(texture, "asp") == expected, "{name}");
        let command = texture["command"].as_str().expect("a command");
        assert!(
            command.starts_with(&format!("asperity import {kind} {name} -o ")),
            "{command}"
        );
        assert!(
            texture["made"]["warnings"].is_array(),
            "{}",
            texture["made"]
        );
    }
}

#[test]
fn files_that_cannot_be_opened_are_refused_by_their_name_alone() {
    let site = &*SHARED;
    for (name, bytes, error, help) in [
        ("x.xml", &b"<modelSet>"[..], "x.xml", ""),
        (
            "x.json",
            b"{\"format\": \"asperity-model\"}",
            "x.json: version",
            "",
        ),
        ("x.haptic", b"{", "x.haptic", ""),
        ("x.ahap", b"{\"Pattern\": 7}", "x.ahap", ""),
        (
            "..%2f..%2fetc%2fpasswd.xml",
            b"",
            "../../etc/passwd.xml",
            "",
        ),
        (
            "x.png",
            b"\x89PNG\r\n\x1a\n",
            "a damaged PNG",
            "export the file again",
        ),
        (
            "x.haps",
            b"{\"m_vibration\": 1}",
            ".haps",
            "export the effect",
        ),
        ("x", b"text", "x: unknown format", "convert"),
        ("x.aspl", b"ASPL", "x.aspl", "build the file again"),
    ] {
        let reply = site.post(&format!("api/open?name={name}"), bytes);
        assert_eq!(reply.status, 422, "{name}: {reply:?}");
        let json = reply.json();
        assert!(json["error"].to_string().contains(error), "{name}: {json}");
        assert!(json["help"].to_string().contains(help), "{name}: {json}");
    }
    site.still_compiles();
}

#[test]
fn textures_are_packed_to_a_library_that_opens_again() {
    let site = &*SHARED;
    let pack = |textures: Value| {
        let body = json!({ "textures": textures }).to_string();
        site.post("api/pack", body.as_bytes())
    };
    let all = ["a", "b"].map(asset);
    let [a, b] = ["a.asp", "b.asp"].map(|name| {
        let bytes = if name == "a.asp" { &all[0] } else { &all[1] };
        open(site, name, bytes)["texture"]["id"].clone()
    });
    let reply = pack(json!([{ "texture": b, "name": "z" }, { "texture": a, "name": "Käse" }]));
    assert_eq!(reply.status, 200, "{reply:?}");
    let renamed = ["z", "Käse"].map(|name| (name, renamed(&all[0], name).expect("a name")));
    let named = renamed
        .each_ref()
        .map(|(name, bytes)| NamedAsset { name, bytes });
    assert!(reply.body == encode(&named).expect("a library"));
    let opened = open(site, "two.aspl", &reply.body);
    let library = &opened["library"];
    assert_eq!(
        (&library["name"], &library["textures"]),
        (&json!("two.aspl"), &json!(2))
    );
    // One with a single texture is that texture.
    let one = pack(json!([{ "texture": a, "name": "one" }]));
    let texture = &open(site, "one.aspl", &one.body)["texture"];
    assert_eq!(texture["name"], "one");
    let long = "x".repeat(65);
    for (textures, status, named) in [
        (json!([]), 400, "textures is empty"),
        (
            json!([{ "texture": a, "name": "" }]),
            400,
            "textures[0].name",
        ),
        (
            json!([{ "texture": a, "name": long }]),
            400,
            "textures[0].name",
        ),
        (
            json!([{ "texture": a, "name": "a\nb" }]),
            400,
            "textures[0].name",
        ),
        (
            json!([{ "texture": a, "name": "x" }, { "texture": b, "name": "x" }]),
            400,
            "twice",
        ),
        (
            json!([{ "texture": "gone", "name": "x" }]),
            404,
            "does not have",
        ),
        (json!([{ "texture": a }]), 400, "name"),
        (json!({}), 400, "sequence"),
    ] {
        let reply = pack(textures.clone());
        assert_eq!(reply.status, status, "{textures}: {reply:?}");
        let json = reply.json();
        assert!(
            json["error"].to_string().contains(named),
            "{textures}: {json}"
        );
    }
}

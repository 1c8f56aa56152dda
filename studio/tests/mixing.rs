//! Textures made of others: the bytes and reports of the calls that the commands use, and how they came about.

use crate::client::{Reply, SHARED, Site};
use asperity::{
    driver,
    emit::{lower::lower, raise::raise},
    learned::inference::Backend,
    model::attributes,
    sources::{
        Tools, builtin,
        latents::{AXES, Edit, LatentEditor, Mix, MixOptions, MixPreview, Sliders},
        prompt::{Options, PromptCompiler},
    },
};
use asperity_formats::Asset;
use asperity_studio::Limits;
use base64::{Engine as _, engine::general_purpose::URL_SAFE_NO_PAD};
use serde_json::{Value, json};
use std::sync::LazyLock;

static PROMPTS: LazyLock<PromptCompiler> =
    LazyLock::new(|| PromptCompiler::embedded(&Backend::Portable).expect("the model"));

/// The bytes of a prompt.
pub(crate) fn compiled(prompt: &str) -> Vec<u8> {
    let compiled = PROMPTS.compile(prompt, &Options::default());
    compiled.expect("a texture").lowered.bytes
}

/// Returns the bytes and the report that the commands give for a mixture.
fn finished(editor: &LatentEditor<'_>, mix: Mix) -> (Vec<u8>, Value) {
    let compiled = driver::compile(&mix.source, &mix.request, &Tools::of(&PROMPTS));
    let compiled = compiled.expect("a texture");
    let report = mix.report(editor, &compiled).json;
    (compiled.lowered.bytes, report)
}

pub(crate) fn post(site: &Site, path: &str, body: &Value) -> Reply {
    site.post(path, body.to_string().as_bytes())
}

/// The texture of a request that must succeed.
fn made(path: &str, body: &Value) -> Value {
    let reply = post(&SHARED, path, body);
    assert_eq!(reply.status, 200, "{path} {body}: {reply:?}");
    reply.json()
}

pub(crate) fn prompted(prompt: &str) -> Value {
    made("api/compile", &json!({ "prompt": prompt }))
}

fn bytes(texture: &Value) -> Vec<u8> {
    let id = texture["id"].as_str().expect("a name");
    SHARED.get(&format!("api/texture/{id}.asp")).body
}

/// The report without its times, which no two runs share.
fn untimed(report: &Value) -> Value {
    let mut report = report.clone();
    report["stages_ms"] = Value::Null;
    report
}

#[test]
fn edits_have_the_bytes_and_the_report_of_the_command() {
    let editor = LatentEditor::new(&PROMPTS);
    let cork = compiled("cork");
    let asset = Asset::parse(&cork).expect("an asset");
    let start = prompted("cork");
    let sliders = Sliders {
        rougher: 20.0,
        harder: -5.5,
        ..Sliders::default()
    };
    let words = "less gritty, more waxy";
    for (change, edit, option) in [
        (
            json!({ "steps": { "slipperier": 1.5 }, "draft": true }),
            Edit::Steps(Sliders {
                slipperier: 1.5,
                ..Sliders::default()
            }),
            "--slipperier 1.5 --no-preview",
        ),
        (
            json!({ "steps": { "rougher": 20, "harder": -5.5 } }),
            Edit::Steps(sliders),
            "--rougher 20 --softer 5.5",
        ),
        (
            json!({ "words": words }),
            Edit::Words(words.into()),
            "--prompt 'less gritty, more waxy'",
        ),
    ] {
        let mut body = change;
        body["texture"] = start["id"].clone();
        let edited = made("api/edit", &body);
        let options = MixOptions {
            preview: match body["draft"] {
                Value::Null => MixPreview::Kept,
                _ => MixPreview::None,
            },
            ..MixOptions::default()
        };
        let mix = editor.change(&asset, Some(&edit), &options);
        let (expected, report) = finished(&editor, mix.expect("an edit"));
        assert!(bytes(&edited) == expected, "{body}");
        assert_eq!(untimed(&edited["made"]), untimed(&report));
        assert!(edited["compiled"].is_null());
        let attributes = attributes::of(&raise(&Asset::parse(&expected).expect("an asset")));
        for axis in AXES {
            let place = editor.scale().place(axis, &attributes);
            assert_eq!(edited["places"][axis.name()], json!(place));
        }
        assert_eq!(
            (&edited["name"], &edited["file"]),
            (&json!("cork"), &json!("cork (2).asp"))
        );
        assert_eq!(
            edited["command"],
            format!(
                "asperity compile 'cork' -o cork.asp\nasperity edit cork.asp {option} -o 'cork (2).asp'"
            )
        );
    }
    assert_eq!(
        (&start["file"], &start["made"]),
        (&json!("cork.asp"), &Value::Null)
    );
    assert_eq!(start["editable"], true);
}

#[test]
fn blends_compositions_and_encodings_have_the_bytes_of_the_commands() {
    let editor = LatentEditor::new(&PROMPTS);
    let options = MixOptions::default();
    let all = ["silk", "anvil", "wet ice"].map(compiled);
    let [a, b, c] = all
        .each_ref()
        .map(|bytes| Asset::parse(bytes).expect("an asset"));
    let [silk, anvil, ice] = ["silk", "anvil", "wet ice"].map(prompted);
    let check = |texture: &Value, mix: Mix, command: &str| {
        let (expected, report) = finished(&editor, mix);
        assert!(bytes(texture) == expected, "{command}");
        assert_eq!(untimed(&texture["made"]), untimed(&report));
        let line = texture["command"]
            .as_str()
            .expect("commands")
            .lines()
            .last();
        assert_eq!(line, Some(command));
    };
    let blend = made(
        "api/blend",
        &json!({ "a": silk["id"], "b": ice["id"], "t": 0.25 }),
    );
    check(
        &blend,
        editor.blend(&a, &c, 0.25, &options).expect("a blend"),
        "asperity blend silk.asp 'wet ice.asp' -t 0.25 -o 'silk – wet ice.asp'",
    );
    let draft = made(
        "api/blend",
        &json!({ "a": silk["id"], "b": ice["id"], "t": 0.25, "draft": true }),
    );
    let plain = MixOptions {
        preview: MixPreview::None,
        ..MixOptions::default()
    };
    check(
        &draft,
        editor.blend(&a, &c, 0.25, &plain).expect("a blend"),
        "asperity blend silk.asp 'wet ice.asp' -t 0.25 --no-preview -o 'silk – wet ice.asp'",
    );
    let body = json!({ "tap": anvil["id"], "slide": silk["id"], "friction": ice["id"] });
    let composed = made("api/compose", &body);
    check(
        &composed,
        editor
            .compose(&b, &a, Some(&c), &options)
            .expect("a composition"),
        "asperity compose --tap anvil.asp --slide silk.asp --friction 'wet ice.asp' -o 'anvil tapped, silk slid.asp'",
    );
    // A recording has no latent until it is encoded.
    let recorded = lower(&builtin::texture(), None).expect("an asset").bytes;
    let opened = SHARED.post("api/open?name=grit.asp", &recorded).json()["texture"].clone();
    assert_eq!(
        (&opened["editable"], &opened["file"]),
        (&json!(false), &json!("grit.asp"))
    );
    assert!(opened["command"].is_null());
    let refused = post(
        &SHARED,
        "api/edit",
        &json!({ "texture": opened["id"], "words": "softer" }),
    );
    assert_eq!(refused.status, 422);
    assert!(
        refused.json()["error"]
            .to_string()
            .contains("has no latent")
    );
    let encoded = made("api/encode", &json!({ "texture": opened["id"] }));
    let asset = Asset::parse(&recorded).expect("an asset");
    check(
        &encoded,
        editor.encoded(&asset, None, &options).expect("a latent"),
        "asperity encode grit.asp -o 'Built-in Grit.asp'",
    );
    assert_eq!(encoded["editable"], true);
}

#[test]
fn the_page_learns_the_scale_of_the_sliders_and_the_exports() {
    let about = SHARED.get("api/about.json").json();
    assert_eq!(about["prompts"], true);
    let editor = LatentEditor::new(&PROMPTS);
    for (axis, slider) in AXES
        .iter()
        .zip(about["sliders"].as_array().expect("sliders"))
    {
        let (low, high) = editor.scale().range(*axis);
        let sign = if axis.name() == "slippery" { -1.0 } else { 1.0 };
        assert_eq!(slider["axis"], axis.name());
        assert_eq!(
            (&slider["low"], &slider["high"]),
            (&json!(sign * low), &json!(sign * high))
        );
    }
    let endings: Vec<&str> = about["exports"]
        .as_array()
        .expect("exports")
        .iter()
        .filter_map(|export| export["ending"].as_str())
        .collect();
    assert_eq!(
        endings.join(" "),
        "export.c export.h export.rs export.hjif export.hmpg export.ahap export.haptic export.gltf export.wav export.csv"
    );
}

#[test]
fn a_link_makes_the_same_bytes_wherever_it_is_opened() {
    let (wool, steel) = (prompted("wool"), prompted("brushed steel"));
    let edited = made(
        "api/edit",
        &json!({ "texture": wool["id"], "steps": { "rougher": 7.5 } }),
    );
    let blended = made(
        "api/blend",
        &json!({ "a": edited["id"], "b": steel["id"], "t": 0.3 }),
    );
    let mixed = made(
        "api/compose",
        &json!({ "tap": blended["id"], "slide": wool["id"], "friction": edited["id"] }),
    );
    let site = Site::start(None, Limits::default());
    for texture in [&wool, &edited, &blended, &mixed] {
        let reply = post(&site, "api/link", &json!({ "link": texture["link"] }));
        assert_eq!(reply.status, 200, "{reply:?}");
        let found = reply.json();
        assert_eq!(found["same"], true);
        for key in ["id", "command", "link", "name"] {
            assert_eq!(found["texture"][key], texture[key]);
        }
    }
    let link = json!({ "link": edited["link"] });
    let found = post(&site, "api/link", &link).json();
    assert_eq!(found["base"]["id"], wool["id"], "the sliders begin at wool");
    assert_eq!(found["steps"]["rougher"], 7.5);
}

#[test]
fn what_is_no_link_of_words_is_refused() {
    let opened = SHARED.post("api/open?name=moss.asp", &compiled("moss"));
    assert!(opened.json()["texture"]["link"].is_null(), "it has a file");
    let link = |steps: Value| {
        let text = json!({ "id": "", "steps": steps }).to_string();
        json!({ "link": URL_SAFE_NO_PAD.encode(text) })
    };
    let compile = json!({ "Compile": { "prompt": "cork", "seed": 0 } });
    let blend = |a: &str, t: f64| json!({ "Blend": { "a": a, "b": "0", "t": t, "draft": false } });
    for (link, said) in [
        (json!({ "link": "" }), "no recipe"),
        (json!({ "link": "bm90aGluZw" }), "no recipe"),
        (link(json!([])), "no recipe"),
        (link(json!(vec![compile.clone(); 65])), "no recipe"),
        (link(json!([compile, blend("1", 0.5)])), "not made before"),
        (link(json!([compile, blend("-1", 0.5)])), "not made before"),
        (link(json!([compile, blend("0", 1.5)])), "t is 1.5"),
        (
            link(json!([{ "File": { "path": "/etc/passwd", "id": "" } }])),
            "names a file",
        ),
    ] {
        let reply = post(&SHARED, "api/link", &link);
        let error = reply.json()["error"].to_string();
        assert!(
            reply.status == 400 && error.contains(said),
            "{link}: {reply:?}"
        );
    }
    let other = post(&SHARED, "api/link", &link(json!([compile])));
    assert_eq!(other.json()["same"], false, "its bytes are others");
}

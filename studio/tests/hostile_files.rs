//! Untrusted input from the page: copied prompts, dropped files.

use crate::client::{Reply, SHARED, Site};
use asperity::{
    emit::lower::lower,
    emit::sections::renamed,
    interchange::{self, ClipFormat, Options},
    sources::builtin,
    views::preview,
};
use asperity_formats::Asset;
use asperity_tests::{damage::seal, draw::Draw};
use serde_json::{Value, json};

fn asset() -> Vec<u8> {
    let texture = builtin::texture();
    let png = preview::png(&texture, 64).expect("a picture");
    lower(&texture, Some(&png)).expect("an asset").bytes
}

/// Refused in the command's words, and not as a bug of the server.
fn refused(reply: &Reply, status: u16, what: &str) -> Value {
    assert_eq!(reply.status, status, "{what}: {reply:?}");
    let json = reply.json();
    assert!(
        json["error"].is_string() && json["help"].is_string(),
        "{what}: {json}"
    );
    json
}

#[test]
fn damaged_assets_are_refused_in_the_words_of_the_command() {
    let site = &*SHARED;
    let good = asset();
    let open = |bytes: &[u8]| site.post("api/open?name=drop.asp", bytes);
    assert_eq!(open(&good).status, 200);
    for length in [0, 3, 4, 19, 20, 100, good.len() / 2, good.len() - 1] {
        let json = refused(&open(&good[..length]), 422, &format!("{length} bytes"));
        assert!(json["error"].to_string().contains("drop.asp"), "{json}");
    }
    let mut flipped = good.clone();
    flipped[200] ^= 4;
    let mut later = good.clone();
    later[4] = 9;
    let long = [&good[..], b"x"].concat();
    let mut million = b"ASPL\x01\0\0\0".to_vec();
    million.extend((1_u32 << 20).to_le_bytes());
    million.resize(64, 0xff);
    for (what, bytes) in [
        ("a flipped bit", &flipped[..]),
        ("a later version", &later),
        ("a byte more", &long),
        ("a library that promises a million textures", &million),
        ("a picture", b"\x89PNG\r\n\x1a\n"),
        ("a page", b"<script>alert(1)</script>"),
        ("noughts", &[0; 100_000]),
    ] {
        refused(&open(bytes), 422, what);
    }
    site.still_compiles();
}

/// Damage with right checksums, so that the checks behind them are reached, and whatever passes them is shown.
#[test]
fn sealed_damage_is_refused_or_shown_and_never_a_bug() {
    let site = &*SHARED;
    let good = asset();
    let mut draw = Draw::new(42);
    let mut shown = 0;
    for case in 0..60 {
        let mut bytes = good.clone();
        for _ in 0..=draw.below(3) {
            let at = draw.below(bytes.len());
            bytes[at] = draw.below(256) as u8;
        }
        seal(&mut bytes);
        let reply = site.post("api/open", &bytes);
        if reply.status != 200 {
            refused(&reply, 422, &format!("case {case}"));
            continue;
        }
        shown += 1;
        let id = reply.json()["texture"]["id"]
            .as_str()
            .expect("a name")
            .to_owned();
        // Sheets and strokes take a while.
        let slow = if shown < 3 {
            &["plot.png", "export.csv"][..]
        } else {
            &[]
        };
        let usual = ["json", "worklet.asp", "png", "normal.png"];
        for ending in usual.iter().chain(slow) {
            let file = site.get(&format!("api/texture/{id}.{ending}"));
            if file.status != 200 {
                refused(&file, 422, &format!("case {case}, {ending}"));
            }
        }
    }
    assert!(shown > 5, "{shown} cases were shown, which tests little");
    site.still_compiles();
}

/// Files of other tools, cut and changed anywhere.
#[test]
fn damaged_files_of_other_tools_are_refused_or_shown_and_never_a_bug() {
    let site = &*SHARED;
    let bytes = asset();
    let parsed = Asset::parse(&bytes).expect("an asset");
    let clip = |format: ClipFormat| {
        let exported = interchange::export(&parsed, format, &Options::default());
        exported.expect("a file").bytes
    };
    let deep = "[".repeat(100_000);
    let open = |name: &str, bytes: &[u8]| {
        let reply = site.post(&format!("api/open?name={name}"), bytes);
        if reply.status != 200 {
            let json = refused(&reply, 422, name);
            assert!(json["error"].to_string().contains(name), "{name}: {json}");
        }
    };
    let mut draw = Draw::new(7);
    for (name, good) in [
        ("x.haptic", clip(ClipFormat::Haptic)),
        ("x.ahap", clip(ClipFormat::Ahap)),
        ("x.hjif", clip(ClipFormat::Hjif)),
    ] {
        for _ in 0..8 {
            let mut bytes = good[..=draw.below(good.len())].to_vec();
            let at = draw.below(bytes.len());
            bytes[at] = draw.below(256) as u8;
            open(name, &bytes);
            let mut bytes = good.clone();
            let at = draw.below(bytes.len());
            bytes[at] = b'9';
            open(name, &bytes);
        }
        open(name, deep.as_bytes());
    }
    for (name, text) in [
        ("x.xml", "<modelSet>".repeat(10_000)),
        (
            "x.xml",
            "<!DOCTYPE modelSet [<!ENTITY a \"&a;&a;\">]><modelSet>&a;</modelSet>".into(),
        ),
        (
            "x.json",
            format!("{{\"format\":\"asperity-model\",\"version\":1,\"x\":{deep}"),
        ),
        (
            "x.json",
            "{\"format\":\"asperity-model\",\"version\":1e999}".into(),
        ),
        (
            "x.ahap",
            "{\"Pattern\":[{\"Event\":{\"Time\":1e300}}]}".into(),
        ),
    ] {
        open(name, text.as_bytes());
    }
    site.still_compiles();
}

#[test]
fn a_picture_that_is_none_is_drawn_anew() {
    let site = &*SHARED;
    let texture = builtin::texture();
    let bomb = [b"\x89PNG\r\n\x1a\n", &[0xff; 64][..]].concat();
    for stored in [Some(&bomb[..]), None] {
        let bytes = lower(&texture, stored).expect("an asset").bytes;
        let json = site.post("api/open", &bytes).json()["texture"].clone();
        let id = json["id"].as_str().expect("a name");
        let png = site.get(&format!("api/texture/{id}.png"));
        assert_eq!(preview::width(&png.body), Some(preview::SIZE));
        assert_eq!(json["preview"]["pixels"], preview::SIZE);
    }
}

#[test]
fn markup_stays_text_in_json() {
    let site = &*SHARED;
    let markup = "</script><script>alert(1)</script> \u{2028}\"'&";
    let body = json!({ "prompt": markup }).to_string();
    let reply = site.post("api/compile", body.as_bytes());
    assert_eq!(reply.status, 200, "{reply:?}");
    assert_eq!(reply.header("x-content-type-options"), Some("nosniff"));
    assert_eq!(reply.json()["inspect"]["prompt"], markup);
    let name = "<img src=x onerror=alert(1)>";
    let bytes = renamed(&asset(), name).expect("a name");
    let reply = site.post("api/open", &bytes);
    assert_eq!(reply.json()["texture"]["name"], name);
    // The name of a file comes back in an error.
    let reply = site.post(
        "api/open?name=%3Cimg%20src%3Dx%3E%0D%0ASet-Cookie:%20a=b",
        b"x",
    );
    let json = refused(&reply, 422, "a name with a line break");
    assert!(json["error"].to_string().contains("<img src=x>"), "{json}");
    assert_eq!(reply.header("set-cookie"), None);
    assert_eq!(reply.header("content-type"), Some("application/json"));
}

#[test]
fn prompts_that_are_none_are_refused_and_long_ones_are_read() {
    let site: &Site = &SHARED;
    let compile = |body: &[u8]| site.post("api/compile", body);
    let deep = "[".repeat(60_000);
    for (what, body) in [
        ("invalid UTF-8", &b"{\"prompt\": \"\xff\xfe\"}"[..]),
        ("half a surrogate", br#"{"prompt": "\ud800"}"#),
        ("no JSON", b"prompt=cork"),
        ("nothing", b""),
        ("no prompt", b"{}"),
        ("a number", br#"{"prompt": 7}"#),
        ("a list", br#"{"prompt": ["cork"]}"#),
        ("a negative seed", br#"{"prompt": "cork", "seed": -1}"#),
        ("a broken seed", br#"{"prompt": "cork", "seed": 0.5}"#),
        (
            "another field",
            br#"{"prompt": "cork", "output": "/etc/passwd"}"#,
        ),
        ("two prompts", br#"{"prompt": "cork", "prompt": "felt"}"#),
        ("deep lists", deep.as_bytes()),
        ("an empty prompt", br#"{"prompt": " \u200b"}"#),
    ] {
        refused(&compile(body), 400, what);
    }
    let empty = refused(&compile(br#"{"prompt": ""}"#), 400, "an empty prompt");
    assert_eq!(empty["error"], "the prompt is empty");
    for (what, prompt) in [
        ("one word of 60,000 letters", "a".repeat(60_000)),
        ("15,000 words", "wet,".repeat(15_000)),
        ("15,000 emoji", "🔥".repeat(15_000)),
        ("a text that no command line holds", "wet\0ice".to_owned()),
    ] {
        let reply = compile(json!({ "prompt": prompt }).to_string().as_bytes());
        assert_eq!(
            reply.status,
            200,
            "{what}: {}",
            String::from_utf8_lossy(&reply.body)
        );
        let command = &reply.json()["command"];
        assert_eq!(command.is_null(), prompt.contains('\0'), "{what}");
    }
    site.still_compiles();
}

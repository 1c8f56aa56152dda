//! Mixtures that are refused: requests that are wrong, and a server without prompts.

use crate::{
    client::{SHARED, Site},
    mixing::{compiled, post, prompted},
};
use asperity_studio::{Limits, Studio};
use serde_json::{Value, json};

#[test]
fn requests_that_are_wrong_are_refused_with_their_field() {
    let id = prompted("cork")["id"].clone();
    let gone = "0123456789abcdef0123456789abcdef";
    for (path, body, status, named) in [
        (
            "api/edit",
            json!({ "texture": gone, "words": "softer" }),
            404,
            "does not have",
        ),
        (
            "api/edit",
            json!({ "texture": id }),
            400,
            "neither steps nor words",
        ),
        ("api/edit", json!({ "words": "softer" }), 400, "texture"),
        (
            "api/edit",
            json!({ "texture": id, "words": "softer", "steps": {} }),
            400,
            "both",
        ),
        (
            "api/edit",
            json!({ "texture": id, "steps": {} }),
            400,
            "no edit is given",
        ),
        (
            "api/edit",
            json!({ "texture": id, "steps": { "rougher": 0 } }),
            400,
            "no edit",
        ),
        (
            "api/edit",
            json!({ "texture": id, "steps": { "rougher": 101 } }),
            400,
            "steps.rougher",
        ),
        (
            "api/edit",
            json!({ "texture": id, "steps": { "softer": 1 } }),
            400,
            "softer",
        ),
        (
            "api/edit",
            json!({ "texture": id, "steps": { "harder": null } }),
            400,
            "null",
        ),
        (
            "api/edit",
            json!({ "texture": id, "words": "" }),
            400,
            "names neither",
        ),
        (
            "api/edit",
            json!({ "texture": id, "words": "zzz" }),
            400,
            "names neither",
        ),
        (
            "api/edit",
            json!({ "texture": 7, "words": "softer" }),
            400,
            "integer",
        ),
        ("api/blend", json!({ "a": id, "b": id }), 400, "`t`"),
        (
            "api/blend",
            json!({ "a": id, "b": id, "t": 1.01 }),
            400,
            "t is 1.01",
        ),
        (
            "api/blend",
            json!({ "a": id, "b": id, "t": -0.1 }),
            400,
            "t is -0.1",
        ),
        (
            "api/blend",
            json!({ "a": id, "b": gone, "t": 0.5 }),
            404,
            "does not have",
        ),
        (
            "api/compose",
            json!({ "tap": id, "slide": id }),
            400,
            "friction",
        ),
        (
            "api/compose",
            json!({ "tap": "../x", "slide": id, "friction": id }),
            404,
            "does not",
        ),
        ("api/encode", json!({}), 400, "texture"),
        (
            "api/encode",
            json!({ "texture": id, "part": "taps" }),
            400,
            "part",
        ),
    ] {
        let reply = post(&SHARED, path, &body);
        assert_eq!(reply.status, status, "{path} {body}: {reply:?}");
        let json = reply.json();
        assert!(json["error"].to_string().contains(named), "{body}: {json}");
        assert!(json["help"].is_string(), "{body}: {json}");
    }
    // Numbers that JSON does not know.
    for number in ["NaN", "1e999", "Infinity", "-1e999"] {
        let steps = format!(r#"{{"texture": {id}, "steps": {{"rougher": {number}}}}}"#);
        let share = format!(r#"{{"a": {id}, "b": {id}, "t": {number}}}"#);
        for (path, body) in [("api/edit", steps), ("api/blend", share)] {
            assert_eq!(SHARED.post(path, body.as_bytes()).status, 400, "{body}");
        }
    }
}

#[test]
fn a_server_without_prompts_shows_textures_and_makes_none() {
    let site = Site::of(Studio::new(None, None), Limits::default());
    let about = site.get("api/about.json").json();
    assert_eq!(
        (&about["prompts"], &about["sliders"]),
        (&json!(false), &json!([]))
    );
    let opened = site.post("api/open", &compiled("cork"));
    assert_eq!(opened.status, 200);
    let opened = opened.json()["texture"].clone();
    assert_eq!(
        (&opened["editable"], &opened["places"]["rough"]),
        (&json!(false), &Value::Null)
    );
    let id = &opened["id"];
    for (path, body) in [
        ("api/compile", json!({ "prompt": "cork" })),
        ("api/edit", json!({ "texture": id, "words": "softer" })),
        ("api/blend", json!({ "a": id, "b": id, "t": 0.5 })),
        (
            "api/compose",
            json!({ "tap": id, "slide": id, "friction": id }),
        ),
        ("api/encode", json!({ "texture": id })),
    ] {
        let reply = post(&site, path, &body);
        assert_eq!(reply.status, 422, "{path}");
        let help = reply.json()["help"].to_string();
        assert!(help.contains("asperity studio"), "{help}");
    }
    site.stopper.stop();
    site.thread.join().expect("it ends");
}

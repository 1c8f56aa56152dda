//! Who asks within the program gets what the server answers.

use crate::client::{SHARED, embedded};
use asperity_studio::{Reply, Studio};
use serde_json::{Value, json};

fn json_of(reply: &Reply) -> Value {
    assert_eq!(reply.content_type, "application/json");
    serde_json::from_slice(&reply.bytes).expect("JSON")
}

#[test]
fn a_request_within_the_program_has_the_answer_of_the_server() {
    let studio = Studio::new(None, Some(embedded));
    assert_eq!(
        json_of(&studio.reply("api/about.json", None)),
        SHARED.get("api/about.json").json()
    );
    let prompt = br#"{"prompt": "cork"}"#;
    let reply = studio.reply("api/compile", Some(prompt.to_vec()));
    assert_eq!(reply.status, 200);
    let texture = json_of(&reply);
    let served = SHARED.post("api/compile", prompt).json();
    for field in ["id", "name", "command", "places", "inspect"] {
        assert_eq!(texture[field], served[field], "{field}");
    }
    let id = texture["id"].as_str().expect("a name");
    let mut asset = Vec::new();
    for ending in ["asp", "worklet.asp", "normal.png", "export.ahap"] {
        let file = format!("api/texture/{id}.{ending}");
        let (own, served) = (studio.reply(&file, None), SHARED.get(&file));
        assert_eq!(
            (own.status, Some(own.content_type)),
            (200, served.header("content-type"))
        );
        assert!(own.bytes == served.body, "{file}");
        if ending == "asp" {
            asset = own.bytes;
        }
    }
    let opened = studio.reply("api/open?name=wet%20cork.asp", Some(asset));
    assert_eq!(json_of(&opened)["texture"]["id"], json!(id));
    for (target, body) in [
        ("api/compile", Some(&b"{}"[..])),
        ("api/compile", None),
        (
            "api/edit",
            Some(br#"{"texture": "none", "words": "softer"}"#),
        ),
        ("none", None),
    ] {
        let own = studio.reply(target, body.map(<[u8]>::to_vec));
        let served = match body {
            Some(body) => SHARED.post(target, body),
            None => SHARED.get(target),
        };
        assert_ne!(own.status, 200, "{target}");
        assert_eq!(
            (own.status, json_of(&own)),
            (served.status, served.json()),
            "{target}"
        );
    }
}

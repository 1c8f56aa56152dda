//! Lists of prompts that are dropped on the page.

use crate::client::SHARED;
use asperity::{
    learned::inference::Backend,
    library::{Build, Manifest, Request},
    sources::prompt::PromptCompiler,
};
use asperity_formats::library::Library;
use asperity_io::diagnostic::alone;
use serde_json::json;
use std::path::Path;

#[test]
fn a_list_of_prompts_becomes_the_library_that_asperity_build_writes() {
    let list = "name,prompt\nfloor,wet ice\nhall,xqzt\nwall,cork\n";
    let manifest = Manifest::of_text(Path::new("prompts.csv"), list).unwrap();
    let request = Request::default();
    let open = || PromptCompiler::embedded(&Backend::Portable).map_err(|e| alone(e.into()));
    let built = Build::new(&manifest, &request).unwrap();
    let mut library = Vec::new();
    let built = built.run(&open, &|| {}).unwrap();
    built.library.write(&mut library).unwrap();
    let wanted = Library::parse(&library).unwrap();

    let reply = SHARED.post("api/open?name=prompts.csv", list.as_bytes());
    let described = reply.json()["library"].clone();
    assert_eq!(described["textures"], 3, "{reply:?}");
    let id = described["id"].as_str().unwrap();
    let columns = SHARED.get(&format!("api/library/{id}.json")).json();
    assert_eq!(columns["certainty"], json!(["known", "guess", "known"]));
    let wall = SHARED.get(&format!("api/library/{id}/2.json")).json();
    let bytes = SHARED.get(&format!("api/texture/{}.asp", wall["id"].as_str().unwrap()));
    assert!(bytes.body == wanted.bytes(2).unwrap());
    let commands = "asperity build prompts.csv -o prompts.aspl\nasperity extract prompts.aspl wall -o wall.asp";
    assert_eq!(wall["command"], commands);
    assert_eq!(
        SHARED.get("api/batch.json").json(),
        json!({ "done": 0, "total": 0 })
    );
}

#[test]
fn a_list_that_is_dropped_reads_no_file_of_this_machine() {
    for (name, list, said) in [
        ("a.csv", "name,asset\nx,/etc/passwd\n", "absolute path"),
        ("a.csv", "name,asset\nx,Cargo.toml\n", "a.csv:2"),
        ("a.toml", "include = [\"../Cargo.toml\"]\n", "a.toml:1"),
        (
            "a.toml",
            "model = \"/tmp\"\n[[texture]]\nprompt = \"cork\"\n",
            "a.toml",
        ),
        ("a.csv", "name,prompt\nx,\ny,\n", "a.csv:2"),
        ("a.csv", "", "a.csv"),
        ("a.jsonl", "\u{feff}{", "a.jsonl"),
    ] {
        let reply = SHARED.post(&format!("api/open?name={name}"), list.as_bytes());
        let error = reply.json()["error"].to_string();
        assert!(
            reply.status == 422 && error.contains(said),
            "{list}: {reply:?}"
        );
    }
    let reply = SHARED.post("api/open?name=a.csv", b"name,prompt\nx,\xff\n");
    assert!(
        reply.json()["error"].to_string().contains("not UTF-8"),
        "{reply:?}"
    );
}

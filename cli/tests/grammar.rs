//! Shifts from a prompt's grammar persist through every operation on the texture.

use super::*;
use asperity_formats::Asset;
use serde_json::Value;

fn made(folder: &Path, arguments: &[&str]) -> Value {
    let output = asperity(folder, &[arguments, &["--json"]].concat());
    let error = text(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {error}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// Returns the haptic sections, except the name.
fn felt(folder: &Path, file: &str) -> Vec<([u8; 4], Vec<u8>)> {
    let bytes = bytes(folder, file);
    let asset = Asset::parse(&bytes).expect("an asset");
    let haptic = asset
        .sections()
        .filter(|section| section.is_haptic() && section.tag != *b"NAME");
    haptic
        .map(|section| (section.tag, asset.section(&section).expect("it").to_vec()))
        .collect()
}

/// Textures whose prompts have a grammar, and one without.
fn textures() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (prompt, file) in [
        ("very hard velvet", "velvet.asp"),
        ("rougher than paper and grippy", "paper.asp"),
        ("felt", "felt.asp"),
    ] {
        made(
            folder.path(),
            &["compile", prompt, "--no-preview", "-o", file],
        );
    }
    folder
}

#[test]
fn a_blend_at_its_ends_is_what_it_is_blended_of() {
    let textures = textures();
    let folder = textures.path();
    for (t, end) in [("0", "velvet.asp"), ("1", "paper.asp")] {
        let blend = ["blend", "velvet.asp", "paper.asp", "-t", t];
        made(
            folder,
            &[&blend[..], &["--no-preview", "-o", "end.asp"]].concat(),
        );
        assert!(felt(folder, "end.asp") == felt(folder, end), "t = {t}");
        // And once more, from what the blend itself remembers.
        let again = ["blend", "end.asp", "felt.asp", "-t", "0"];
        made(
            folder,
            &[&again[..], &["--no-preview", "-o", "again.asp"]].concat(),
        );
        assert!(felt(folder, "again.asp") == felt(folder, end), "t = {t}");
    }
    let hard = |file: &str| {
        let hard = made(folder, &["inspect", file])["attributes"]["hard_hz"].as_f64();
        hard.expect("a number")
    };
    let half = ["blend", "velvet.asp", "felt.asp", "--no-preview"];
    made(folder, &[&half[..], &["-o", "half.asp"]].concat());
    assert!(hard("felt.asp") < hard("half.asp") && hard("half.asp") < hard("velvet.asp"));
}

#[test]
fn a_composition_takes_each_move_with_its_part() {
    let textures = textures();
    let folder = textures.path();
    let compose = ["compose", "--tap", "velvet.asp", "--slide", "paper.asp"];
    made(
        folder,
        &[&compose[..], &["--no-preview", "-o", "mixed.asp"]].concat(),
    );
    let inspect = |file: &str| made(folder, &["inspect", file]);
    let mixed = inspect("mixed.asp");
    assert_eq!(mixed["taps"], inspect("velvet.asp")["taps"]);
    assert_eq!(mixed["ar"], inspect("paper.asp")["ar"]);
    assert_eq!(mixed["friction"], inspect("paper.asp")["friction"]);
}

#[test]
fn an_edit_starts_from_what_the_prompt_said_and_is_taken_back_to_the_byte() {
    let textures = textures();
    let folder = textures.path();
    let hard = |file: &str| {
        let hard = made(folder, &["inspect", file])["attributes"]["hard_hz"].as_f64();
        hard.expect("a number")
    };
    made(
        folder,
        &["edit", "velvet.asp", "--rougher", "10", "-o", "edited.asp"],
    );
    // The edit of roughness leaves the taps as the prompt had them.
    assert_eq!(hard("edited.asp"), hard("velvet.asp"));
    let json = made(
        folder,
        &[
            "edit",
            "edited.asp",
            "--prompt",
            "less gritty, more waxy",
            "-o",
            "waxy.asp",
        ],
    );
    let moved = |axis: &str| json["moved"][axis].as_f64().expect("a number");
    assert!(moved("rough") < -5.0 && moved("slippery") > 5.0, "{json}");
    assert!(moved("hard").abs() < 1.0, "{json}");
    made(folder, &["edit", "waxy.asp", "--undo", "-o", "one.asp"]);
    assert!(bytes(folder, "one.asp") == bytes(folder, "edited.asp"));
    made(folder, &["edit", "one.asp", "--undo", "-o", "none.asp"]);
    assert!(bytes(folder, "none.asp") == bytes(folder, "velvet.asp"));
}

#[test]
fn an_edit_keeps_the_size_of_the_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let compile = ["compile", "cork", "--preview-size", "96", "-o", "cork.asp"];
    made(folder, &compile);
    made(
        folder,
        &["edit", "cork.asp", "--harder", "5", "-o", "hard.asp"],
    );
    made(folder, &["edit", "hard.asp", "--undo", "-o", "back.asp"]);
    assert!(bytes(folder, "back.asp") == bytes(folder, "cork.asp"));
}

#[test]
fn words_that_say_nothing_are_refused_and_some_are_named() {
    let textures = textures();
    let folder = textures.path();
    for wrong in [
        &["--prompt", "make it more purple"][..],
        &["--prompt", ""],
        &["--prompt", "softer", "--rougher", "5"],
        &["--prompt", "softer", "--undo"],
    ] {
        let edit = ["edit", "felt.asp", "-o", "x.asp"];
        let output = asperity(folder, &[&edit[..], wrong].concat());
        assert_eq!(output.status.code(), Some(2), "{wrong:?}");
        assert!(!folder.join("x.asp").exists());
    }
    let json = made(
        folder,
        &[
            "edit",
            "felt.asp",
            "--prompt",
            "firmer, purple",
            "-o",
            "x.asp",
        ],
    );
    assert!(
        json["warnings"]
            .to_string()
            .contains("not understood: purple")
    );
}

//! Blends, compositions and edits as a user makes them: reproducible, told in figures, taken back.

use super::*;
use serde_json::Value;

fn made(folder: &Path, arguments: &[&str]) -> Value {
    let output = asperity(folder, &[arguments, &["--json"]].concat());
    let error = text(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {error}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// Two textures of prompts.
fn textures() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (prompt, file) in [("sandpaper", "sheet.asp"), ("felt", "felt.asp")] {
        made(
            folder.path(),
            &["compile", prompt, "--no-preview", "-o", file],
        );
    }
    folder
}

#[test]
fn an_edit_moves_what_was_asked_is_reproducible_and_is_taken_back_to_the_byte() {
    let textures = textures();
    let folder = textures.path();
    let edit = [
        "edit",
        "sheet.asp",
        "--rougher",
        "-20",
        "--harder",
        "10",
        "--slipperier",
        "5",
    ];
    let json = made(folder, &[&edit[..], &["-o", "edited.asp"]].concat());
    for (axis, asked) in [
        ("rough", -20.0),
        ("sharp", 0.0),
        ("hard", 10.0),
        ("slippery", 5.0),
    ] {
        let moved = json["moved"][axis].as_f64().expect("a number");
        assert!((moved - asked).abs() < 3.0, "{axis}: {moved} of {asked}");
    }
    made(folder, &[&edit[..], &["-o", "again.asp"]].concat());
    assert!(bytes(folder, "again.asp") == bytes(folder, "edited.asp"));
    let second = ["edit", "edited.asp", "--sharper", "10", "-o", "twice.asp"];
    made(folder, &second);
    made(folder, &["edit", "twice.asp", "--undo", "-o", "once.asp"]);
    assert!(bytes(folder, "once.asp") == bytes(folder, "edited.asp"));
    made(folder, &["edit", "once.asp", "--undo", "-o", "none.asp"]);
    assert!(bytes(folder, "none.asp") == bytes(folder, "sheet.asp"));
    refused(
        folder,
        &["edit", "none.asp", "--undo", "-o", "x.asp"],
        &["no edit to undo"],
    );
    let nothing = asperity(folder, &["edit", "none.asp", "-o", "x.asp"]);
    assert_eq!(nothing.status.code(), Some(2));
}

#[test]
fn a_composition_taps_like_one_and_slides_like_the_other() {
    let textures = textures();
    let folder = textures.path();
    let inspect = |file: &str| made(folder, &["inspect", file]);
    let compose = [
        "compose",
        "--tap",
        "sheet.asp",
        "--slide",
        "felt.asp",
        "--no-preview",
    ];
    made(folder, &[&compose[..], &["-o", "mixed.asp"]].concat());
    let (sheet, felt, mixed) = (
        inspect("sheet.asp"),
        inspect("felt.asp"),
        inspect("mixed.asp"),
    );
    assert_eq!(mixed["taps"], sheet["taps"]);
    assert_eq!(mixed["wall"], sheet["wall"]);
    assert_eq!(mixed["ar"], felt["ar"]);
    assert_eq!(mixed["friction"], felt["friction"]);
    let slippery = [
        &compose[..],
        &["--friction", "sheet.asp", "-o", "third.asp"],
    ]
    .concat();
    made(folder, &slippery);
    assert_eq!(inspect("third.asp")["friction"], sheet["friction"]);
}

#[test]
fn a_blend_lies_between_and_is_its_ends_at_the_ends() {
    let textures = textures();
    let folder = textures.path();
    let mu = |file: &str| made(folder, &["inspect", file])["friction"]["mu"].as_f64();
    let blend = |t: &str, file: &str| {
        let arguments = [
            "blend",
            "sheet.asp",
            "felt.asp",
            "-t",
            t,
            "--no-preview",
            "-o",
            file,
        ];
        made(folder, &arguments);
    };
    blend("0", "zero.asp");
    blend("1", "one.asp");
    blend("0.5", "half.asp");
    assert_eq!(mu("zero.asp"), mu("sheet.asp"));
    assert_eq!(mu("one.asp"), mu("felt.asp"));
    let rough = |file: &str| made(folder, &["inspect", file])["attributes"]["rough_db"].as_f64();
    let (low, middle, high) = (rough("felt.asp"), rough("half.asp"), rough("sheet.asp"));
    assert!(low < middle && middle < high, "{low:?} {middle:?} {high:?}");
    let wrong = asperity(
        folder,
        &["blend", "sheet.asp", "felt.asp", "-t", "2", "-o", "x.asp"],
    );
    assert_eq!(wrong.status.code(), Some(2));
}

/// A place inside the grid that was recorded as silent; the model has none.
#[test]
fn a_silent_place_has_no_distance_and_is_counted() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/data/corduroy.json");
    let model = fs::read_to_string(model).expect("the example of the documentation");
    let silent = model.replace("\"sigma_m_s2\": 0.15", "\"sigma_m_s2\": 0");
    assert!(silent != model);
    fs::write(folder.join("c.json"), silent).expect("a model");
    let import = ["import", "model", "c.json", "--no-preview", "-o", "c.asp"];
    let imported = asperity(folder, &import);
    assert!(imported.status.success(), "{}", text(&imported.stderr));
    let encode = ["encode", "c.asp", "--no-preview", "-o", "e.asp"];
    let json = made(folder, &encode);
    assert!(
        json["silent_places"]
            .as_u64()
            .is_some_and(|places| places > 0),
        "{json:#}"
    );
    let db = |n: usize| json["distance_db"][n].as_f64().expect("a distance");
    assert!(0.0 < db(0) && db(0) <= db(1) && db(1) < 200.0, "{json:#}");
    let told = text(&asperity(folder, &encode).stdout);
    assert!(
        told.contains("only one of the two sounds") && !told.contains("inf"),
        "{told}"
    );
}

#[test]
fn a_recording_has_no_latent_until_it_is_encoded() {
    let inputs = inputs();
    let folder = inputs.path();
    let edit = ["edit", "good.asp", "--rougher", "5", "-o", "x.asp"];
    refused(folder, &edit, &["has no latent", "asperity encode"]);
    let json = made(
        folder,
        &[
            "encode",
            "good.asp",
            "--part",
            "whole",
            "--no-preview",
            "-o",
            "e.asp",
        ],
    );
    assert_eq!(json["z"].as_array().map(Vec::len), Some(64));
    assert!(json["distance_db"][0].as_f64().is_some());
    made(
        folder,
        &["edit", "e.asp", "--rougher", "5", "-o", "edited.asp"],
    );
    made(
        folder,
        &[
            "encode",
            "good.asp",
            "--part",
            "taps",
            "--no-preview",
            "-o",
            "t.asp",
        ],
    );
    let wrong = asperity(
        folder,
        &["encode", "good.asp", "--part", "smell", "-o", "x.asp"],
    );
    assert_eq!(wrong.status.code(), Some(2));
}

#[test]
fn a_latent_of_another_model_is_refused() {
    let textures = textures();
    let folder = textures.path();
    fs::create_dir(folder.join("model")).expect("a folder");
    write_model(&folder.join("model"));
    let description = folder.join("model/model.json");
    let other = fs::read_to_string(&description).expect("it") + "\n";
    fs::write(&description, other).expect("it");
    let edit = [
        "edit",
        "sheet.asp",
        "--model",
        "model",
        "--rougher",
        "5",
        "-o",
        "x.asp",
    ];
    refused(folder, &edit, &["was decoded with model", "--model"]);
}

#[test]
fn words_are_told_by_what_they_moved() {
    let folder = tempfile::tempdir().expect("a folder");
    let compile = [
        "compile",
        "rough abrasive sheet",
        "--no-preview",
        "-o",
        "a.asp",
        "--explain",
    ];
    let json = made(folder.path(), &compile);
    let words = json["words"].as_array().expect("words");
    let named: Vec<&str> = words.iter().filter_map(|w| w["word"].as_str()).collect();
    assert_eq!(named, ["rough", "abrasive", "sheet"]);
    let rough = |n: usize| words[n]["rough"].as_f64().expect("a number");
    assert!(rough(1) > 0.0, "{words:?}");
    let mut asked = compile;
    asked[1] = "my very rough oak table, P80";
    let json = made(folder.path(), &asked);
    let roles = json["reading"].as_array().expect("a reading").iter();
    let roles: Vec<(&str, &str)> = roles
        .map(|taken| {
            (
                taken["text"].as_str().unwrap(),
                taken["role"].as_str().unwrap(),
            )
        })
        .collect();
    let expected = [
        ("P80", "number"),
        ("very", "degree"),
        ("rough", "quality"),
        ("oak", "name"),
        ("table", "name"),
    ];
    assert_eq!(roles, expected);
    assert!(
        json["phrase"]
            .as_str()
            .unwrap()
            .starts_with("P80 oak table, rough +"),
        "{json}"
    );
    let output = asperity(folder.path(), &compile);
    assert!(text(&output.stdout).contains("abrasive"));
}

//! `--json` reports of every command, and options with two spellings.

use super::*;
use serde_json::Value;

/// A folder with a texture, a library of two and a trajectory.
fn workshop() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    fs::write(at.join("stroke.csv"), stroke()).expect("a trajectory");
    fs::write(at.join("names.csv"), "name,prompt\nfelt,felt\ncork,cork\n").expect("a manifest");
    good(
        at,
        &["compile", "felt", "-o", "felt.asp", "--preview-size", "64"],
    );
    good(
        at,
        &[
            "build",
            "names.csv",
            "--no-preview",
            "--no-cache",
            "-o",
            "names.aspl",
        ],
    );
    folder
}

#[test]
fn every_command_that_writes_reports_as_json_what_it_wrote() {
    let workshop = workshop();
    let folder = workshop.path();
    for (command, output, key) in [
        ("builtin -o grit.asp", "grit.asp", "bytes"),
        ("plot felt.asp -o sheet.png", "sheet.png", "bytes"),
        ("preview felt.asp -o felt.png", "felt.png", "width_px"),
        (
            "preview felt.asp -o drawn.png --size 128",
            "drawn.png",
            "height_px",
        ),
        ("listen felt.asp -o felt.wav", "felt.wav", "strokes"),
        (
            "render felt.asp --trajectory stroke.csv -o felt.csv",
            "felt.csv",
            "contact_ticks",
        ),
        ("split names.aspl -o parts", "parts", "files"),
        (
            "export felt.asp --to wav -o stroke.wav",
            "stroke.wav",
            "parts",
        ),
    ] {
        let arguments: Vec<&str> = command.split(' ').chain(["--json", "-q"]).collect();
        let printed = good(folder, &arguments);
        let json: Value =
            serde_json::from_str(&printed).unwrap_or_else(|e| panic!("{command}: {e}"));
        assert!(!json[key].is_null(), "{command}: {json:#}");
        if json["output"].is_string() {
            assert_eq!(json["output"], output, "{command}");
        }
        assert!(folder.join(output).exists(), "{command}");
        // With the file on standard output, the report goes to standard error, and nothing else does.
        let piped: Vec<&str> = arguments
            .iter()
            .map(|a| if *a == output { "-" } else { a })
            .collect();
        if output == "parts" {
            continue;
        }
        let piped = asperity(folder, &piped);
        assert!(piped.stdout == bytes(folder, output), "{command}");
        assert!(
            serde_json::from_slice::<Value>(&piped.stderr).is_ok(),
            "{command}"
        );
    }
}

#[test]
fn the_figures_in_json_are_those_of_the_files() {
    let workshop = workshop();
    let folder = workshop.path();
    let json = |command: &str| -> Value {
        let arguments: Vec<&str> = command.split(' ').chain(["--json"]).collect();
        serde_json::from_str(&good(folder, &arguments)).expect(command)
    };
    let rendered = json("render felt.asp --trajectory stroke.csv -o felt.csv");
    let rows = String::from_utf8(bytes(folder, "felt.csv")).expect("text");
    assert_eq!(rendered["ticks"], rows.lines().count() - 1);
    let preview = json("preview felt.asp -o felt.png");
    assert_eq!(
        (&preview["width_px"], &preview["height_px"]),
        (&64.into(), &64.into())
    );
    assert_eq!(preview["bytes"], bytes(folder, "felt.png").len());
    let plot = json("plot felt.asp -o sheet.png");
    assert_eq!(plot["bytes"], bytes(folder, "sheet.png").len());
    let heard = json("listen felt.asp -o felt.wav");
    // 16 bits a sample after a header of 44 bytes.
    let samples =
        heard["seconds"].as_f64().expect("s") * heard["sample_rate_hz"].as_f64().expect("Hz");
    assert_eq!(
        44 + 2 * samples.round() as usize,
        bytes(folder, "felt.wav").len()
    );
    assert_eq!(
        (&heard["strokes"]["count"], &heard["taps"]["count"]),
        (&6.into(), &3.into())
    );
    let split = json("split names.aspl -o parts");
    let files: Vec<&str> = split["files"]
        .as_array()
        .expect("files")
        .iter()
        .filter_map(|f| f["file"].as_str())
        .collect();
    assert_eq!(files, ["cork.asp", "felt.asp"]);
    assert_eq!(entries(&folder.join("parts")), files);
}

#[test]
fn opposite_sliders_are_one_slider() {
    let workshop = workshop();
    let folder = workshop.path();
    for (up, down) in [
        ("--rougher", "--smoother"),
        ("--sharper", "--duller"),
        ("--harder", "--softer"),
        ("--slipperier", "--stickier"),
    ] {
        good(folder, &["edit", "felt.asp", up, "-7", "-o", "up.asp"]);
        good(folder, &["edit", "felt.asp", down, "7", "-o", "down.asp"]);
        assert!(
            bytes(folder, "up.asp") == bytes(folder, "down.asp"),
            "{down}"
        );
        assert!(
            bytes(folder, "up.asp") != bytes(folder, "felt.asp"),
            "{down}"
        );
        let both = asperity(
            folder,
            &["edit", "felt.asp", up, "1", down, "1", "-o", "x.asp"],
        );
        assert_eq!(both.status.code(), Some(2));
        let words = asperity(
            folder,
            &["edit", "felt.asp", down, "1", "--undo", "-o", "x.asp"],
        );
        assert_eq!(words.status.code(), Some(2));
    }
}

#[test]
fn a_compiled_texture_has_the_name_that_was_given() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    let compile = ["compile", "rough cork", "--no-preview", "-o"];
    good(at, &[&compile[..], &["plain.asp"]].concat());
    good(
        at,
        &[&compile[..], &["named.asp", "--name", "Käse"]].concat(),
    );
    good(
        at,
        &[
            "rename",
            "plain.asp",
            "rough cork",
            "Käse",
            "-o",
            "renamed.asp",
        ],
    );
    assert!(bytes(at, "named.asp") == bytes(at, "renamed.asp"));
    for command in [
        "compile cork",
        "blend named.asp plain.asp",
        "edit plain.asp --rougher 3",
    ] {
        for wrong in ["", "a\u{7}b", &"ä".repeat(33)] {
            let arguments: Vec<&str> = command
                .split(' ')
                .chain(["-o", "x.asp", "--name", wrong])
                .collect();
            let output = asperity(at, &arguments);
            assert_eq!(output.status.code(), Some(2), "{command} {wrong:?}");
            assert!(
                text(&output.stderr).contains("--name"),
                "{command} {wrong:?}"
            );
        }
    }
}

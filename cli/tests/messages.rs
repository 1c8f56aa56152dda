//! Messages and exit statuses for hostile input and unreadable prompts.

use super::*;
use serde_json::Value;

/// A scene with the built-in asset, of which one line is replaced.
fn scene(line: &str) -> String {
    format!(
        "{line}\n[[texture]]\nname = \"a\"\nasset = \"good.asp\"\n[[surface]]\ntexture = \"a\"\n\
         plane = {{ point_m = [0, 0, 0], normal = [0, 0, 1] }}\n"
    )
}

#[test]
fn what_a_file_says_is_repeated_without_escapes_and_in_short() {
    let inputs = inputs();
    let folder = inputs.path();
    let escapes = "servo_rate_hz = \"\u{9b}31m\u{202e}red\u{2066}\"";
    let long = format!("servo_rate_hz = \"{}\"", "x".repeat(1_000_000));
    let unknown = format!("{} = 1", "k".repeat(1_000_000));
    let name = format!(
        "[[texture]]\nname = \"{}\\u001b[31m\"\nprompt = \"x\"",
        "n".repeat(99_000)
    );
    for (line, says) in [
        (escapes, "line 1, column 17"),
        (&long, "line 1, column 17"),
        (&unknown, "servo_rate_hz"),
        (&name, "is not a valid name"),
    ] {
        fs::write(folder.join("hostile.toml"), scene(line)).expect("a scene");
        let arguments = ["build", "hostile.toml", "-o", "out.aspl"];
        refused(folder, &arguments, &["hostile.toml", says]);
        let error = text(&asperity(folder, &arguments).stderr);
        let commands = |c: char| c != '\n' && (c.is_control() || "\u{202e}\u{2066}".contains(c));
        assert!(!error.contains(commands), "{error:?}");
        assert!(error.len() < 2000, "{} bytes", error.len());
    }
    // What a user types is repeated, too.
    let typed = format!("{}\u{1b}[31m", "y".repeat(50_000));
    for arguments in [
        vec![typed.as_str()],
        vec!["inspect", "good.asp", "--texture", &typed],
        vec![
            "import",
            "hatt",
            "wood.xml",
            "-o",
            "x",
            "--fidelity",
            &typed,
        ],
    ] {
        let output = asperity(folder, &arguments);
        let error = text(&output.stderr);
        assert!(!output.status.success());
        assert!(error.len() < 2500 && !error.contains('\u{1b}'), "{error:?}");
    }
}

/// An asset may come from anywhere: what it says of itself commands no terminal.
#[test]
fn notes_in_an_asset_are_shown_without_escapes() {
    let inputs = inputs();
    let folder = inputs.path();
    let emit = ["builtin", "-o", "b.asp", "--emit-model", "b.json"];
    assert!(asperity(folder, &emit).status.success());
    let model = fs::read_to_string(folder.join("b.json")).expect("a model");
    let mut model: Value = serde_json::from_str(&model).expect("JSON");
    model["provenance"]["notes"] = "\u{1b}]0;title\u{7}\u{9b}2J".into();
    fs::write(folder.join("b.json"), model.to_string()).expect("a model");
    let import = ["import", "model", "b.json", "-o", "c.asp", "--no-preview"];
    let imported = asperity(folder, &import);
    assert!(imported.status.success(), "{}", text(&imported.stderr));
    let shown = text(&asperity(folder, &["inspect", "c.asp"]).stdout);
    assert!(shown.contains("]0;title"), "{shown}");
    assert!(
        !shown.contains(|c: char| c != '\n' && c.is_control()),
        "{shown:?}"
    );
}

#[test]
fn a_library_shows_the_names_of_its_index() {
    let inputs = inputs();
    let folder = inputs.path();
    let good = fs::read(folder.join("good.asp")).expect("the asset");
    let assets =
        ["mine", "yours"].map(|name| asperity::emit::pack::NamedAsset { name, bytes: &good });
    let library = asperity::emit::pack::encode(&assets).expect("a library");
    fs::write(folder.join("two.aspl"), library).expect("a library");
    let json = |arguments: &[&str]| -> Value {
        let output = asperity(folder, arguments);
        serde_json::from_slice(&output.stdout).expect("JSON")
    };
    let all = json(&["inspect", "two.aspl", "--json"]);
    assert_eq!(all["textures"][0]["name"], "mine");
    assert_eq!(all["textures"][1]["name"], "yours");
    for wanted in ["yours", "1"] {
        let one = ["inspect", "two.aspl", "--texture", wanted];
        assert_eq!(json(&[&one[..], &["--json"]].concat())["name"], "yours");
        assert!(text(&asperity(folder, &one).stdout).starts_with("yours\n"));
    }
}

#[test]
fn a_remedy_names_only_options_that_the_command_has() {
    let inputs = inputs();
    let folder = inputs.path();
    fs::remove_file(folder.join("mixed/b.xml")).expect("the bad one");
    fs::write(folder.join("mixed/c.xml"), material("C")).expect("a file");
    let import = ["import", "hatt", "mixed", "-o", "two.aspl"];
    assert!(asperity(folder, &import).status.success());
    let library = scene("").replace("good.asp", "two.aspl");
    fs::write(folder.join("library.toml"), library).expect("a scene");
    let empty = scene("").replace("asset = \"good.asp\"", "prompt = \" \"");
    fs::write(folder.join("empty.toml"), empty).expect("a scene");
    let help = text(&asperity(folder, &["build", "--help"]).stdout);
    for (file, field) in [("library.toml", "asset: "), ("empty.toml", "prompt: ")] {
        let build = ["build", file, "-o", "out.aspl"];
        refused(folder, &build, &[file, field]);
        let error = text(&asperity(folder, &build).stderr);
        let advised = error
            .split_whitespace()
            .filter(|word| word.starts_with("--"));
        for option in advised {
            assert!(help.contains(option), "{option} of {error}");
        }
        assert!(!error.contains("asperity compile"), "{error}");
    }
}

#[test]
fn a_bad_rate_or_share_is_wrong_usage() {
    let inputs = inputs();
    let folder = inputs.path();
    let emit = ["builtin", "-o", "b.asp", "--emit-model", "b.json"];
    assert!(asperity(folder, &emit).status.success());
    fs::write(folder.join("desk.toml"), scene("")).expect("a scene");
    let build = ["build", "desk.toml", "--no-cache", "-o", "desk.aspl"];
    assert!(asperity(folder, &build).status.success());
    let commands: [&[&str]; 4] = [
        &["render", "good.asp", "--trajectory", "stroke.csv"],
        &["render", "desk.aspl", "--trajectory", "stroke.csv"],
        &["compile", "cork"],
        &["import", "model", "b.json"],
    ];
    for command in commands {
        for rate in [
            "--rate=3",
            "--rate=nan",
            "--rate=-1000",
            "--rate=fast",
            "--rate=inf",
        ] {
            let arguments = [command, &["-o", "out", rate]].concat();
            let output = asperity(folder, &arguments);
            let error = text(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
            assert!(!folder.join("out").exists());
        }
    }
    for (options, status) in [
        (&["--share", "5"][..], 2),
        (&["--share", "5", "--target", "cortex-m4f@168MHz"], 0),
        (&["--target", "cortex-m4f@168MHz"], 0),
    ] {
        let output = asperity(folder, &[&build[..], options].concat());
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(status), "{options:?}: {error}");
    }
}

#[test]
fn doctor_runs_what_it_finds() {
    let folder = tempfile::tempdir().expect("a folder");
    let names = [
        "text_projection.onnx",
        "ar_decoder.onnx",
        "tap_decoder.onnx",
        "encoder.onnx",
    ];
    write_model(folder.path());
    let doctor = ["doctor", "--model", "."];
    let whole = asperity(folder.path(), &doctor);
    assert!(whole.status.success(), "{}", text(&whole.stderr));
    for name in names {
        let file = folder.path().join(name);
        let bytes = fs::read(&file).expect("a network");
        fs::write(&file, &bytes[..bytes.len() / 2]).expect("half of it");
        refused_with_output(folder.path(), &doctor, &["model", name]);
        fs::write(&file, bytes).expect("all of it");
    }
}

/// As [`refused`], of a command that prints what it found.
fn refused_with_output(folder: &Path, arguments: &[&str], named: &[&str]) {
    let output = asperity(folder, arguments);
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{arguments:?}: {error}");
    for name in named {
        assert!(error.contains(name), "{name} not in {error}");
    }
    let found = text(&output.stdout);
    let model = found.lines().find(|line| line.starts_with("model"));
    assert!(model.is_some_and(|line| !line.contains("found")), "{found}");
}

#[test]
fn what_of_a_prompt_was_not_understood_is_named() {
    let inputs = inputs();
    let folder = inputs.path();
    let compile = |prompt: &str| {
        let arguments = ["compile", prompt, "-o", "p.asp", "--no-preview", "--json"];
        let output = asperity(folder, &arguments);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let json: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        (json, text(&output.stderr))
    };
    for (prompt, read, unread) in [
        ("rough 木材", "rough", &["木材"][..]),
        ("خشب ناعم", "", &["خشب", "ناعم"]),
        ("🔥", "", &["🔥"]),
        ("...", "", &["..."]),
    ] {
        let (json, warned) = compile(prompt);
        assert_eq!(json["understood"], read, "{prompt}");
        let named: Vec<Value> = unread.iter().map(|run| Value::from(*run)).collect();
        assert_eq!(json["not_understood"], Value::from(named), "{prompt}");
        let warning = warned.lines().find(|line| line.contains("understood"));
        let warning = warning.unwrap_or_else(|| panic!("{prompt}: {warned}"));
        assert!(
            warning.starts_with("warning: ") && warning.contains(unread[0]),
            "{warning}"
        );
        assert!(warning.contains(read), "{warning}");
    }
    let (json, warned) = compile("crème-coloured cork, 3 mm");
    assert_eq!(json["not_understood"], Value::Array(Vec::new()));
    assert!(!warned.contains("understood"), "{warned}");
    for empty in ["", "  ", "\u{200b}"] {
        let output = asperity(folder, &["compile", empty, "-o", "e.asp"]);
        assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
        assert!(!folder.join("e.asp").exists());
    }
    // A scene tells, too, and says where.
    let prompts = scene("").replace("asset = \"good.asp\"", "prompt = \"rough 木材\"");
    fs::write(folder.join("scene.toml"), prompts).expect("a scene");
    let built = asperity(
        folder,
        &[
            "build",
            "scene.toml",
            "--no-cache",
            "-o",
            "s.aspl",
            "--json",
            "--quiet",
        ],
    );
    let json: Value = serde_json::from_slice(&built.stdout).expect("JSON");
    assert!(
        text(&built.stderr).contains("木材"),
        "{}",
        text(&built.stderr)
    );
    assert!(
        json["warnings"][0]
            .as_str()
            .expect("a warning")
            .contains("not understood")
    );
}

#[test]
fn every_command_takes_quiet() {
    let inputs = inputs();
    let commands: [&[&str]; 9] = [
        &[],
        &["compile"],
        &["build"],
        &["import", "hatt"],
        &["import", "model"],
        &["builtin"],
        &["plot"],
        &["render"],
        &["doctor"],
    ];
    for command in commands {
        let help = asperity(inputs.path(), &[command, &["--help"]].concat());
        assert!(text(&help.stdout).contains("--quiet"), "{command:?}");
    }
    let loud = asperity(inputs.path(), &["inspect", "good.asp"]);
    let quiet = asperity(inputs.path(), &["inspect", "good.asp", "--quiet"]);
    assert_eq!(text(&quiet.stdout), text(&loud.stdout));
}

#[test]
fn a_quiet_command_that_writes_files_prints_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect(name);
    write("stroke.csv", &stroke());
    write("names.csv", "name,prompt\nfelt,felt\ncork,cork\n");
    let commands = [
        "builtin -o builtin.asp",
        "compile felt -o felt.asp --preview-size 64",
        "compile cork -o cork.asp --no-preview",
        "preview felt.asp -o felt.png",
        "listen felt.asp -o felt.wav",
        "plot felt.asp -o sheet.png",
        "render felt.asp --trajectory stroke.csv -o felt.csv",
        "export felt.asp --to csv -o stroke-of-felt.csv",
        "export felt.asp --to c-array -o felt.h",
        "edit felt.asp --rougher 10 -o rough.asp",
        "blend felt.asp cork.asp -t 0.5 -o half.asp",
        "compose --tap felt.asp --slide cork.asp -o both.asp",
        "build names.csv --check",
        "build names.csv -o names.aspl",
        "rename names.aspl cork bark -o bark.aspl",
        "extract names.aspl felt -o taken.asp",
        "split names.aspl -o parts",
    ];
    for command in commands {
        let arguments: Vec<&str> = command.split(' ').chain(["--quiet"]).collect();
        let output = asperity(folder.path(), &arguments);
        let printed = (text(&output.stdout), text(&output.stderr));
        assert!(output.status.success(), "{command}: {printed:?}");
        assert_eq!(printed, Default::default(), "{command}");
    }
}

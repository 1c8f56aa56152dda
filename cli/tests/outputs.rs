//! Outputs: none destroys an input, another output or a protected file, and one can be piped.

use super::*;
use std::process::Stdio;

const SCENE: &str = "[[texture]]\nname = \"a\"\nasset = \"good.asp\"\n\
    [[texture]]\nname = \"w\"\nimport = \"wood.xml\"\n[[surface]]\ntexture = \"a\"\n\
    plane = { point_m = [0, 0, 0], normal = [0, 0, 1] }\n";

/// The inputs of [`inputs`], a scene, a model and a model folder.
fn more_inputs() -> TempDir {
    let inputs = inputs();
    let folder = inputs.path();
    fs::write(folder.join("desk.toml"), SCENE).expect("a scene");
    let emit = ["builtin", "-o", "b.asp", "--emit-model", "b.json"];
    assert!(asperity(folder, &emit).status.success());
    fs::create_dir(folder.join("model")).expect("a folder");
    write_model(&folder.join("model"));
    inputs
}

/// Runs what must be refused as wrong usage: exit 2, and every file as it was.
fn destroys_nothing(folder: &Path, arguments: &[&str], says: &str) {
    let content = |folder: &Path| -> Vec<(String, Option<Vec<u8>>)> {
        let names = entries(folder).into_iter();
        names
            .map(|name| {
                let bytes = fs::read(folder.join(&name)).ok();
                (name, bytes)
            })
            .collect()
    };
    let before = (content(folder), content(&folder.join("model")));
    let output = asperity(folder, arguments);
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
    assert!(error.contains(says), "{arguments:?}: {error}");
    assert!(error.contains("\n  help: "), "{arguments:?}: {error}");
    assert_eq!(text(&output.stdout), "", "{arguments:?}");
    let after = (content(folder), content(&folder.join("model")));
    assert!(before == after, "{arguments:?} changed a file");
}

#[test]
fn no_command_replaces_what_it_reads() {
    let inputs = more_inputs();
    let folder = inputs.path();
    fs::hard_link(folder.join("good.asp"), folder.join("hard.asp")).expect("a link");
    let render = ["render", "good.asp", "--trajectory", "stroke.csv", "-o"];
    let build = ["build", "desk.toml", "--no-cache", "-o"];
    let compile = ["compile", "cork", "--model", "model", "-o"];
    let taps = ["import", "hatt", "wood.xml", "--complete-taps", "--model"];
    let cases: [(&[&str], &[&str]); 13] = [
        (&["plot", "good.asp", "-o"], &["good.asp"]),
        (&["plot", "good.asp", "-o"], &["dir/../good.asp"]),
        (&["plot", "good.asp", "-o"], &["hard.asp"]),
        (&render, &["stroke.csv"]),
        (&render, &["./good.asp"]),
        (&build, &["desk.toml"]),
        (&build, &["good.asp"]),
        // Also what no surface wears.
        (&build, &["wood.xml"]),
        (&["import", "hatt", "wood.xml", "-o"], &["wood.xml"]),
        (&["import", "model", "b.json", "-o"], &["b.json"]),
        (&compile, &["model/model.json"]),
        (&compile, &["out.asp", "--plot", "model/ar_decoder.onnx"]),
        (&taps, &["model", "-o", "model/encoder.onnx"]),
    ];
    for (command, output) in cases {
        destroys_nothing(folder, &[command, output].concat(), "an input");
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("good.asp", folder.join("link.asp")).expect("a link");
        destroys_nothing(folder, &["plot", "good.asp", "-o", "link.asp"], "an input");
        destroys_nothing(folder, &["plot", "link.asp", "-o", "hard.asp"], "an input");
    }
    // An import into a folder writes names that are known after the work.
    fs::write(folder.join("Wood.asp"), material("Wood")).expect("a material");
    let into_itself = ["import", "hatt", "Wood.asp", "-o", "./"];
    destroys_nothing(folder, &into_itself, "an input");
}

#[test]
fn no_output_replaces_another() {
    let inputs = more_inputs();
    let folder = inputs.path();
    let compile = ["compile", "cork", "-o"];
    for (output, says) in [
        (["x", "--plot", "x"], "another output"),
        (["x", "--emit-model", "dir/../x"], "another output"),
        (["x.asp", "--plot", "X.asp"], "upper and lower case"),
        (["-", "--plot", "-"], "standard output"),
        (["-", "--emit-model", "/dev/stdout"], "standard output"),
    ] {
        destroys_nothing(folder, &[&compile[..], &output].concat(), says);
    }
}

#[test]
fn a_read_only_file_is_refused_and_permissions_are_kept() {
    let inputs = inputs();
    let folder = inputs.path();
    let target = folder.join("kept.asp");
    fs::copy(folder.join("good.asp"), &target).expect("a copy");
    let mut permissions = fs::metadata(&target).expect("it").permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&target, permissions).expect("permissions");
    let before = fs::read(&target).expect("it");
    refused(
        folder,
        &["import", "hatt", "wood.xml", "-o", "kept.asp"],
        &["kept.asp", "read-only"],
    );
    assert!(fs::read(&target).expect("it") == before);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        fs::set_permissions(&target, fs::Permissions::from_mode(0o640)).expect("permissions");
        assert!(
            asperity(folder, &["import", "hatt", "wood.xml", "-o", "kept.asp"])
                .status
                .success()
        );
        assert!(fs::read(&target).expect("it") != before);
        let mode = fs::metadata(&target).expect("it").permissions().mode();
        assert_eq!(mode & 0o777, 0o640);
    }
}

/// Every command that writes one file, without its output.
const WRITES_ONE: [&[&str]; 8] = [
    &["builtin"],
    &["compile", "cork", "--no-preview"],
    &["build", "desk.toml", "--no-cache"],
    &["import", "hatt", "wood.xml"],
    &["import", "model", "b.json"],
    &["plot", "good.asp"],
    &["render", "good.asp", "--trajectory", "stroke.csv"],
    &["builtin", "-o", "beside.asp", "--emit-model"],
];

/// The command with its output at `to`.
fn with_output<'a>(command: &[&'a str], to: &'a str) -> Vec<&'a str> {
    let flag: &[&str] = if command.ends_with(&["--emit-model"]) {
        &[]
    } else {
        &["-o"]
    };
    [command, flag, &[to]].concat()
}

#[test]
fn one_output_goes_to_standard_output_and_the_report_beside_it() {
    let inputs = more_inputs();
    let folder = inputs.path();
    let mut to_pipe = vec!["-"];
    if cfg!(target_os = "linux") {
        to_pipe.push("/dev/stdout");
    }
    for command in WRITES_ONE {
        let plain = asperity(folder, &with_output(command, "file.out"));
        assert!(
            plain.status.success(),
            "{command:?}: {}",
            text(&plain.stderr)
        );
        let file = fs::read(folder.join("file.out")).expect("the output");
        for pipe in &to_pipe {
            let piped = asperity(folder, &with_output(command, pipe));
            let report = text(&piped.stderr);
            assert!(piped.status.success(), "{command:?} {pipe}: {report}");
            assert!(piped.stdout == file, "{command:?} {pipe}: other bytes");
            let told = text(&plain.stdout).replace("file.out", "standard output");
            let told = text(&plain.stderr) + &told;
            // There is nothing to try with a pipe.
            let told = told.split("  try  ").next().unwrap_or_default();
            assert_eq!(report, told, "{command:?} {pipe}");
        }
    }
    let json = asperity(folder, &["compile", "cork", "-o", "-", "--json"]);
    assert!(json.stdout.starts_with(b"ASPT"));
    serde_json::from_slice::<serde_json::Value>(&json.stderr).expect("JSON alone");
    assert!(!entries(folder).contains(&"-".to_owned()));
}

#[test]
fn a_folder_of_materials_is_piped_as_a_library() {
    let inputs = inputs();
    fs::remove_file(inputs.path().join("mixed/b.xml")).expect("the bad one");
    let piped = asperity(inputs.path(), &["import", "hatt", "mixed", "-o", "-"]);
    assert!(piped.stdout.starts_with(b"ASPL"), "{}", text(&piped.stderr));
}

/// Returns the exit status and standard error of a command whose reader of standard output, or of both, has gone away.
#[cfg(unix)]
fn into_closed_pipe(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let output = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(arguments)
        .current_dir(folder)
        .stdout(writer)
        .output()
        .expect("the command runs");
    (output.status.code(), text(&output.stderr))
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_is_no_panic() {
    let inputs = more_inputs();
    let folder = inputs.path();
    for command in WRITES_ONE {
        let (status, error) = into_closed_pipe(folder, &with_output(command, "-"));
        assert_eq!(status, Some(0), "{command:?}: {error}");
        assert!(!error.contains("panicked"), "{command:?}: {error}");
    }
    // Where nobody reads errors either, the status still tells.
    for (arguments, status) in [
        (&["inspect", "absent.asp"][..], 1),
        (&["polish"], 2),
        (&["compile", "木", "-o", "x.asp"], 0),
        (&["builtin", "-o", "-", "--timings"], 0),
    ] {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let done = Command::new(env!("CARGO_BIN_EXE_asperity"))
            .args(arguments)
            .current_dir(folder)
            .stdout(Stdio::null())
            .stderr(writer)
            .status()
            .expect("the command runs");
        assert_eq!(done.code(), Some(status), "{arguments:?}");
    }
}

/// Runs with a file's bytes on standard input, through a pipe.
fn fed(folder: &Path, arguments: &[&str], file: &str) -> Output {
    let bytes = fs::read(folder.join(file)).expect("the file");
    let mut child = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command runs");
    let mut stdin = child.stdin.take().expect("a pipe");
    let feeder = std::thread::spawn(move || {
        // A command that refuses early closes the pipe.
        let _ = std::io::Write::write_all(&mut stdin, &bytes);
    });
    let output = child.wait_with_output().expect("it ends");
    feeder.join().expect("it ends");
    output
}

#[test]
fn an_asset_or_a_library_is_read_from_a_pipe() {
    let inputs = inputs();
    let folder = inputs.path();
    let build = ["import", "hatt", "mixed/a.xml", "-o", "all.aspl"];
    assert!(asperity(folder, &build).status.success());
    let mut from_pipe = vec!["-"];
    if cfg!(target_os = "linux") {
        from_pipe.push("/dev/stdin");
    }
    for from in from_pipe {
        for file in ["good.asp", "all.aspl"] {
            let commands: [&[&str]; 2] = [&["inspect", from, "--json"], &["plot", from, "-o", "-"]];
            for command in commands {
                let piped = fed(folder, command, file);
                assert!(
                    piped.status.success(),
                    "{command:?}: {}",
                    text(&piped.stderr)
                );
                let mut direct = command.to_vec();
                direct[1] = file;
                let direct = asperity(folder, &direct);
                assert!(piped.stdout == direct.stdout, "{command:?} of {file}");
            }
        }
        let cut = fed(folder, &["inspect", from], "short.asp");
        assert_eq!(cut.status.code(), Some(1));
        assert!(
            text(&cut.stderr).contains("truncated"),
            "{}",
            text(&cut.stderr)
        );
    }
}

#[cfg(unix)]
#[test]
fn what_the_shell_redirects_to_is_an_output_too() {
    let inputs = inputs();
    let folder = inputs.path();
    let redirected = fs::File::create(folder.join("out.asp")).expect("a file");
    let output = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(["builtin", "-o", "out.asp"])
        .current_dir(folder)
        .stdout(redirected)
        .output()
        .expect("the command runs");
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("standard output"));
}

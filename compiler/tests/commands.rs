//! `asperity` as a user meets it: exit status, what errors name, nothing left over.

use std::{
    fmt::Write as _,
    fs,
    path::Path,
    process::{Command, Output},
};
use tempfile::TempDir;

fn asperity(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the command runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn entries(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .expect("the folder")
        .filter_map(|entry| Some(entry.ok()?.file_name().to_string_lossy().into_owned()))
        .collect();
    names.sort();
    names
}

/// A stroke of 50 ticks at 1 kHz.
fn stroke() -> String {
    (0..50).fold("t_s,x_mm,y_mm,z_mm\n".to_owned(), |mut csv, n| {
        let t = f64::from(n) / 1000.0;
        let _ = writeln!(csv, "{t},{},0,{}", 100.0 * t, 0.5 - 40.0 * t);
        csv
    })
}

/// A material of four corners and a centre, order 2, one zero.
fn material(name: &str) -> String {
    let (low, high) = (0.8_f64, 2.0_f64);
    let (a1, a2) = (-low.cos() - high.cos(), 1.0 - low.cos() + high.cos());
    let list = |tag: &str, values: &[f64]| {
        let values: String = values
            .iter()
            .map(|v| format!("<value>{v}</value>"))
            .collect();
        format!("<{tag} type=\"array\">{values}</{tag}>\n")
    };
    let positions = [
        (0.0, 0.0),
        (200.0, 0.0),
        (200.0, 4.0),
        (0.0, 4.0),
        (80.0, 1.5),
    ];
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<modelSet texture=\"0\">\n\
         <material>{name}</material>\n<AccelUnits>m/s^2</AccelUnits>\n\
         <SpeedUnits>mm/s</SpeedUnits>\n<ForceUnits>N</ForceUnits>\n\
         <SampleRate>1000</SampleRate>\n<mu>0.4</mu>\n<numMod>5</numMod>\n<numTri>4</numTri>\n\
         <maxSpeed>200</maxSpeed>\n<maxForce>4</maxForce>\n"
    );
    xml += &list("speedList", &positions.map(|p| p.0));
    xml += &list("forceList", &positions.map(|p| p.1));
    for triangle in [
        [1.0, 2.0, 5.0],
        [2.0, 3.0, 5.0],
        [3.0, 4.0, 5.0],
        [4.0, 1.0, 5.0],
    ] {
        xml += &list("tri", &triangle);
    }
    xml += "<numARCoeff>2</numARCoeff>\n<numMACoeff>1</numMACoeff>\n";
    for (index, (speed, force)) in positions.iter().enumerate() {
        let _ = writeln!(xml, "<model>\n<modNum>{}</modNum>", index + 1);
        xml += &list("ARcoeff", &[1.0, a1, a2]);
        xml += &list("ARlsf", &[low, high]);
        // One LSF ω: B(z) = 1 − cos ω z⁻¹.
        xml += &list("MAcoeff", &[1.0, -1.5_f64.cos()]);
        xml += &list("MAlsf", &[1.5]);
        let variance = if *speed == 0.0 || *force == 0.0 {
            0.0
        } else {
            0.01
        };
        let _ = writeln!(
            xml,
            "<var>{variance}</var>\n<gain>2</gain>\n<speedMod>{speed}</speedMod>\n\
             <forceMod>{force}</forceMod>\n</model>"
        );
    }
    xml + "</modelSet>\n"
}

/// A folder with good inputs of every kind and bad ones.
fn inputs() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let made = asperity(folder.path(), &["builtin", "-o", "good.asp"]);
    assert!(made.status.success(), "{}", text(&made.stderr));
    let good = fs::read(at("good.asp")).expect("the asset");
    let mut flipped = good.clone();
    flipped[200] ^= 4;
    let write = |name: &str, bytes: &[u8]| fs::write(at(name), bytes).expect("an input");
    write("flipped.asp", &flipped);
    write("short.asp", &good[..good.len() / 2]);
    write("long.asp", &[&good[..], b"x"].concat());
    write("empty.asp", b"");
    write("other.asp", b"RIFF\x24\0\0\0WAVEfmt \x10\0\0\0\x01\0\x01\0");
    let mut later = good;
    later[4] = 9;
    write("later.asp", &later);
    write("stroke.csv", stroke().as_bytes());
    write("wood.xml", material("Wood").as_bytes());
    fs::create_dir(at("dir")).expect("a folder");
    fs::create_dir(at("mixed")).expect("a folder");
    write("mixed/a.xml", material("A").as_bytes());
    write(
        "mixed/b.xml",
        material("B").replace("<mu>0.4</mu>", "").as_bytes(),
    );
    folder
}

/// Runs what must fail: exit 1, an error that names each of `named`, a remedy, nothing on
/// stdout and no file more or less than before.
fn refused(folder: &Path, arguments: &[&str], named: &[&str]) {
    let before = entries(folder);
    let output = asperity(folder, arguments);
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{arguments:?}: {error}");
    assert!(error.starts_with("error: "), "{arguments:?}: {error}");
    assert!(error.contains("\n  help: "), "{arguments:?}: {error}");
    for name in named {
        assert!(
            error.contains(name),
            "{arguments:?}: {name:?} not in {error}"
        );
    }
    assert!(!error.contains("panicked"), "{arguments:?}: {error}");
    assert_eq!(text(&output.stdout), "", "{arguments:?}");
    assert_eq!(entries(folder), before, "{arguments:?} left something");
}

#[test]
fn every_command_refuses_files_that_are_no_texture() {
    let inputs = inputs();
    let bad = [
        ("absent.asp", "cannot read"),
        ("dir", "dir"),
        ("empty.asp", "empty.asp"),
        ("other.asp", "other.asp"),
        ("stroke.csv", "stroke.csv"),
        ("short.asp", "truncated"),
        ("long.asp", "trailing"),
        ("flipped.asp", "checksum"),
        ("later.asp", "version"),
    ];
    for (file, says) in bad {
        refused(inputs.path(), &["inspect", file], &[file, says]);
        refused(inputs.path(), &["inspect", file, "--json"], &[file, says]);
        refused(
            inputs.path(),
            &["plot", file, "-o", "out.png"],
            &[file, says],
        );
        let render = [
            "render",
            file,
            "--trajectory",
            "stroke.csv",
            "-o",
            "out.csv",
        ];
        refused(inputs.path(), &render, &[file, says]);
    }
}

#[test]
fn every_command_refuses_outputs_that_cannot_be() {
    let inputs = inputs();
    for output in ["no/such/folder/out", "dir"] {
        let commands: [&[&str]; 4] = [
            &["builtin"],
            &["plot", "good.asp"],
            &["render", "good.asp", "--trajectory", "stroke.csv"],
            &["import", "hatt", "mixed/a.xml"],
        ];
        for command in commands {
            // A folder is a good output of an import.
            if command[0] == "import" && output == "dir" {
                continue;
            }
            let arguments = [command, &["-o", output]].concat();
            refused(inputs.path(), &arguments, &[output]);
        }
    }
    // A file is no folder.
    refused(
        inputs.path(),
        &["builtin", "-o", "good.asp/out.asp"],
        &["good.asp/out.asp"],
    );
    // What was there before a failure is there after it.
    let before = fs::read(inputs.path().join("good.asp")).expect("the asset");
    refused(
        inputs.path(),
        &["import", "hatt", "mixed/b.xml", "-o", "good.asp"],
        &["b.xml", "mu"],
    );
    assert_eq!(
        fs::read(inputs.path().join("good.asp")).expect("the asset"),
        before
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure() {
    let inputs = inputs();
    let commands: [&[&str]; 3] = [
        &["builtin"],
        &["plot", "good.asp"],
        &["import", "hatt", "wood.xml"],
    ];
    for command in commands {
        let arguments = [command, &["-o", "/dev/full"]].concat();
        refused(inputs.path(), &arguments, &["/dev/full"]);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_under_a_render_names_the_output() {
    let inputs = inputs();
    let arguments = [
        "render",
        "good.asp",
        "--trajectory",
        "stroke.csv",
        "-o",
        "/dev/full",
    ];
    refused(inputs.path(), &arguments, &["/dev/full"]);
}

/// Results that cannot be written are lost: that is no success.
#[cfg(target_os = "linux")]
#[test]
fn results_that_cannot_be_printed_are_a_failure() {
    let inputs = inputs();
    for arguments in [
        &["inspect", "good.asp"][..],
        &["inspect", "good.asp", "--json"],
    ] {
        let full = fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .expect("/dev/full");
        let output = Command::new(env!("CARGO_BIN_EXE_asperity"))
            .args(arguments)
            .current_dir(inputs.path())
            .stdout(full)
            .output()
            .expect("the command runs");
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {error}");
        assert!(error.starts_with("error: "), "{arguments:?}: {error}");
    }
}

#[cfg(unix)]
#[test]
fn a_folder_without_permission_is_named() {
    use std::{io::Write as _, os::unix::fs::PermissionsExt as _};
    let inputs = inputs();
    let locked = inputs.path().join("locked");
    fs::create_dir(&locked).expect("a folder");
    fs::set_permissions(&locked, fs::Permissions::from_mode(0o555)).expect("permissions");
    if fs::write(locked.join("probe"), b"").is_ok() {
        // Past the harness, which hides what a passing test prints.
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED a_folder_without_permission_is_named: this user may write anywhere"
        );
        return;
    }
    refused(
        inputs.path(),
        &["builtin", "-o", "locked/out.asp"],
        &["locked/out.asp"],
    );
}

#[test]
fn malformed_materials_are_refused_with_file_and_line() {
    let inputs = inputs();
    let good = material("Wood");
    let before = good.find("<model>").expect("a model");
    let cases: [(&str, String, &str); 9] = [
        ("unclosed", good.replace("</modelSet>", ""), "well-formed"),
        ("missing", good.replace("<mu>0.4</mu>", ""), "mu"),
        ("nan", good.replace("<mu>0.4", "<mu>NaN"), "mu"),
        ("counts", good.replace("<numMod>5", "<numMod>6"), "numMod"),
        ("zero", format!("{}</modelSet>", &good[..before]), "model"),
        (
            "hostile",
            good.replace(
                "<modelSet",
                "<!DOCTYPE m [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]>\n<modelSet",
            ),
            "entit",
        ),
        (
            "outside",
            good.replace(
                "<modelSet",
                "<!DOCTYPE m [<!ENTITY x SYSTEM \"file:///etc/hostname\">]>\n<modelSet",
            ),
            "entit",
        ),
        ("csv", stroke(), "well-formed"),
        ("variance", good.replace("<var>0.01", "<var>-0.01"), "var"),
    ];
    for (name, xml, says) in cases {
        let file = format!("{name}.xml");
        fs::write(inputs.path().join(&file), xml).expect("a file");
        refused(
            inputs.path(),
            &["import", "hatt", &file, "-o", "out.asp"],
            &[&file, says],
        );
    }
    // One bad file of a folder: no half of an import.
    for output in ["out", "out.aspl", "out/"] {
        refused(
            inputs.path(),
            &["import", "hatt", "mixed", "-o", output],
            &["b.xml", "mu"],
        );
    }
    refused(
        inputs.path(),
        &["import", "hatt", "dir", "-o", "out"],
        &["dir", "no .xml file"],
    );
    refused(
        inputs.path(),
        &["import", "hatt", "absent.xml", "-o", "out.asp"],
        &["absent.xml"],
    );
    refused(
        inputs.path(),
        &["import", "hatt", "good.asp", "-o", "out.asp"],
        &["good.asp"],
    );
}

#[test]
fn malformed_trajectories_are_refused_with_line_and_column() {
    let inputs = inputs();
    let good = stroke();
    let line = |n: usize, text: &str| {
        let mut lines: Vec<_> = good.lines().collect();
        lines[n - 1] = text;
        lines.join("\n")
    };
    let cases: [(&str, String, &[&str]); 9] = [
        ("empty.csv", String::new(), &["t_s"]),
        ("no-rows.csv", "t_s,x_mm,y_mm,z_mm\n".into(), &["no row"]),
        (
            "column.csv",
            good.replacen("z_mm", "height", 1),
            &[":1:", "z_mm"],
        ),
        (
            "words.csv",
            line(4, "0.002,a lot,0,0"),
            &[":4:", "x_mm", "a lot"],
        ),
        ("nan.csv", line(3, "0.001,0,NaN,0"), &[":3:", "y_mm", "NaN"]),
        ("infinite.csv", line(3, "0.001,0,0,-inf"), &[":3:", "z_mm"]),
        ("short.csv", line(5, "0.003,0,0"), &["short.csv", "5"]),
        (
            "rate.csv",
            line(7, "0.0055,0,0,0"),
            &[":7:", "t_s", "1000 Hz"],
        ),
        ("back.csv", line(9, "0.001,0,0,0"), &[":9:", "t_s"]),
    ];
    for (name, csv, named) in cases {
        fs::write(inputs.path().join(name), csv).expect("a file");
        let arguments = ["render", "good.asp", "--trajectory", name, "-o", "out.csv"];
        refused(inputs.path(), &arguments, &[&[name], named].concat());
    }
    fs::write(
        inputs.path().join("bytes.csv"),
        b"t_s,x_mm,y_mm,z_mm\n0,\xff\xfe,0,0\n",
    )
    .expect("a file");
    for (name, named) in [
        ("bytes.csv", "bytes.csv"),
        ("absent.csv", "absent.csv"),
        ("dir", "dir"),
    ] {
        let arguments = ["render", "good.asp", "--trajectory", name, "-o", "out.csv"];
        refused(inputs.path(), &arguments, &[named]);
    }
}

#[test]
fn wrong_usage_exits_with_2_and_every_command_has_examples() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("two")).expect("a folder");
    for name in ["two/a.xml", "two/b.xml"] {
        fs::write(folder.path().join(name), material(name)).expect("a file");
    }
    let wrong: [&[&str]; 10] = [
        // Two materials do not fit one asset.
        &["import", "hatt", "two", "-o", "out.asp"],
        &[],
        &["polish"],
        &["builtin"],
        &["inspect"],
        &["plot", "good.asp"],
        &["render", "good.asp", "-o", "out.csv"],
        &[
            "render",
            "a.asp",
            "--trajectory",
            "b.csv",
            "-o",
            "c.csv",
            "--seed",
            "many",
        ],
        &[
            "import",
            "hatt",
            "a.xml",
            "-o",
            "a.asp",
            "--fidelity",
            "7.5",
        ],
        &["import", "wav", "a.wav"],
    ];
    for arguments in wrong {
        let output = asperity(folder.path(), arguments);
        assert_eq!(
            output.status.code(),
            Some(2),
            "{arguments:?}: {}",
            text(&output.stderr)
        );
        assert_eq!(entries(folder.path()), ["two"]);
    }
    let commands: [&[&str]; 6] = [
        &[],
        &["builtin"],
        &["inspect"],
        &["plot"],
        &["render"],
        &["import", "hatt"],
    ];
    for command in commands {
        let output = asperity(folder.path(), &[command, &["--help"]].concat());
        assert!(output.status.success());
        assert!(text(&output.stdout).contains("Example"), "{command:?}");
    }
}

#[test]
fn a_library_is_made_inspected_and_rendered_by_name_and_index() {
    let inputs = inputs();
    fs::remove_file(inputs.path().join("mixed/b.xml")).expect("the bad one");
    fs::write(inputs.path().join("mixed/c.xml"), material("C")).expect("a file");
    let run = |arguments: &[&str]| {
        let output = asperity(inputs.path(), arguments);
        assert!(
            output.status.success(),
            "{arguments:?}: {}",
            text(&output.stderr)
        );
        assert_eq!(
            text(&output.stderr),
            "",
            "{arguments:?}: progress only on a terminal"
        );
        text(&output.stdout)
    };
    let report = run(&["import", "hatt", "mixed", "-o", "all.aspl"]);
    // One line a material, and one for all.
    assert_eq!(report.lines().count(), 3, "{report}");
    let json: serde_json::Value =
        serde_json::from_str(&run(&["inspect", "all.aspl", "--json"])).expect("JSON");
    assert_eq!(json["textures"][1]["name"], "C");
    for which in ["C", "1"] {
        let output = format!("{which}.csv");
        run(&[
            "render",
            "all.aspl",
            "--texture",
            which,
            "--trajectory",
            "stroke.csv",
            "-o",
            &output,
        ]);
    }
    let read = |name: &str| fs::read(inputs.path().join(name)).expect("an output");
    assert_eq!(read("C.csv"), read("1.csv"));
    for which in ["B", "2", "-1", "c"] {
        refused(
            inputs.path(),
            &["inspect", "all.aspl", &format!("--texture={which}")],
            &["all.aspl", which],
        );
    }
    // A folder gives the same assets that the library holds.
    run(&["import", "hatt", "mixed", "-o", "assets"]);
    assert_eq!(entries(&inputs.path().join("assets")).len(), 2);
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let inputs = inputs();
    for round in ["1", "2"] {
        for arguments in [
            vec!["builtin", "-o"],
            vec!["import", "hatt", "wood.xml", "-o"],
            vec!["plot", "good.asp", "-o"],
            vec![
                "render",
                "good.asp",
                "--trajectory",
                "stroke.csv",
                "--seed",
                "7",
                "-o",
            ],
        ] {
            let output = format!("{}-{round}", arguments[0]);
            let arguments = [arguments, vec![output.as_str()]].concat();
            let done = asperity(inputs.path(), &arguments);
            assert!(
                done.status.success(),
                "{arguments:?}: {}",
                text(&done.stderr)
            );
        }
    }
    let read = |name: String| fs::read(inputs.path().join(name)).expect("an output");
    for command in ["builtin", "import", "plot", "render"] {
        assert!(
            read(format!("{command}-1")) == read(format!("{command}-2")),
            "{command}"
        );
    }
}

#[test]
fn render_writes_the_columns_of_the_contract() {
    let inputs = inputs();
    let done = asperity(
        inputs.path(),
        &[
            "render",
            "good.asp",
            "--trajectory",
            "stroke.csv",
            "-o",
            "out.csv",
            "--seed",
            "1",
        ],
    );
    assert!(done.status.success(), "{}", text(&done.stderr));
    let csv = fs::read_to_string(inputs.path().join("out.csv")).expect("the result");
    let mut lines = csv.lines();
    assert_eq!(
        lines.next(),
        Some(
            "tick,t_s,depth_mm,speed_mm_s,normal_force_n,vib_m_s2,tap_n,friction_n,fx_n,fy_n,fz_n,flags"
        )
    );
    let rows: Vec<Vec<f64>> = lines
        .map(|line| {
            line.split(',')
                .map(|x| x.parse().expect("a number"))
                .collect()
        })
        .collect();
    assert_eq!(rows.len(), 50);
    for (n, row) in rows.iter().enumerate() {
        assert_eq!((row.len(), row[0]), (12, n as f64));
        // z = 0.5 − 40 t mm, so the depth is known.
        let depth_mm = (40.0 * n as f64 / 1000.0 - 0.5).max(0.0);
        assert!((row[2] - depth_mm).abs() < 1e-5, "row {n}: {row:?}");
        assert_eq!(
            row[11] as u32 & 1,
            u32::from(depth_mm > 1e-9),
            "row {n}: {row:?}"
        );
    }
}

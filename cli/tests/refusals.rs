//! Bad inputs and outputs: named, and nothing left over.

use super::*;

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

//! Format hints in refusals of files, wherever they are given. `cases` has the levels of effects.

use super::*;
use std::path::PathBuf;

fn case(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../tests/cases")
        .join(name)
}

#[test]
fn a_file_of_another_format_is_named_with_the_command_that_reads_it() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(
        folder.path().join("x.gltf"),
        r#"{"asset": {"version": "2.0"}}"#,
    )
    .unwrap();
    fs::write(
        folder.path().join("x.mat"),
        b"MATLAB 5.0 MAT-file, \0\x01IM",
    )
    .unwrap();
    fs::write(
        folder.path().join("x.xlsx"),
        b"PK\x03\x04\x14\0xl/workbook.xml",
    )
    .unwrap();
    fs::write(
        folder.path().join("x.hjif"),
        r#"{"version": "2023", "perceptions": [],}"#,
    )
    .unwrap();
    fs::write(folder.path().join("x.html"), "<!DOCTYPE html><html></html>").unwrap();
    for name in ["x.ahap", "x.haps", "x.hasp", "x.tact", "vij0.haptic"] {
        fs::copy(
            case("wrong-format-help").join(name),
            folder.path().join(name),
        )
        .unwrap();
    }
    fs::write(folder.path().join("x.hmpg"), hmpg(folder.path())).unwrap();
    let known = [
        ("x.ahap", "AHAP", "import ahap"),
        ("x.hjif", "HJIF", "import hjif"),
        ("x.hmpg", "HMPG", "Decoder"),
        ("x.haps", "Interhaptics .haps", "export the effect"),
        ("x.hasp", "Haptics Studio", "import haptic"),
        ("x.tact", "bHaptics .tact", "export the effect"),
        ("vij0.haptic", "version 0", "version 1"),
        ("x.gltf", "glTF", "not read"),
        ("x.mat", "MATLAB", "CSV"),
        ("x.xlsx", "Excel", "CSV"),
        ("x.html", "web page", "download"),
    ];
    for (file, name, help) in known {
        for kind in ["haptic", "ahap", "hjif", "hatt", "model"] {
            if help.ends_with(kind) && help.starts_with("import") && file.ends_with(kind) {
                continue;
            }
            let arguments = ["import", kind, file, "-o", "out.asp"];
            refused(folder.path(), &arguments, &[file, name, help]);
        }
        refused(folder.path(), &["inspect", file], &[file, name, help]);
        fs::write(
            folder.path().join("list.toml"),
            format!("[[texture]]\nname = \"a\"\nimport = \"{file}\"\n"),
        )
        .unwrap();
        // Two of them are imported.
        let lists = [file, "list.toml"].into_iter();
        for list in lists.filter(|list| *list == file || !["x.ahap", "x.hjif"].contains(&file)) {
            refused(
                folder.path(),
                &["build", list, "-o", "out.aspl"],
                &[file, name, help],
            );
        }
    }
}

#[test]
fn a_trajectory_that_is_a_workbook_is_named() {
    let folder = tempfile::tempdir().unwrap();
    asperity(folder.path(), &["builtin", "-o", "grit.asp"]);
    fs::write(
        folder.path().join("x.csv"),
        b"PK\x03\x04\x14\0xl/workbook.xml",
    )
    .unwrap();
    let arguments = [
        "render",
        "grit.asp",
        "--trajectory",
        "x.csv",
        "-o",
        "out.csv",
    ];
    refused(
        folder.path(),
        &arguments,
        &["Excel workbook, not a trajectory", "CSV"],
    );
}

/// Returns an export of the built-in texture.
fn hmpg(folder: &Path) -> Vec<u8> {
    asperity(folder, &["builtin", "-o", "grit.asp"]);
    asperity(
        folder,
        &["export", "grit.asp", "--to", "hmpg", "-o", "grit.hmpg"],
    );
    fs::read(folder.join("grit.hmpg")).unwrap()
}

#[test]
fn a_pointer_of_git_lfs_is_named_wherever_a_file_is_read() {
    let folder = tempfile::tempdir().unwrap();
    asperity(folder.path(), &["builtin", "-o", "grit.asp"]);
    let pointer = fs::read(case("lfs-pointer").join("x.xml")).unwrap();
    for name in [
        "x.xml",
        "x.haptic",
        "x.csv",
        "x.toml",
        "x.jsonl",
        "clip/model.onnx",
        "model/model.json",
    ] {
        let file = folder.path().join(name);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, &pointer).unwrap();
    }
    for arguments in [
        &["import", "hatt", "x.xml", "-o", "out.asp"][..],
        &["import", "haptic", "x.haptic", "-o", "out.asp"],
        &["import", "ahap", "x.haptic", "-o", "out.asp"],
        &["import", "hjif", "x.haptic", "-o", "out.asp"],
        &["import", "model", "x.haptic", "-o", "out.asp"],
        &["inspect", "x.xml"],
        &["build", "x.toml", "-o", "out.aspl"],
        &["build", "x.csv", "-o", "out.aspl"],
        &["build", "x.jsonl", "-o", "out.aspl"],
        &[
            "render",
            "grit.asp",
            "--trajectory",
            "x.csv",
            "-o",
            "out.csv",
        ],
        &[
            "compile",
            "wood",
            "-o",
            "out.asp",
            "--text-encoder",
            "clip:clip",
        ],
        &["compile", "wood", "-o", "out.asp", "--model", "model"],
    ] {
        refused(
            folder.path(),
            arguments,
            &["Git LFS pointer", "git lfs pull"],
        );
    }
}

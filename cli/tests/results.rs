//! Usage, and what good inputs give.

use super::*;

#[test]
fn wrong_usage_exits_with_2_and_every_command_has_examples() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("two")).expect("a folder");
    for name in ["two/a.xml", "two/b.xml"] {
        fs::write(folder.path().join(name), material(name)).expect("a file");
    }
    let wrong: [&[&str]; 13] = [
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
        &[
            "export", "a.asp", "--to", "rust", "-o", "a.rs", "--symbol", "a-b",
        ],
        &[
            "export", "a.asp", "--to", "wav", "-o", "a.wav", "--symbol", "a",
        ],
        &[
            "export",
            "a.asp",
            "--to",
            "wav",
            "-o",
            "a.wav",
            "--keep-preview",
        ],
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
    let commands: [&[&str]; 7] = [
        &[],
        &["builtin"],
        &["inspect"],
        &["plot"],
        &["render"],
        &["import", "hatt"],
        &["import", "model"],
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

/// The report is a designer's: words, feel on the sliders' scales, certainty, size, what to try.
#[test]
fn the_report_of_a_prompt_is_for_a_designer() {
    let folder = tempfile::tempdir().expect("a folder");
    let args = [
        "compile",
        "my rough gravel",
        "-o",
        "a gravel.asp",
        "--no-preview",
    ];
    let out = asperity(folder.path(), &args);
    assert!(out.status.success(), "{out:?}");
    let usual = String::from_utf8(out.stdout).expect("text");
    let of_designers = [
        "taken as",
        "feels like",
        "rough",
        "slippery",
        "hard",
        "certainty",
        "size",
    ];
    let lines = usual.lines().skip(1).map(|line| line[2..12].trim());
    let found: Vec<&str> = lines.filter(|name| !name.is_empty()).collect();
    assert!(
        of_designers.iter().all(|name| found.contains(name)),
        "{usual}"
    );
    assert_eq!(found.last(), Some(&"try"), "{usual}");
    assert!(
        usual.contains("asperity edit 'a gravel.asp' --rougher 20 -o 'a gravel.rougher.asp'"),
        "{usual}"
    );
}

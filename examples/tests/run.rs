//! Every example runs, and prints what it claims.
//!
//! `cargo test -p asperity-examples` builds the examples; with `--test run` alone it does not.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

/// Runs `command`, which must succeed, and returns its output.
fn printed(command: &mut Command) -> String {
    let output = command
        .output()
        .unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let [said, failed] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(output.status.success(), "{command:?}:\n{said}{failed}");
    said.into_owned()
}

/// An example as Cargo built it with this test: `target/PROFILE/examples/NAME`.
fn example(name: &str) -> Command {
    let test = env::current_exe().unwrap();
    let profile = test.parent().and_then(Path::parent).unwrap();
    let program = profile.join("examples").join(name);
    assert!(
        program.exists(),
        "{} is not built: run `cargo test -p asperity-examples`",
        program.display()
    );
    Command::new(program)
}

/// The numbers of the lines that begin with one.
fn table(text: &str) -> Vec<Vec<f64>> {
    let numbers = |line: &str| -> Vec<f64> {
        let words = line.split_whitespace();
        words.map_while(|word| word.parse().ok()).collect()
    };
    let rows = text.lines().map(numbers);
    rows.filter(|row| row.len() > 1).collect()
}

#[test]
fn the_servo_loop_ends_by_itself_and_without_a_force() {
    let said = printed(&mut example("servo_loop"));
    for line in ["grit", "smooth", "sticky", "stale", "end", "missed"] {
        let found = said.lines().any(|text| text.starts_with(line));
        assert!(found, "no {line}:\n{said}");
    }
    // The program checks the forces. When it was woken is up to the machine.
    for row in ["grit      0.72", "smooth    0.30", "sticky    1.10"] {
        assert!(said.contains(row), "no {row:?}:\n{said}");
    }
}

#[test]
fn a_prompt_is_felt_and_louder_the_faster() {
    let said = printed(&mut example("prompt_to_force"));
    let rows = table(&said);
    assert_eq!(rows.len(), 10, "{said}");
    let [slow, fast] = [&rows[2], &rows[9]];
    assert!(fast[1] > 150.0 && slow[1] < 50.0, "speeds:\n{said}");
    assert!(slow[4] > 0.1 && fast[4] > slow[4], "vibration:\n{said}");
    // At one depth the normal force stays, and friction holds against it.
    assert!(rows[2..].iter().all(|row| row[2] == rows[1][2]), "{said}");
    assert!(rows[2..].iter().all(|row| row[3] > 0.5), "{said}");
    assert!(said.contains("1000 ticks, 1 taps"), "{said}");
    assert_eq!(said, printed(&mut example("prompt_to_force")), "other bits");
}

#[test]
fn both_arithmetics_give_the_same_forces_within_the_bound() {
    let said = printed(&mut example("fixed_point"));
    let rows = table(&said);
    assert!(rows.len() >= 10, "{said}");
    for row in &rows[..10] {
        let [_, float_n, fixed_n, apart_mn] = row[..] else {
            panic!("not four columns:\n{said}");
        };
        // Lengths differ by no more than the vectors: √3 of an axis, and the digits printed.
        assert!(
            (float_n - fixed_n).abs() <= 2e-3 * apart_mn + 2e-6,
            "{said}"
        );
    }
    assert!(said.contains("(bound 0.5 mN)"), "{said}");
}

#[test]
fn the_stroke_goes_from_grit_to_cork_at_the_border() {
    let said = printed(&mut example("scene"));
    let lines: Vec<Vec<&str>> = said
        .lines()
        .skip_while(|line| !line.contains("touches"))
        .skip(1)
        .map(|line| line.split_whitespace().collect())
        .collect();
    let touched: Vec<&str> = lines.iter().map(|line| line[2]).collect();
    assert_eq!(touched, ["grit", "cork", "-"], "{said}");
    // The border is at 0; a contact is kept 0.12 mm beyond it, and a tick goes 0.1 mm.
    let crossing_mm: f64 = lines[1][1].parse().unwrap();
    assert!((0.12..=0.22).contains(&crossing_mm), "{said}");
}

/// As `make` builds it, beside the library that Cargo builds for it.
#[test]
fn the_program_in_c_feels_a_texture_and_loses_its_device() {
    if !["make", "cc"].iter().all(|tool| is_there(tool)) {
        println!("SKIPPED: no `make` or no C compiler");
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("example-c");
    let make = |goal: &str| {
        let mut command = Command::new("make");
        command.arg("--directory").arg(home().join("c")).arg(goal);
        command.arg(format!("TARGET={}", folder.display()));
        command.arg("CFLAGS=-Wall -Wextra -Wpedantic -Werror");
        printed(&mut command)
    };
    let said = make("run");
    let rows: Vec<&str> = said
        .lines()
        .filter(|line| line.ends_with("contact"))
        .collect();
    assert_eq!(rows.len(), 9, "{said}");
    let lost = said.lines().find(|line| line.ends_with("safe")).unwrap();
    let force_n = lost.split_whitespace().skip(2).take(2);
    assert!(
        force_n.map(|n| n.parse::<f64>()).all(|n| n == Ok(0.0)),
        "{said}"
    );
    assert!(said.contains("1000 ticks, 1 taps, 1 faults"), "{said}");
}

/// The table of the README has every example with the command that runs it.
#[test]
fn the_readme_has_every_example() {
    let readme = fs::read_to_string(home().join("README.md")).unwrap();
    let mut examples = 0;
    for file in fs::read_dir(home()).unwrap() {
        let path = file.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "rs") {
            let name = path.file_stem().unwrap().to_string_lossy();
            let command = format!("cargo run --release -p asperity-examples --example {name}`");
            assert!(readme.contains(&command), "README.md: no `{command}");
            examples += 1;
        }
    }
    assert_eq!(examples, 4);
    assert!(readme.contains("make -C examples/c run`"));
}

fn home() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn is_there(tool: &str) -> bool {
    Command::new(tool).arg("--version").output().is_ok()
}

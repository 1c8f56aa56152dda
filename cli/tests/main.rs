//! `asperity` as a user meets it: exit status, what errors name, nothing left over.

mod cases;
mod diffusion;
mod effects;
mod grammar;
mod interrupted;
mod library;
mod library_commands;
mod limits;
mod manifest_faults;
mod messages;
mod mixing;
mod models;
mod outputs;
mod pictures;
mod recording;
mod refusals;
mod reports;
mod results;
mod studio;
mod study;

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

/// The shipped model as a folder.
fn write_model(folder: &Path) {
    for (name, bytes) in asperity_model::folder() {
        fs::write(folder.join(name), bytes).expect("a model's file");
    }
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

/// Runs what must succeed.
fn good(folder: &Path, arguments: &[&str]) -> String {
    let output = asperity(folder, arguments);
    assert!(
        output.status.success(),
        "{arguments:?}: {}",
        text(&output.stderr)
    );
    text(&output.stdout)
}

fn bytes(folder: &Path, file: &str) -> Vec<u8> {
    fs::read(folder.join(file)).expect("a file")
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

//! The programs of `tests/c/`, built as a user builds them, with and without the sanitizers,
//! give the same bits as Rust, and a status for every misuse.
// A `cc` that takes these flags, and the sanitizers, are Unix's.
#![cfg(unix)]

use asperity_formats::{Asset, Library};
use asperity_runtime::{Config, HostTexture, Renderer, Sample, State};
use asperity_tests::{
    texture::{Kind, random},
    trajectory::strokes,
};
use std::{
    env, fs,
    io::Write as _,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
    sync::OnceLock,
};

/// Every warning is an error.
const STRICT: [&str; 5] = ["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror"];
const SANITIZED: [&str; 3] = [
    "-fsanitize=address,undefined",
    "-fno-sanitize-recover=all",
    "-g",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

fn folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c-face");
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn succeeded(command: &mut Command) -> Output {
    let output = command
        .output()
        .unwrap_or_else(|error| panic!("{command:?}: {error}; a C compiler is a prerequisite"));
    assert!(
        output.status.success(),
        "{command:?}: {}\n{}{}",
        output.status,
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    );
    output
}

/// The static library, built once.
fn library() -> &'static Path {
    static PATH: OnceLock<PathBuf> = OnceLock::new();
    PATH.get_or_init(|| {
        succeeded(
            Command::new(env!("CARGO"))
                .current_dir(root())
                .args(["build", "--quiet", "--release", "--package", "asperity-c"])
                .arg("--target-dir")
                .arg(folder()),
        );
        folder().join("release/libasperity_c.a")
    })
}

/// Builds a program of `tests/c/`.
fn program(name: &str, flags: &[&str]) -> PathBuf {
    let kind = if flags.is_empty() {
        "plain"
    } else {
        "sanitized"
    };
    let path = folder().join(format!("{name}-{kind}"));
    succeeded(
        Command::new("cc")
            .args(STRICT)
            .args(flags)
            .arg("-I")
            .arg(root().join("runtime/c/include"))
            .arg(root().join("tests/c").join(name).with_extension("c"))
            .arg(library())
            .args(["-lpthread", "-ldl", "-lm", "-o"])
            .arg(&path),
    );
    path
}

/// A library of two textures, as bytes and as a file.
fn shelf() -> (Vec<u8>, PathBuf) {
    let textures = [
        random(1, Kind::nyquist(20)).encode(),
        random(2, Kind::nyquist(4)).encode(),
    ];
    let named = [("cork", &*textures[0]), ("silk", &*textures[1])];
    let mut bytes = vec![0; asperity_formats::library::encoded_len(&named)];
    asperity_formats::library::encode_library(&named, &mut bytes).unwrap();
    let path = folder().join(format!("shelf-{:?}.aspl", std::thread::current().id()));
    fs::write(&path, &bytes).unwrap();
    (bytes, path)
}

/// Strokes with a device that is lost for a while.
fn positions() -> Vec<[f32; 3]> {
    let mut positions = strokes(5, 4000);
    positions[1500..1510].fill([f32::NAN; 3]);
    positions[2500] = [f32::INFINITY, 0.0, 0.0];
    positions
}

/// Bits of the forces that Rust computes.
fn expected(library: &[u8], name: &str) -> Vec<[u32; 3]> {
    let library = Library::parse(library).unwrap();
    let index = library.index().find(name).unwrap();
    let config = Config::default();
    let renderer = Renderer::new(&config).unwrap();
    let mut texture = Box::new(HostTexture::new());
    let asset = Asset::parse(library.bytes(index).unwrap()).unwrap();
    texture.load(&asset, config.servo_rate_hz).unwrap();
    let mut state = State::new(7);
    positions()
        .into_iter()
        .map(|position_m| {
            let output = renderer.tick(&texture, &mut state, &Sample::at(position_m));
            output.force_n.map(f32::to_bits)
        })
        .collect()
}

#[test]
fn the_documented_program_gives_rusts_bits() {
    let (bytes, path) = shelf();
    let trajectory: String = positions()
        .iter()
        .map(|[x, y, z]| format!("{x} {y} {z}\n"))
        .collect();
    for flags in [&[][..], &SANITIZED] {
        let program = program("render", flags);
        for name in ["cork", "silk"] {
            let mut child = Command::new(&program)
                .args([path.as_os_str(), name.as_ref()])
                .stdin(Stdio::piped())
                .stdout(Stdio::piped())
                .spawn()
                .unwrap();
            let mut input = child.stdin.take().unwrap();
            let text = trajectory.clone();
            let writer = std::thread::spawn(move || input.write_all(text.as_bytes()));
            let output = child.wait_with_output().unwrap();
            writer.join().unwrap().unwrap();
            assert!(output.status.success(), "{name}: {}", output.status);
            let found: Vec<[u32; 3]> = String::from_utf8(output.stdout)
                .unwrap()
                .lines()
                .map(|line| {
                    let mut force = line.split(' ').map(|x| x.parse::<f32>().unwrap().to_bits());
                    std::array::from_fn(|_| force.next().unwrap())
                })
                .collect();
            let expected = expected(&bytes, name);
            assert!(found == expected, "{name}, {flags:?}: bits differ");
            assert!(expected.iter().any(|force| *force != [0; 3]));
        }
    }
}

#[test]
fn misuse_is_a_status_and_no_crash() {
    let (_, path) = shelf();
    for flags in [&[][..], &SANITIZED] {
        succeeded(Command::new(program("misuse", flags)).arg(&path));
    }
}

#[test]
fn the_documented_program_refuses_what_it_cannot_load() {
    let (_, path) = shelf();
    let program = program("render", &[]);
    let output = Command::new(program)
        .args([path.as_os_str(), "no such thing".as_ref()])
        .output()
        .unwrap();
    assert!(!output.status.success());
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("the library has no such texture"), "{said}");
}

/// `docs/c.md` shows the program that is tested here.
#[test]
fn the_documentation_shows_the_tested_program() {
    let page = fs::read_to_string(root().join("docs/c.md")).unwrap();
    let program = fs::read_to_string(root().join("tests/c/render.c")).unwrap();
    let shown = page
        .split("```c\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next());
    assert!(
        shown == Some(program.as_str()),
        "docs/c.md: its `c` block must be tests/c/render.c, word for word"
    );
}

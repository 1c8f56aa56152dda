//! The programs of `tests/c/`, built as a user builds them, with and without the sanitizers,
//! give the same bits as Rust, and a status for every misuse.
// A `cc` that takes these flags, and the sanitizers, are Unix's.
#![cfg(unix)]

use crate::support::c::{library, root, succeeded};
use asperity_formats::{
    Asset, Library, SceneSurface, Solid,
    library::{encode_scene, encoded_len},
};
use asperity_runtime::{
    Config, Exchange, Fixed, Float, HostCapacities, HostTexture, Output as Ticked,
    RenderArithmetic, Renderer, Sample, Scene, SceneState, State, Texture,
    quantity::{Quantity, unit::Newton},
};
use asperity_tests::{
    texture::{TextureKind, random},
    trajectory::strokes,
};
use std::{
    collections::{BTreeMap, BTreeSet},
    env, fs,
    io::Write as _,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    sync::{Mutex, OnceLock, PoisonError},
};

/// Every warning is an error.
const STRICT: [&str; 5] = ["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror"];
const SANITIZED: [&str; 3] = [
    "-fsanitize=address,undefined",
    "-fno-sanitize-recover=all",
    "-g",
];

fn folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c-face");
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// The shared library as `bindings/c/Makefile` links it, built once. Its folder.
fn shared() -> &'static Path {
    static PATH: OnceLock<PathBuf> = OnceLock::new();
    PATH.get_or_init(|| {
        let folder = folder().join("shared");
        fs::create_dir_all(&folder).unwrap();
        let map = root().join("bindings/c/asperity.map");
        succeeded(
            Command::new("cc")
                .args(["-shared", "-Wl,-soname,libasperity.so.0"])
                .arg(format!("-Wl,--version-script={}", map.display()))
                .args(["-Wl,--gc-sections", "-Wl,--whole-archive"])
                .arg(library())
                .args([
                    "-Wl,--no-whole-archive",
                    "-lpthread",
                    "-ldl",
                    "-lm",
                    "-lgcc_s",
                ])
                .arg("-o")
                .arg(folder.join("libasperity.so.0")),
        );
        folder
    })
}

/// Builds a program of `tests/c/` against the older header and the shared library of today.
fn program_of_older_header(name: &str) -> PathBuf {
    let path = folder().join(format!("{name}-older"));
    succeeded(
        Command::new("cc")
            .args(STRICT)
            .arg("-I")
            .arg(root().join("tests/c/old"))
            .arg(root().join("tests/c").join(name).with_extension("c"))
            .arg(shared().join("libasperity.so.0"))
            .arg(format!("-Wl,-rpath,{}", shared().display()))
            .args(["-lm", "-o"])
            .arg(&path),
    );
    path
}

/// A program of `tests/c/`, built once.
fn program(name: &str, flags: &[&str]) -> PathBuf {
    static BUILT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    let kind = match flags {
        [] => "plain",
        ["-ffast-math"] => "fast",
        _ => "sanitized",
    };
    let path = folder().join(format!("{name}-{kind}"));
    // Nobody may run a program that is being written.
    let mut built = BUILT.lock().unwrap_or_else(PoisonError::into_inner);
    if !built.contains(&path) {
        succeeded(
            Command::new("cc")
                .args(STRICT)
                .args(flags)
                .arg("-I")
                .arg(root().join("bindings/c/include"))
                .arg(root().join("tests/c").join(name).with_extension("c"))
                .arg(library())
                .args(["-lpthread", "-ldl", "-lm", "-Wl,-z,now", "-o"])
                .arg(&path),
        );
        built.insert(path.clone());
    }
    path
}

/// A library of two textures, as bytes and as a file.
fn shelf() -> (Vec<u8>, PathBuf) {
    let textures = [
        random(1, TextureKind::nyquist(20)).encode(),
        random(2, TextureKind::nyquist(4)).encode(),
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

/// The bits of a force in newtons.
fn bits<A: RenderArithmetic>(output: &Ticked<A>) -> [u32; 3] {
    (output.force_n).map(|force| Quantity::<A, Newton>(force).value().to_bits())
}

fn asset<'a>(library: &Library<'a>, name: &str) -> Asset<'a> {
    let index = library.index().find(name).unwrap();
    Asset::parse(library.bytes(index).unwrap()).unwrap()
}

/// Bits of the forces that Rust computes.
fn expected<A: RenderArithmetic>(library: &[u8], name: &str) -> Vec<[u32; 3]> {
    let config = Config::default();
    let renderer = Renderer::<A>::prepare(&config).unwrap();
    let mut texture = Box::new(Texture::<HostCapacities, A>::new());
    let library = Library::parse(library).unwrap();
    let asset = asset(&library, name);
    texture.load(&asset, config.servo_rate_hz).unwrap();
    let mut state = State::new(7);
    let samples = positions().into_iter().map(Sample::at);
    let tick = |sample| renderer.tick(&texture, &mut state, &Sample::of(&sample));
    samples.map(tick).map(|output| bits(&output)).collect()
}

/// Runs a program on [`positions`] and reads the numbers of each line.
fn lines(program: &Path, arguments: &[&str]) -> Vec<Vec<String>> {
    let mut child = Command::new(program)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    let trajectory: String = positions()
        .iter()
        .map(|[x, y, z]| format!("{x} {y} {z}\n"))
        .collect();
    let writer = std::thread::spawn(move || input.write_all(trajectory.as_bytes()));
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", output.status);
    writer.join().unwrap().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let words = |line: &str| line.split(' ').map(str::to_owned).collect();
    text.lines().map(words).collect()
}

/// The bits of the forces in lines.
fn forces(lines: &[Vec<String>]) -> Vec<[u32; 3]> {
    let force = |line: &Vec<String>| {
        std::array::from_fn(|axis| line[axis].parse::<f32>().unwrap().to_bits())
    };
    lines.iter().map(force).collect()
}

fn assert_same(found: &[[u32; 3]], expected: &[[u32; 3]], what: &str) {
    assert!(found == expected, "{what}: bits differ");
    assert!(expected.iter().any(|force| *force != [0; 3]), "{what}");
}

#[test]
fn the_documented_program_gives_rusts_bits() {
    let (bytes, path) = shelf();
    let path = path.to_str().unwrap();
    for flags in [&[][..], &SANITIZED] {
        let program = program("render", flags);
        for name in ["cork", "silk"] {
            let found = forces(&lines(&program, &[path, name]));
            assert_same(&found, &expected::<Float>(&bytes, name), name);
        }
    }
}

/// GCC and Clang link code into such a program that has denormals flushed and read as zeros.
#[cfg(target_arch = "x86_64")]
#[test]
fn a_program_of_fast_math_gets_the_same_bits() {
    // Fails where the compiler stops doing so, and this test would state nothing.
    let source = folder().join("flushed.c");
    let check = "#include <float.h>\nint main(void) {\n  volatile float least = FLT_MIN;\n  \
                 volatile float half = least * 0.5f;\n  return half != 0.0f;\n}\n";
    fs::write(&source, check).unwrap();
    let flushed = source.with_extension("");
    let mut cc = Command::new("cc");
    succeeded(cc.args(["-ffast-math", "-o"]).args([&flushed, &source]));
    succeeded(&mut Command::new(&flushed));
    let (bytes, path) = shelf();
    let program = program("render", &["-ffast-math"]);
    for name in ["cork", "silk"] {
        let found = forces(&lines(&program, &[path.to_str().unwrap(), name]));
        assert_same(&found, &expected::<Float>(&bytes, name), name);
    }
}

#[test]
fn every_capacity_and_arithmetic_gives_rusts_bits() {
    let (bytes, path) = shelf();
    let path = path.to_str().unwrap();
    for flags in [&[][..], &SANITIZED] {
        let program = program("parity", flags);
        for (way, name) in [("float", "cork"), ("medium", "cork"), ("small", "silk")] {
            let found = forces(&lines(&program, &[way, path, name]));
            assert_same(&found, &expected::<Float>(&bytes, name), way);
        }
        let found = forces(&lines(&program, &["fixed", path, "cork"]));
        assert_same(&found, &expected::<Fixed>(&bytes, "cork"), "fixed");
        assert!(found != expected::<Float>(&bytes, "cork"));
    }
}

#[test]
fn an_exchange_gives_rusts_bits() {
    let (bytes, path) = shelf();
    let config = Config::default();
    let renderer = Renderer::new(&config).unwrap();
    let library = Library::parse(&bytes).unwrap();
    let mut slots = [(); 3].map(|()| Box::new(HostTexture::new()));
    let [playing, spare, other] = &mut slots;
    let mut exchange = Exchange::new();
    let (mut preparer, mut player) = exchange.split(playing, [spare, other], 7);
    let mut load = |name| {
        let asset = asset(&library, name);
        preparer.prepare(&asset, config.servo_rate_hz).unwrap();
    };
    load("cork");
    let mut expected = Vec::new();
    for (tick, position_m) in positions().into_iter().enumerate() {
        if tick == 1000 {
            load("silk");
        }
        expected.push(bits(
            &renderer.tick_player(&mut player, &Sample::at(position_m)),
        ));
    }
    let arguments = ["exchange", path.to_str().unwrap(), "cork", "silk"];
    for flags in [&[][..], &SANITIZED] {
        let found = forces(&lines(&program("parity", flags), &arguments));
        assert_same(&found, &expected, "exchange");
    }
}

/// Surfaces in contact and bits of the forces in a scene, as Rust computes them.
fn expected_in_scene<A: RenderArithmetic>(bytes: &[u8]) -> (Vec<Option<usize>>, Vec<[u32; 3]>) {
    let library = Library::parse(bytes).unwrap();
    let config = Config::default();
    let renderer = Renderer::<A>::prepare(&config).unwrap();
    let mut slots: Vec<_> = (0..library.index().len())
        .map(|_| Texture::<HostCapacities, A>::new())
        .collect();
    let scene = Scene::<64, _, A>::load(&library, &config, &mut slots).unwrap();
    let mut state = SceneState::new(7);
    let samples = positions().into_iter().map(Sample::at);
    let tick = |sample| {
        let output = renderer.tick_scene(&scene, &mut state, &Sample::of(&sample));
        (state.touched(), bits(&output))
    };
    samples.map(tick).unzip()
}

/// A library of both textures, side by side on planes that meet at x = 0.
fn patches() -> (Vec<u8>, PathBuf) {
    let textures = [
        random(1, TextureKind::nyquist(20)).encode(),
        random(2, TextureKind::nyquist(4)).encode(),
    ];
    let named = [("cork", &*textures[0]), ("silk", &*textures[1])];
    let half = |from: f32, to: f32, texture| SceneSurface {
        solid: Solid::Plane {
            point_m: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
        },
        from_m: [from, -1.0, -1.0],
        to_m: [to, 1.0, 1.0],
        texture,
    };
    let surfaces = [half(-1.0, 0.0, 0), half(0.0, 1.0, 1)];
    let room = encoded_len(&named) + asperity_formats::scene::encoded_len(surfaces.len());
    let mut bytes = vec![0; room];
    let len = encode_scene(&named, &surfaces, &mut bytes).unwrap();
    bytes.truncate(len);
    let path = folder().join(format!("patches-{:?}.aspl", std::thread::current().id()));
    fs::write(&path, &bytes).unwrap();
    (bytes, path)
}

#[test]
fn a_scene_gives_rusts_bits() {
    let (bytes, path) = patches();
    let path = path.to_str().unwrap();
    for (way, (surfaces, expected)) in [
        ("scene", expected_in_scene::<Float>(&bytes)),
        ("scene-fixed", expected_in_scene::<Fixed>(&bytes)),
    ] {
        for flags in [&[][..], &SANITIZED] {
            let lines = lines(&program("parity", flags), &[way, path]);
            assert_same(&forces(&lines), &expected, way);
            let surface = |line: &Vec<String>| line[4].parse::<u32>().unwrap();
            let found: Vec<_> = lines.iter().map(surface).collect();
            let surfaces: Vec<_> = (surfaces.iter())
                .map(|surface| surface.map_or(u32::MAX, |index| index as u32))
                .collect();
            assert_eq!(found, surfaces);
            assert!(
                [0, 1, u32::MAX]
                    .iter()
                    .all(|surface| found.contains(surface))
            );
        }
    }
}

#[test]
fn a_servo_loop_plays_while_other_threads_load_and_record() {
    let (_, path) = shelf();
    for flags in [&[][..], &SANITIZED] {
        succeeded(Command::new(program("threads", flags)).arg(&path));
    }
}

#[test]
fn a_program_of_an_older_header_runs_with_this_library() {
    let (bytes, path) = shelf();
    let output = succeeded(Command::new(program_of_older_header("older")).arg(&path));
    let sizes = String::from_utf8(output.stdout).unwrap();
    let sizes: Vec<usize> = sizes
        .split_whitespace()
        .map(|n| n.parse().unwrap())
        .collect();
    // If no struct had grown, the test would show nothing.
    let header = fs::read_to_string(root().join("bindings/c/include/asperity.h")).unwrap();
    assert!(header.contains("uint32_t arithmetic;") && header.contains("uint32_t surface;"));
    assert_eq!(sizes, [124, 44]);

    let program = program_of_older_header("render");
    let found = forces(&lines(&program, &[path.to_str().unwrap(), "cork"]));
    assert_same(&found, &expected::<Float>(&bytes, "cork"), "older header");
}

/// Every function of the header.
fn functions(header: &str) -> Vec<&str> {
    let words = header.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '('));
    let mut found: Vec<_> = words
        .filter_map(|word| word.split_once('('))
        .map(|(name, _)| name)
        .filter(|name| name.starts_with("asperity_"))
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}

#[test]
fn the_shared_library_exports_the_functions_of_the_header_with_their_version() {
    let header = fs::read_to_string(root().join("bindings/c/include/asperity.h")).unwrap();
    let symbols = succeeded(
        Command::new("nm")
            .args(["--dynamic", "--defined-only", "--with-symbol-versions"])
            .arg(shared().join("libasperity.so.0")),
    );
    let symbols = String::from_utf8(symbols.stdout).unwrap();
    let mut exported: Vec<_> = symbols
        .lines()
        .filter_map(|line| line.split(' ').nth(2))
        .filter(|symbol| *symbol != "ASPERITY_0.1")
        .collect();
    exported.sort_unstable();
    let expected: Vec<_> = (functions(&header).into_iter())
        .map(|name| format!("{name}@@ASPERITY_0.1"))
        .collect();
    assert!(expected.len() > 30);
    assert_eq!(exported, expected);
}

/// The most stack that a call may take on x86-64, bytes.
const STACK_LIMIT: usize = 3072;

/// Measured, as `docs/c.md` has it, in the optimised library.
#[test]
#[cfg(target_arch = "x86_64")]
fn no_call_takes_more_stack_than_documented() {
    let (_, library) = shelf();
    let (_, scene) = patches();
    let output = succeeded(
        Command::new(program("stack", &[]))
            .arg(root().join("tests/tests/assets/builtin-v1.asp"))
            .args([library, scene]),
    );
    let mut most = BTreeMap::new();
    let text = String::from_utf8(output.stdout).unwrap();
    for line in text.lines() {
        let (name, bytes) = line.split_once(' ').unwrap();
        let bytes: usize = bytes.parse().unwrap();
        let entry = most.entry(name).or_insert(0);
        *entry = bytes.max(*entry);
    }
    for (function, bytes) in &most {
        println!("{function:34} {bytes:5}");
        assert!(*bytes <= STACK_LIMIT, "{function}: {bytes} bytes");
    }
    let header = fs::read_to_string(root().join("bindings/c/include/asperity.h")).unwrap();
    assert!(
        most.keys().copied().eq(functions(&header)),
        "a call is not measured"
    );
    // The painted stack shows something.
    assert!(most["asperity_tick"] > 100);
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

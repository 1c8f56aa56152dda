//! The images that `asperity export` writes as source text are compiled as a user compiles them, and
//! loaded where they lie: C by the C library, Rust by the crates.
// A `cc` that takes these flags is Unix's.
#![cfg(unix)]

use crate::support::{
    self, c,
    c::{root, succeeded},
};
use asperity::emit::pack::{NamedAsset, encode, encode_scene};
use asperity::interchange::{Language, SourceOptions, export_source};
use asperity_formats::{SceneSurface, Solid, library};
use std::{
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("export")
        .join(name);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// A library of the built-in texture.
fn packed() -> Vec<u8> {
    let asset = support::builtin();
    let named = [("grit", &asset[..])];
    let mut bytes = vec![0; library::encoded_len(&named)];
    let len = library::encode_library(&named, &mut bytes).unwrap();
    bytes.truncate(len);
    bytes
}

const C_PROGRAM: &str = r#"
INCLUDES#include <asperity.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

static ASPERITY_ALIGNED unsigned char renderer_memory[ASPERITY_RENDERER_SIZE];
static ASPERITY_ALIGNED unsigned char texture_memory[ASPERITY_TEXTURE_SIZE_LARGE];

int main(void) {
    struct AsperityConfig config;
    struct AsperityRenderer *renderer;
    struct AsperityTexture *texture;
    if ((uintptr_t)asperity_image_tick % 8 != 0 || (uintptr_t)hall % 8 != 0) return 2;
    if (asperity_config_default(&config, sizeof config)) return 3;
    if (asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config, &renderer, NULL)) return 4;
    if (asperity_texture_init(texture_memory, sizeof texture_memory, renderer,
                              ASPERITY_CAPACITY_LARGE, &texture)) return 5;
    if (asperity_texture_load_asset(texture, asperity_image_tick, ASPERITY_IMAGE_TICK_SIZE, NULL)) return 6;
    if (asperity_texture_load_name(texture, hall, HALL_SIZE, "grit", NULL)) return 7;
SIZES    puts("loaded");
    return 0;
}
"#;

#[test]
fn a_c_array_is_compiled_without_a_warning_and_loaded_in_place() {
    let folder = folder("c");
    let library = packed();
    let grit = support::builtin();
    // Names of the C face, names without a letter of ASCII, and one that would end the comment.
    let exported = [
        ("tick", "tick", &grit, None),
        ("State", "State", &grit, None),
        ("木", "tree", &grit, None),
        ("林", "wood", &grit, None),
        ("*/ \\ ??/", "odd", &grit, None),
        ("hall", "hall", &library, Some("hall")),
    ];
    let mut sources = Vec::new();
    let mut symbols = Vec::new();
    for (name, file, bytes, symbol) in exported {
        let header = format!("{file}.h");
        let options = SourceOptions {
            header: Some(&header),
            symbol,
            keep_preview: false,
        };
        let written = export_source(Language::C, name, bytes, &options).unwrap();
        fs::write(folder.join(&header), written.header.unwrap()).unwrap();
        let source_file = folder.join(format!("{file}.c"));
        fs::write(&source_file, written.text).unwrap();
        sources.push(source_file);
        symbols.push(written.symbol);
    }
    let includes: String = exported
        .iter()
        .map(|(_, file, ..)| format!("#include \"{file}.h\"\n"))
        .collect();
    let sizes: String = symbols
        .iter()
        .map(|symbol| format!("    if (sizeof {symbol} < 1000) return 8;\n"))
        .collect();
    let program = C_PROGRAM
        .replace("INCLUDES", &includes)
        .replace("SIZES", &sizes);
    fs::write(folder.join("main.c"), program).unwrap();
    let program = folder.join("program");
    for standard in ["-std=c99", "-std=c11"] {
        // The alignment of C99 is an attribute, which `-pedantic` lets pass.
        succeeded(
            Command::new("cc")
                .args([standard, "-Wall", "-Wextra", "-pedantic", "-Werror", "-I"])
                .arg(root().join("bindings/c/include"))
                .arg("-I")
                .arg(&folder)
                .arg(folder.join("main.c"))
                .args(&sources)
                .arg(c::library())
                .args(["-lpthread", "-ldl", "-lm", "-o"])
                .arg(&program),
        );
        let output = succeeded(&mut Command::new(&program));
        assert_eq!(output.stdout, b"loaded\n");
    }
}

#[test]
fn a_c_array_without_a_header_stands_alone() {
    let folder = folder("alone");
    let written = |header| {
        let options = SourceOptions {
            header,
            ..SourceOptions::default()
        };
        export_source(Language::C, "grit", &support::builtin(), &options).unwrap()
    };
    let alone = written(None);
    assert!(alone.header.is_none());
    // `#include` knows no escapes, so a header that it cannot name is not included.
    for header in ["a\"b.h", "a\\b.h", "a\nb.h", "a??/b.h"] {
        let odd = written(Some(header));
        assert_eq!(odd.text, alone.text, "{header:?}");
        assert!(odd.header.is_some());
    }
    assert_ne!(written(Some("a b – ä.h")).text, alone.text);
    let file = folder.join("grit.c");
    fs::write(&file, alone.text).unwrap();
    succeeded(
        Command::new("cc")
            .args(["-std=c11", "-Wall", "-Wextra", "-pedantic", "-Werror", "-c"])
            .arg(&file)
            .arg("-o")
            .arg(folder.join("grit.o")),
    );
}

#[test]
fn a_rust_static_is_aligned_and_holds_the_bytes() {
    let folder = folder("rust");
    let bytes = support::builtin();
    let written =
        |name| export_source(Language::Rust, name, &bytes, &SourceOptions::default()).unwrap();
    // Two in one module do not collide.
    let mut source = written("grit").text;
    source.extend(written("text \u{202e} with\ncontrols").text);
    fs::write(folder.join("grit.rs"), source).unwrap();
    let program = "#[allow(dead_code)]\nmod grit;\nuse std::io::Write;\nfn main() {\n    \
        let image: &[u8] = grit::ASPERITY_IMAGE_GRIT;\n    \
        assert_eq!(image.as_ptr() as usize % 8, 0);\n    \
        std::io::stdout().write_all(image).unwrap();\n}\n";
    fs::write(folder.join("main.rs"), program).unwrap();
    let output = folder.join("program");
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    succeeded(
        Command::new(rustc)
            .args(["--edition", "2021", "-D", "warnings"])
            .arg(folder.join("main.rs"))
            .arg("-o")
            .arg(&output),
    );
    let printed = succeeded(&mut Command::new(&output)).stdout;
    assert_eq!(printed, bytes);
    asperity_formats::Asset::parse(&printed).unwrap();
}

/// Claim: no name of the C face begins as the symbols of images do, so no image collides with it.
#[test]
fn the_names_of_images_are_theirs_alone() {
    let include = root().join("bindings/c/include");
    for header in ["asperity.h", "asperity.hpp", "asperity_base.hpp"] {
        let text = fs::read_to_string(include.join(header)).unwrap();
        assert!(
            text.len() > 1000 && !text.to_lowercase().contains("asperity_image"),
            "{header}"
        );
    }
}

/// Claim: without --keep-preview, an image is the asset or library without its pictures, and a scene stays one.
#[test]
fn pictures_stay_out_of_images() {
    let plain = support::builtin();
    let png = b"\x89PNG\r\n\x1a\n and pixels";
    let pictured = asperity::emit::lower::lower(&asperity::sources::builtin::texture(), Some(png))
        .unwrap()
        .bytes;
    let library_of = |asset: &[u8], surfaces: &[SceneSurface]| {
        let named = [NamedAsset {
            name: "grit",
            bytes: asset,
        }];
        if surfaces.is_empty() {
            encode(&named).unwrap()
        } else {
            encode_scene(&named, surfaces).unwrap()
        }
    };
    let surface = SceneSurface {
        solid: Solid::Sphere {
            center_m: [0.0; 3],
            radius_m: 0.05,
        },
        from_m: [-0.1; 3],
        to_m: [0.1; 3],
        texture: 0,
    };
    for (with, without) in [
        (pictured.clone(), plain.clone()),
        (library_of(&pictured, &[]), library_of(&plain, &[])),
        (
            library_of(&pictured, &[surface]),
            library_of(&plain, &[surface]),
        ),
    ] {
        let image_of = |bytes: &[u8], keep_preview| {
            let options = SourceOptions {
                keep_preview,
                ..SourceOptions::default()
            };
            let written = export_source(Language::C, "grit", bytes, &options).unwrap();
            let text = String::from_utf8(written.text).unwrap();
            let (_, data) = text.split_once("= {").unwrap();
            let numbers = data
                .split([',', '}', ';'])
                .map(str::trim)
                .filter(|number| !number.is_empty());
            let image: Vec<u8> = numbers.map(|number| number.parse().unwrap()).collect();
            assert_eq!(image.len(), written.image_len);
            image
        };
        assert!(with.len() > without.len());
        assert_eq!(image_of(&with, false), without);
        assert_eq!(image_of(&with, true), with);
    }
    assert!(export_source(Language::C, "grit", &plain[1..], &SourceOptions::default()).is_err());
}

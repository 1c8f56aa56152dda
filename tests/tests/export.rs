//! The images that `asperity export` writes as source text are compiled as a user compiles them, and
//! loaded where they lie: C by the C library, Rust by the crates.
// A `cc` that takes these flags is Unix's.
#![cfg(unix)]

use crate::support::{
    self, c,
    c::{root, succeeded},
};
use asperity::interchange::{Language, export_bytes};
use asperity_formats::library;
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
#include "grit.h"
#include "hall.h"
#include <asperity.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

static ASPERITY_ALIGNED unsigned char renderer_memory[ASPERITY_RENDERER_SIZE];
static ASPERITY_ALIGNED unsigned char texture_memory[ASPERITY_TEXTURE_SIZE_LARGE];

int main(void) {
    struct AsperityConfig config;
    struct AsperityRenderer *renderer;
    struct AsperityTexture *texture;
    if ((uintptr_t)asperity_grit % 8 != 0 || (uintptr_t)asperity_hall % 8 != 0) return 2;
    if (asperity_config_default(&config, sizeof config)) return 3;
    if (asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config, &renderer, NULL)) return 4;
    if (asperity_texture_init(texture_memory, sizeof texture_memory, renderer,
                              ASPERITY_CAPACITY_LARGE, &texture)) return 5;
    if (asperity_texture_load_asset(texture, asperity_grit, ASPERITY_GRIT_SIZE, NULL)) return 6;
    if (asperity_texture_load_name(texture, asperity_hall, ASPERITY_HALL_SIZE, "grit", NULL)) return 7;
    puts("loaded");
    return 0;
}
"#;

#[test]
fn a_c_array_is_compiled_without_a_warning_and_loaded_in_place() {
    let folder = folder("c");
    let library = packed();
    let mut sources = Vec::new();
    for (name, bytes) in [("grit", support::builtin()), ("hall", library)] {
        let header = format!("{name}.h");
        let about = [format!("{name} */ \\ ??/")];
        let (source, declarations) = export_bytes(Language::C, name, &about, &bytes, Some(&header));
        fs::write(folder.join(&header), declarations.unwrap()).unwrap();
        let source_file = folder.join(format!("{name}.c"));
        fs::write(&source_file, source).unwrap();
        sources.push(source_file);
    }
    fs::write(folder.join("main.c"), C_PROGRAM).unwrap();
    let program = folder.join("program");
    for standard in ["-std=c99", "-std=c11"] {
        // The alignment of C99 is an attribute, which `-pedantic` lets pass.
        succeeded(
            Command::new("cc")
                .args([standard, "-Wall", "-Wextra", "-pedantic", "-Werror", "-I"])
                .arg(root().join("runtime/c/include"))
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
    let (source, header) = export_bytes(Language::C, "grit", &[], &[1, 2, 3], None);
    assert!(header.is_none());
    let file = folder.join("grit.c");
    fs::write(&file, source).unwrap();
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
    let about = ["text \u{202e} with\ncontrols".to_owned()];
    let (source, _) = export_bytes(Language::Rust, "grit", &about, &bytes, None);
    fs::write(folder.join("grit.rs"), source).unwrap();
    let program = "mod grit;\nuse std::io::Write;\nfn main() {\n    \
        let image: &[u8] = grit::ASPERITY_GRIT;\n    \
        assert_eq!(image.as_ptr() as usize % 8, 0);\n    \
        assert_eq!(image.len(), grit::ASPERITY_GRIT_IMAGE.0.len());\n    \
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

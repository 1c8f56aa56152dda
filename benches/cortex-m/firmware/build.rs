//! Puts the memory map of the emulated machine where the linker script looks for it.

use std::{env, fs, path::PathBuf};

fn main() {
    let target = env::var("TARGET").unwrap_or_default();
    let map = if target.starts_with("thumbv6m") {
        "microbit.x"
    } else {
        "mps2.x"
    };
    let source = PathBuf::from("memory").join(map);
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    fs::copy(&source, out.join("memory.x")).expect("the memory map");
    println!("cargo:rerun-if-changed={}", source.display());
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
}

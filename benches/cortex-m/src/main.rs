//! Builds the firmware of every case, runs it in QEMU, and says what a tick costs and
//! whether its bits are the host's. Fails on a difference, a reachable panic or a limit.
//!
//! ```console
//! $ cargo run --release --manifest-path benches/cortex-m/Cargo.toml            # Cortex-M4F
//! $ cargo run --release --manifest-path benches/cortex-m/Cargo.toml -- --target thumbv7m-none-eabi
//! $ cargo run --release --manifest-path benches/cortex-m/Cargo.toml -- library # *.aspl
//! $ cargo run --release --manifest-path benches/cortex-m/Cargo.toml -- costs   # of asperity build
//! ```
#![forbid(unsafe_code)]

mod calls;
mod costs;
mod elf;
mod emulate;
mod library;
mod limits;
mod measure;
mod report;
mod target;
mod thumb;
mod toolchain;

use std::{
    path::{Path, PathBuf},
    process::ExitCode,
};

/// What any step can fail with; the text says what to do about it.
type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

const USAGE: &str =
    "usage: cortex-m [--target TRIPLE] [--build-core] | cortex-m costs | cortex-m library
  --target TRIPLE  thumbv7em-none-eabihf (default), thumbv7m-none-eabi or thumbv6m-none-eabi
  --build-core     build core from the sources of /usr/bin/rustc even where the target is installed
  costs            print the cost model of `asperity build`, for compiler/src/scene/cost.rs
  library          write textures.aspl and costs.aspl, which the firmware embeds";

/// This package's folder.
fn home() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Where everything is built.
fn target_dir() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| home().join("target"), PathBuf::from)
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let (mut triple, mut build_core) = (String::from("thumbv7em-none-eabihf"), false);
    while let Some(argument) = arguments.next() {
        match (argument.as_str(), arguments.len()) {
            ("library", 0) => return exit(library::write(home())),
            ("costs", 0) => return exit(costs(build_core)),
            ("--target", 1..) => triple = arguments.next().unwrap_or_default(),
            ("--build-core", _) => build_core = true,
            _ => {
                eprintln!("{USAGE}");
                return ExitCode::from(2);
            }
        }
    }
    exit(run(&triple, build_core))
}

fn exit(result: Result<()>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("cortex-m: {error}");
            ExitCode::FAILURE
        }
    }
}

fn costs(build_core: bool) -> Result<()> {
    let target = target::find("thumbv7em-none-eabihf")?;
    costs::print(target, &toolchain::Toolchain::find(target, build_core)?)
}

fn run(triple: &str, build_core: bool) -> Result<()> {
    let target = target::find(triple)?;
    let limits = limits::read(&home().join("limits.toml"), target)?;
    let toolchain = toolchain::Toolchain::find(target, build_core)?;
    let measured = measure::all(target, &toolchain)?;
    report::print(target, &measured);
    let mut faults = measure::differences(&measured);
    faults.extend(limits::exceeded(&limits, &measured));
    faults.extend(measure::search_for_panics_works(target, &toolchain)?);
    if faults.is_empty() {
        println!(
            "\nbits equal on target and host (debug and release), no panic reachable, within limits"
        );
        Ok(())
    } else {
        Err(faults.join("\ncortex-m: ").into())
    }
}

//! Cargo for another machine: with the standard library that is installed for it, or with
//! `core` built from the sources that a distribution ships.

use asperity_machines::command::{Result, stdout, target_dir};
use std::{
    path::{Path, PathBuf},
    process::Command,
};

/// Debian's compiler.
const DISTRIBUTION_RUSTC: &str = "/usr/bin/rustc";
/// The sources of its standard library.
const DISTRIBUTION_SOURCES: &str = "/usr/lib/rustlib/src";

/// Build product of the session.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Product {
    /// A program, with the standard library, linked by this.
    Program { linker: &'static str },
    /// A WebAssembly module, with `core` alone.
    Module,
}

/// Cargo's toolchain and target.
#[derive(Debug)]
pub(crate) struct Toolchain {
    triple: &'static str,
    compiler: Compiler,
}

#[derive(Debug)]
enum Compiler {
    /// The one that built this program.
    Usual,
    /// Debian's, which has a standard library for the machine.
    Distribution,
    /// Debian's, which builds `core`; linked by this.
    Core(PathBuf),
}

impl Toolchain {
    /// Looks for what is installed.
    pub(crate) fn find(triple: &'static str) -> Result<Self> {
        let compiler = if has_library("rustc", triple) {
            Compiler::Usual
        } else if has_library(DISTRIBUTION_RUSTC, triple) {
            Compiler::Distribution
        } else {
            Compiler::Core(linker_of_core(triple)?)
        };
        Ok(Self { triple, compiler })
    }

    /// Builds the session and returns its path.
    pub(crate) fn build(&self, product: Product, rustflags: &str) -> Result<PathBuf> {
        let folder = target_dir();
        let variable = |of: &str| {
            let triple = self.triple.to_uppercase().replace('-', "_");
            format!("CARGO_TARGET_{triple}_{of}")
        };
        let mut cargo = Command::new("cargo");
        cargo
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .args(["rustc", "--quiet", "--release", "--locked"])
            .args(["--target", self.triple, "--target-dir"])
            .arg(&folder)
            .args(match product {
                Product::Program { .. } => ["--bin", "session"].as_slice(),
                Product::Module => &["--lib", "--crate-type", "cdylib"],
            })
            // It would hide the options of the machine.
            .env_remove("RUSTFLAGS")
            .env(variable("RUSTFLAGS"), rustflags);
        if let Product::Program { linker } = product {
            cargo.env(variable("LINKER"), linker);
        }
        match &self.compiler {
            Compiler::Usual => &mut cargo,
            Compiler::Distribution => cargo.env("RUSTC", DISTRIBUTION_RUSTC),
            Compiler::Core(linker) => cargo
                .arg("-Zbuild-std=core")
                .env("RUSTC", DISTRIBUTION_RUSTC)
                .env("RUSTC_BOOTSTRAP", "1")
                .env(variable("LINKER"), linker),
        };
        stdout(&mut cargo)?;
        let name = match product {
            Product::Program { .. } => "session",
            Product::Module => "asperity_machines.wasm",
        };
        Ok(folder.join(self.triple).join("release").join(name))
    }
}

/// Returns true if a compiler has a standard library for the machine.
fn has_library(rustc: &str, triple: &str) -> bool {
    let libdir = stdout(Command::new(rustc).args(["--print", "target-libdir", "--target", triple]));
    libdir.is_ok_and(|libdir| Path::new(libdir.trim()).is_dir())
}

/// The linker of this toolchain, where Debian's compiler can build `core` for a module.
fn linker_of_core(triple: &str) -> Result<PathBuf> {
    let wasm = triple.starts_with("wasm32");
    let sources =
        Path::new(DISTRIBUTION_RUSTC).exists() && Path::new(DISTRIBUTION_SOURCES).exists();
    let libdir = stdout(Command::new("rustc").args(["--print", "target-libdir"]))?;
    let linker = Path::new(libdir.trim()).with_file_name("bin/rust-lld");
    if wasm && sources && linker.exists() {
        return Ok(linker);
    }
    let packages = if wasm {
        "rustc-web and rust-web-src beside a rustup toolchain"
    } else {
        "rustc-web and libstd-rust-web-dev:arm64"
    };
    Err(format!(
        "no library for {triple}: `rustup target add {triple}`, or Debian's packages {packages}"
    )
    .into())
}

//! The machines, and what runs a program of theirs on this one.

use crate::toolchain::{Product, Toolchain};
use asperity_machines::command::{Result, stdout};
use std::{path::Path, process::Command};

/// A machine that this one emulates.
#[derive(Debug)]
pub(crate) struct Machine {
    pub(crate) name: &'static str,
    triple: &'static str,
    /// Options of the compiler.
    rustflags: &'static str,
    product: Product,
    /// Runs what was built; its path follows.
    runner: &'static [&'static str],
    /// Arguments of the program.
    arguments: &'static [&'static str],
}

/// Next to this file's package.
const SESSION_MJS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/session.mjs");

const MACHINES: [Machine; 4] = [
    Machine {
        name: "aarch64 with NEON, in qemu-aarch64",
        triple: "aarch64-unknown-linux-gnu",
        // The emulator then needs no libraries of the machine.
        rustflags: "-Ctarget-feature=+crt-static",
        product: Product::Program {
            linker: "aarch64-linux-gnu-gcc",
        },
        runner: &["qemu-aarch64"],
        arguments: &[],
    },
    Machine {
        name: "the same, with denormals flushed to zero",
        triple: "aarch64-unknown-linux-gnu",
        rustflags: "-Ctarget-feature=+crt-static",
        product: Product::Program {
            linker: "aarch64-linux-gnu-gcc",
        },
        runner: &["qemu-aarch64"],
        arguments: &["flush"],
    },
    Machine {
        name: "wasm32, in Node",
        triple: "wasm32-unknown-unknown",
        rustflags: "",
        product: Product::Module,
        runner: &["node", SESSION_MJS],
        arguments: &[],
    },
    Machine {
        name: "wasm32 with simd128, in Node",
        triple: "wasm32-unknown-unknown",
        rustflags: "-Ctarget-feature=+simd128",
        product: Product::Module,
        runner: &["node", SESSION_MJS],
        arguments: &[],
    },
];

/// The machines of a triple, or all of them.
pub(crate) fn find(triple: Option<&str>) -> Result<Vec<&'static Machine>> {
    let found: Vec<_> = MACHINES
        .iter()
        .filter(|machine| triple.is_none_or(|triple| triple == machine.triple))
        .collect();
    if found.is_empty() {
        let known = "aarch64-unknown-linux-gnu, wasm32-unknown-unknown";
        return Err(format!("--target {}: known are {known}", triple.unwrap_or_default()).into());
    }
    Ok(found)
}

impl Machine {
    /// Builds the session, runs it there, and returns what it printed.
    pub(crate) fn session(&self) -> Result<String> {
        let built = Toolchain::find(self.triple)?.build(self.product, self.rustflags)?;
        self.run(&built)
    }

    fn run(&self, built: &Path) -> Result<String> {
        let (program, arguments) = self.runner.split_first().ok_or("no runner")?;
        stdout(
            Command::new(program)
                .args(arguments)
                .arg(built)
                .args(self.arguments),
        )
    }
}

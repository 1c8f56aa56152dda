//! Builds the firmware of every case, runs it in QEMU, and prints what a tick costs. Fails if
//! its bits are not the host's, if the tick can reach a panic, or if a limit is exceeded.
//!
//! ```console
//! $ cargo run --release -p asperity-cortex-m            # Cortex-M4F
//! $ cargo run --release -p asperity-cortex-m -- --target thumbv7m-none-eabi
//! $ cargo run --release -p asperity-cortex-m -- library # *.aspl
//! $ cargo run --release -p asperity-cortex-m -- stack   # of the C face
//! $ cargo run --release -p asperity-cortex-m -- costs   # of asperity build
//! $ cargo run --release -p asperity-cortex-m -- designs # of the experiments
//! ```
#![forbid(unsafe_code)]

mod calls;
mod costs;
mod designs;
mod elf;
mod emulate;
mod library;
mod limits;
mod measure;
mod package;
mod report;
mod stack;
mod target;
mod thumb;
mod toolchain;

use asperity_kernels::workload::Orders;
use asperity_tests::figures;
use package::{Result, home};
use std::process::ExitCode;

const USAGE: &str =
    "usage: cortex-m [--target TRIPLE] [--build-core] | cortex-m costs | cortex-m library
       cortex-m stack [--target TRIPLE]
       cortex-m designs [--poles N] [--zeros N]
  --target TRIPLE  thumbv7em-none-eabihf (default), thumbv7m-none-eabi or thumbv6m-none-eabi
  --build-core     build core from the sources of /usr/bin/rustc even where the target is installed
  costs            print the cost model of `asperity build`, for compiler/src/scene/counted.rs
  designs          print what every design of `asperity-lab pareto` costs, for its --cortex-m;
                   of textures with so many poles and zeros (20, 18: most of the HaTT)
  stack            print and limit the stack of every call of the C face
  library          write textures.aspl and costs.aspl, which the session embeds";

/// Command-line arguments.
struct Arguments {
    command: String,
    triple: String,
    build_core: bool,
    orders: Orders,
}

impl Arguments {
    fn parse(mut words: impl Iterator<Item = String>) -> Option<Self> {
        let mut arguments = Self {
            command: String::from("session"),
            triple: String::from("thumbv7em-none-eabihf"),
            build_core: false,
            orders: Orders {
                poles: 20,
                zeros: 18,
                nyquist: false,
            },
        };
        while let Some(word) = words.next() {
            match word.as_str() {
                "library" | "costs" | "designs" | "stack" => arguments.command = word,
                "--target" => arguments.triple = words.next()?,
                "--build-core" => arguments.build_core = true,
                "--poles" => arguments.orders.poles = words.next()?.parse().ok()?,
                "--zeros" => arguments.orders.zeros = words.next()?.parse().ok()?,
                _ => return None,
            }
        }
        Some(arguments)
    }
}

fn main() -> ExitCode {
    let Some(arguments) = Arguments::parse(std::env::args().skip(1)) else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    exit(match arguments.command.as_str() {
        "library" => library::write(&home().join("../session")),
        "costs" => costs(arguments.build_core),
        "designs" => designs(&arguments),
        "stack" => stack(&arguments),
        _ => run(&arguments.triple, arguments.build_core),
    })
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

fn designs(arguments: &Arguments) -> Result<()> {
    let target = target::find(&arguments.triple)?;
    let toolchain = toolchain::Toolchain::find(target, arguments.build_core)?;
    designs::print(target, &toolchain, arguments.orders)
}

fn stack(arguments: &Arguments) -> Result<()> {
    let target = target::find(&arguments.triple)?;
    stack::print(
        target,
        &toolchain::Toolchain::find(target, arguments.build_core)?,
    )
}

fn run(triple: &str, build_core: bool) -> Result<()> {
    let target = target::find(triple)?;
    let limits = limits::read(&home().join("limits.toml"), target)?;
    let toolchain = toolchain::Toolchain::find(target, build_core)?;
    let measured = measure::all(target, &toolchain)?;
    report::print(target, &measured);
    if let Some((name, set)) = report::figures(target, &measured) {
        figures::keep(name, &set)?;
    }
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

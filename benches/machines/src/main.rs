//! Builds the session for machines that a desktop emulates, runs it there, and compares the
//! hashes with this machine's. Fails on the first difference of each.
//!
//! ```console
//! $ cargo run --release -p asperity-machines                                       # all of them
//! $ cargo run --release -p asperity-machines -- --target aarch64-unknown-linux-gnu
//! $ cargo run --release -p asperity-machines -- --target wasm32-unknown-unknown
//! ```
#![forbid(unsafe_code)]

mod compare;
mod machine;
mod toolchain;

use asperity_machines::command::Result;
use std::process::ExitCode;

const USAGE: &str = "usage: machines [--target TRIPLE]
  --target TRIPLE  aarch64-unknown-linux-gnu or wasm32-unknown-unknown (default: both)";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let triple = match words.as_slice() {
        [] => None,
        [flag, triple] if flag == "--target" => Some(triple.as_str()),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match run(triple) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("machines: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(triple: Option<&str>) -> Result<()> {
    let machines = machine::find(triple)?;
    let mut expected = String::new();
    asperity_machines::write_hashes(&mut expected)?;
    println!(
        "hash of all bits on this machine, {}",
        std::env::consts::ARCH
    );
    for line in compare::last_hashes(&expected) {
        println!("{line}");
    }
    let mut faults = Vec::new();
    for machine in machines {
        let found = machine.session()?;
        let differences = compare::differences(&expected, &found);
        let verdict = if differences.is_empty() {
            "the same bits"
        } else {
            "other bits"
        };
        println!("{}: {verdict}", machine.name);
        faults.extend(
            differences
                .iter()
                .map(|fault| format!("{}: {fault}", machine.name)),
        );
    }
    if faults.is_empty() {
        Ok(())
    } else {
        Err(faults.join("\nmachines: ").into())
    }
}

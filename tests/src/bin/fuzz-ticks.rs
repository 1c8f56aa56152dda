//! Runs any number of fuzzed ticks:
//! `cargo run --release -p asperity-tests --bin fuzz-ticks -- [TICKS] [SEED] [float|fixed]`.
//! Fails at the first tick that panics, is not finite or leaves the limits. The same number of
//! ticks and the same seed print the same hash.
#![forbid(unsafe_code)]

use asperity_runtime::{Fixed, Float};
use asperity_tests::fuzz_ticks::fuzz_ticks;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize, default: u64| {
        let text = arguments.get(at);
        text.map_or(Ok(default), |text| text.parse::<u64>())
    };
    let run = match arguments.get(2).map_or("float", String::as_str) {
        "float" => fuzz_ticks::<Float>,
        "fixed" => fuzz_ticks::<Fixed>,
        _ => return usage(),
    };
    let (Ok(ticks), Ok(seed), 0..=3) = (number(0, 30_000_000), number(1, 1), arguments.len())
    else {
        return usage();
    };
    println!("{:#?}", run(seed, ticks));
    ExitCode::SUCCESS
}

fn usage() -> ExitCode {
    eprintln!("usage: fuzz-ticks [TICKS] [SEED] [float|fixed]");
    ExitCode::from(2)
}

//! Fuzzed ticks, as many as asked for: `cargo run --release -p asperity-tests --bin
//! fuzz-ticks -- [TICKS] [SEED]`. Fails at the first tick that is not finite, leaves the
//! limits or panics. The same ticks and seed print the same hash.
#![forbid(unsafe_code)]

use asperity_tests::fuzz_ticks::fuzz_ticks;
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut numbers = std::env::args().skip(1).map(|text| text.parse::<u64>());
    let (Ok(ticks), Ok(seed), None) = (
        numbers.next().unwrap_or(Ok(30_000_000)),
        numbers.next().unwrap_or(Ok(1)),
        numbers.next(),
    ) else {
        eprintln!("usage: fuzz-ticks [TICKS] [SEED]");
        return ExitCode::from(2);
    };
    println!("{:#?}", fuzz_ticks(seed, ticks));
    ExitCode::SUCCESS
}

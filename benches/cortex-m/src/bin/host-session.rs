//! The session on the host: prints, for the case and the arithmetic that are named, the hash
//! after each phase.
#![forbid(unsafe_code)]

use asperity_machines::{Numbers, hashes};
use asperity_session::{CASES, Phase};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let case = words.next().unwrap_or_default();
    let numbers = words.next().unwrap_or_default();
    let case = CASES
        .iter()
        .find(|known| known.name == case)
        .ok_or_else(|| format!("no case {case:?}"))?;
    let numbers = Numbers::ALL
        .into_iter()
        .find(|known| known.name() == numbers)
        .ok_or_else(|| format!("no arithmetic {numbers:?}"))?;
    for (phase, hash) in Phase::ALL.iter().zip(hashes(case, numbers)?) {
        println!("{} {hash:016x}", phase.name());
    }
    Ok(())
}

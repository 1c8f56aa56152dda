//! The session of `benches/cortex-m/session/` as a text of hashes, which every machine writes
//! alike: a line for each arithmetic and case, `float arma20`, and then the hash of all
//! outputs and counters after each phase.
#![cfg_attr(target_arch = "wasm32", no_std)]

mod hashes;
#[cfg(target_arch = "wasm32")]
mod wasm;

pub use hashes::{HashesError, Numbers, hashes};

use asperity_session::CASES;
use core::fmt;

/// Runs every case in floats and in fixed point, and writes the lines.
///
/// A case that cannot be run has the reason in the place of its hashes.
///
/// # Errors
/// What `out` says.
pub fn write_hashes(out: &mut impl fmt::Write) -> fmt::Result {
    for numbers in Numbers::ALL {
        for case in &CASES {
            write!(out, "{} {}", numbers.name(), case.name)?;
            match hashes(case, numbers) {
                Ok(hashes) => hashes
                    .iter()
                    .try_for_each(|hash| write!(out, " {hash:016x}"))?,
                Err(error) => write!(out, " {error}")?,
            }
            out.write_char('\n')?;
        }
    }
    Ok(())
}

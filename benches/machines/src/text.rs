//! The hashes as text.

use crate::hashes::{Numbers, hashes};
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

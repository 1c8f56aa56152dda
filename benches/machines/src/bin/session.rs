//! The session on a machine with an operating system: prints its hashes.
//!
//! With the argument `flush`, denormals are flushed to zero meanwhile.

use std::{
    env::args,
    fmt::{Error, Result},
};

fn main() -> Result {
    match args().nth(1).as_deref() {
        None => {}
        Some("flush") => flush()?,
        Some(_) => return Err(Error),
    }
    let mut hashes = String::new();
    asperity_machines::write_hashes(&mut hashes)?;
    print!("{hashes}");
    Ok(())
}

/// Sets FPCR.FZ, which flushes operands and results.
#[cfg(target_arch = "aarch64")]
#[allow(unsafe_code, reason = "the register is this thread's own")]
fn flush() -> Result {
    let control: u64 = 1 << 24;
    // SAFETY: nothing that the compiler assumes of floats is a denormal; the program ends like this.
    unsafe { std::arch::asm!("msr fpcr, {}", in(reg) control, options(nomem, nostack)) }
    // Half the smallest normal number is not zero unless the register took the bit.
    let half = std::hint::black_box(f32::MIN_POSITIVE) * 0.5;
    if half == 0.0 { Ok(()) } else { Err(Error) }
}

#[cfg(not(target_arch = "aarch64"))]
fn flush() -> Result {
    Err(Error)
}

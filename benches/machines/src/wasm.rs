//! The session as a WebAssembly module that needs no standard library: it exports `session`
//! and imports `write`, which `session.mjs` gives.

use crate::text::write_hashes;
use core::{fmt, panic::PanicInfo};

#[link(wasm_import_module = "machine")]
#[allow(
    unsafe_code,
    reason = "an import is declared, and reads no more than it is shown"
)]
unsafe extern "C" {
    /// Writes `len` bytes from `text` to standard output.
    safe fn write(text: *const u8, len: usize);
}

/// Standard output.
struct Out;

impl fmt::Write for Out {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        write(text.as_ptr(), text.len());
        Ok(())
    }
}

/// Writes the hashes of the whole session.
#[allow(unsafe_code, reason = "the module exports it by this name")]
#[unsafe(no_mangle)]
extern "C" fn session() {
    if write_hashes(&mut Out).is_err() {
        core::arch::wasm32::unreachable();
    }
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}

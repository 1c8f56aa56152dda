//! The version of header and library.

use core::ffi::{CStr, c_char};

/// Major version of the header. Programs of one major version run with every later library of it.
pub const ASPERITY_VERSION_MAJOR: u32 = 0;
/// Minor version of the header.
pub const ASPERITY_VERSION_MINOR: u32 = 1;
/// Patch level of the header.
pub const ASPERITY_VERSION_PATCH: u32 = 0;
/// Version of the header as one number: 10000·major + 100·minor + patch.
/// `asperity_version_number` has that of the library.
pub const ASPERITY_VERSION: u32 = 100;

const _: () = {
    let number =
        10_000 * ASPERITY_VERSION_MAJOR + 100 * ASPERITY_VERSION_MINOR + ASPERITY_VERSION_PATCH;
    assert!(ASPERITY_VERSION == number);
    const fn is(text: &str, number: u32) -> bool {
        let (bytes, mut at, mut found) = (text.as_bytes(), 0, 0);
        while at < bytes.len() {
            found = 10 * found + (bytes[at] - b'0') as u32;
            at += 1;
        }
        found == number
    }
    assert!(is(env!("CARGO_PKG_VERSION_MAJOR"), ASPERITY_VERSION_MAJOR));
    assert!(is(env!("CARGO_PKG_VERSION_MINOR"), ASPERITY_VERSION_MINOR));
    assert!(is(env!("CARGO_PKG_VERSION_PATCH"), ASPERITY_VERSION_PATCH));
};

/// The version of the library in words, e.g. `0.1.0`.
#[unsafe(no_mangle)]
pub extern "C" fn asperity_version() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    match CStr::from_bytes_with_nul(VERSION.as_bytes()) {
        Ok(version) => version.as_ptr(),
        Err(_) => c"".as_ptr(),
    }
}

/// The version of the library, to compare with the header's `ASPERITY_VERSION`.
#[unsafe(no_mangle)]
pub extern "C" fn asperity_version_number() -> u32 {
    ASPERITY_VERSION
}

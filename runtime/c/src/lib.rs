//! The Asperity runtime for C; `docs/c.md` has the rules and a complete program.
//!
//! The caller owns all memory. Objects are opaque: `asperity_*_init` builds one in memory
//! of at least `ASPERITY_*_SIZE` bytes, aligned to `ASPERITY_ALIGNMENT`. There is nothing
//! to release, and a pointer to an object stays valid until its memory is reused.
//!
//! Functions that can fail return an [`AsperityStatus`]. Those that can fail in many ways
//! also fill an [`AsperityError`]; its pointer may be null. Misuse that can be detected (a
//! null or misaligned pointer, too little memory, an object that is not initialised or of
//! another kind) gives a status and never a crash. No panic crosses the border.
//!
//! With the feature `std` (the default) the static library is for hosts: it contains Rust's
//! standard library and turns a panic into [`AsperityStatus::Internal`]. Without `std` the
//! crate is `no_std`. Firmware in Rust calls `asperity-runtime` directly. Firmware in C is
//! built with the feature `panic-handler`, whose handler waits for the watchdog.
//!
//! What must stay absent: allocation, global state, a file system, a clock.
#![cfg_attr(not(feature = "std"), no_std)]
#![allow(
    unsafe_code,
    reason = "pointers come from C; every block says what the caller promised"
)]

mod config;
mod library;
mod memory;
mod renderer;
mod state;
mod status;
mod texture;
mod tick;

pub use config::{
    ASPERITY_SURFACE_BOX, ASPERITY_SURFACE_PLANE, ASPERITY_SURFACE_SPHERE,
    ASPERITY_VIBRATION_BINORMAL, ASPERITY_VIBRATION_TANGENT, AsperityConfig,
    asperity_config_default,
};
pub use library::{
    ASPERITY_NAME_SIZE, asperity_library_count, asperity_library_find, asperity_library_name,
};
pub use memory::{
    ASPERITY_ALIGNMENT, ASPERITY_RENDERER_SIZE, ASPERITY_STATE_SIZE, ASPERITY_TEXTURE_SIZE,
};
pub use renderer::{AsperityRenderer, asperity_renderer_init};
pub use state::{AsperityCounters, AsperityState, asperity_state_counters, asperity_state_init};
pub use status::{ASPERITY_MESSAGE_SIZE, AsperityError, AsperityStatus, asperity_error_text};
pub use texture::{
    AsperityTexture, asperity_texture_init, asperity_texture_load_asset,
    asperity_texture_load_index, asperity_texture_load_name,
};
pub use tick::{AsperityOutput, AsperitySample, asperity_tick, flags};

use core::ffi::{CStr, c_char};

/// The version of the library, e.g. `0.1.0`.
#[unsafe(no_mangle)]
pub extern "C" fn asperity_version() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    match CStr::from_bytes_with_nul(VERSION.as_bytes()) {
        Ok(version) => version.as_ptr(),
        Err(_) => c"".as_ptr(),
    }
}

#[cfg(feature = "panic-handler")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        core::hint::spin_loop();
    }
}

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

mod arithmetic;
mod capacity;
mod config;
mod counters;
mod coupling;
mod exchange;
mod library;
mod memory;
mod recorder;
mod renderer;
mod scene;
mod sized;
mod state;
mod status;
mod text;
mod texture;
mod tick;
mod version;
mod words;

pub use arithmetic::{ASPERITY_ARITHMETIC_FIXED, ASPERITY_ARITHMETIC_FLOAT};
pub use capacity::{
    ASPERITY_CAPACITY_LARGE, ASPERITY_CAPACITY_MEDIUM, ASPERITY_CAPACITY_SMALL,
    ASPERITY_TEXTURE_SIZE_LARGE, ASPERITY_TEXTURE_SIZE_MEDIUM, ASPERITY_TEXTURE_SIZE_SMALL,
    asperity_asset_capacity, asperity_library_capacity,
};
pub use config::{
    ASPERITY_SOLID_BOX, ASPERITY_SOLID_PLANE, ASPERITY_SOLID_SPHERE, ASPERITY_VIBRATION_BINORMAL,
    ASPERITY_VIBRATION_TANGENT, AsperityConfig, asperity_config_default,
};
pub use counters::AsperityCounters;
pub use coupling::AsperityCoupling;
pub use exchange::{
    ASPERITY_EXCHANGE_SIZE, ASPERITY_EXCHANGE_SPARE, AsperityPlayer, AsperityPreparer,
    asperity_exchange_init, asperity_exchange_size, asperity_player_counters, asperity_player_tick,
    asperity_preparer_load_asset, asperity_preparer_load_index, asperity_preparer_load_name,
};
pub use library::{
    ASPERITY_NAME_SIZE, asperity_library_count, asperity_library_find, asperity_library_name,
};
pub use memory::ASPERITY_ALIGNMENT;
pub use recorder::{
    ASPERITY_RECORDER_RECORD_SIZE, ASPERITY_RECORDER_SIZE, AsperityRecord, AsperityRecorder,
    asperity_recorder_init, asperity_recorder_read, asperity_recorder_write,
};
pub use renderer::{ASPERITY_RENDERER_SIZE, AsperityRenderer, asperity_renderer_init};
pub use scene::{
    ASPERITY_SCENE_SIZE, ASPERITY_SCENE_STATE_SIZE, AsperityScene, AsperitySceneState,
    asperity_scene_init, asperity_scene_size, asperity_scene_state_counters,
    asperity_scene_state_init, asperity_scene_tick,
};
pub use state::{ASPERITY_STATE_SIZE, AsperityState, asperity_state_counters, asperity_state_init};
pub use status::{ASPERITY_MESSAGE_SIZE, AsperityError, AsperityStatus, asperity_error_text};
pub use texture::{
    AsperityTexture, asperity_texture_coupling, asperity_texture_init, asperity_texture_load_asset,
    asperity_texture_load_index, asperity_texture_load_name,
};
pub use tick::{ASPERITY_NO_SURFACE, AsperityOutput, AsperitySample, asperity_tick, flags};
pub use version::{
    ASPERITY_VERSION, ASPERITY_VERSION_MAJOR, ASPERITY_VERSION_MINOR, ASPERITY_VERSION_PATCH,
    asperity_version, asperity_version_number,
};
pub use words::{ASPERITY_TEXT_SIZE, asperity_counters_text, asperity_flags_text};

#[cfg(feature = "panic-handler")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        core::hint::spin_loop();
    }
}

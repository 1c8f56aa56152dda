//! Texture slots.

use crate::{
    AsperityError, AsperityStatus,
    library::{find, name, slice},
    memory::{ASPERITY_TEXTURE_SIZE, Object, exclusive, place},
    status::{Fault, call},
};
use asperity_formats::{Asset, Library};
use asperity_runtime::HostTexture;
use core::ffi::{c_char, c_void};

/// A slot for any texture of the format. It serves any number of states: loading writes to
/// it, a tick only reads it.
#[derive(Debug)]
pub struct AsperityTexture {
    tag: u32,
    pub(crate) texture: HostTexture,
}

impl Object for AsperityTexture {
    const TAG: u32 = u32::from_le_bytes(*b"aspT");
    const SIZE: usize = ASPERITY_TEXTURE_SIZE;

    fn tag(this: *const Self) -> *const u32 {
        // SAFETY: the address is computed and nothing is read; the caller's pointer leads
        // to memory of this size.
        unsafe { &raw const (*this).tag }
    }
}

/// Makes an empty slot in `memory` of at least `ASPERITY_TEXTURE_SIZE` bytes.
///
/// # Safety
/// `memory` is null or `size` bytes that nothing else uses; `texture` is null or valid for
/// writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_texture_init(
    memory: *mut c_void,
    size: usize,
    texture: *mut *mut AsperityTexture,
) -> AsperityStatus {
    let empty = || AsperityTexture {
        tag: AsperityTexture::TAG,
        texture: HostTexture::new(),
    };
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(core::ptr::null_mut(), || {
            Ok(place(memory, size, texture, empty)?)
        })
    }
}

/// Loads one asset (`.asp`) for a servo rate. If the asset is refused, the slot keeps the
/// texture it had. The bytes are not needed afterwards.
///
/// # Safety
/// `texture` is null or an initialised slot that nobody else uses during the call; `asset`
/// is null or `len` readable bytes; `error` is null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_texture_load_asset(
    texture: *mut AsperityTexture,
    asset: *const u8,
    len: usize,
    servo_rate_hz: f32,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        call(error, || {
            let slot = exclusive(texture)?;
            load(slot, slice(asset, len)?, servo_rate_hz)
        })
    }
}

/// Loads the texture at `index` of a whole library (`.aspl`); its other textures are not
/// read.
///
/// # Safety
/// As `asperity_texture_load_asset`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_texture_load_index(
    texture: *mut AsperityTexture,
    library: *const u8,
    len: usize,
    index: usize,
    servo_rate_hz: f32,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        call(error, || {
            let slot = exclusive(texture)?;
            let library = Library::parse(slice(library, len)?)?;
            load(slot, library.bytes(index)?, servo_rate_hz)
        })
    }
}

/// Loads the texture called `texture_name` of a whole library (`.aspl`).
///
/// # Safety
/// As `asperity_texture_load_asset`; `texture_name` is null or ends with a null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_texture_load_name(
    texture: *mut AsperityTexture,
    library: *const u8,
    len: usize,
    texture_name: *const c_char,
    servo_rate_hz: f32,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        call(error, || {
            let slot = exclusive(texture)?;
            let library = Library::parse(slice(library, len)?)?;
            let index = find(library.index(), name(texture_name)?)?;
            load(slot, library.bytes(index)?, servo_rate_hz)
        })
    }
}

/// Checks only what the runtime needs; the preview behind it may be damaged or absent.
fn load(slot: &mut AsperityTexture, asset: &[u8], servo_rate_hz: f32) -> Result<(), Fault> {
    Ok(slot
        .texture
        .load(&Asset::parse_haptic(asset)?, servo_rate_hz)?)
}

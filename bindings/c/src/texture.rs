//! Texture slots.

use crate::{
    AsperityError, AsperityRenderer, AsperityStatus,
    arithmetic::{Numbered, by_arithmetic},
    capacity::{Class, by_capacity, by_kind},
    coupling::AsperityCoupling,
    library::{asset_at, asset_called, name, slice},
    memory::{Object, Tag, exclusive, room, shared, tag},
    renderer::RendererOf,
    sized,
    status::{Fault, call},
};
use asperity_runtime::Texture;
use core::{
    ffi::{c_char, c_void},
    ptr,
};

/// A slot for textures up to its capacity. It serves any number of states: loading writes to it, a
/// tick only reads it.
#[derive(Debug)]
#[repr(C)]
pub struct AsperityTexture {
    tag: Tag,
}

/// Object behind an `AsperityTexture` pointer.
#[repr(C)]
pub(crate) struct TextureOf<S: Class, A: Numbered> {
    tag: Tag,
    /// The rate of the renderer that the slot was made for, Hz.
    servo_rate_hz: f32,
    pub(crate) texture: Texture<S, A>,
}

// SAFETY: `repr(C)`, the tag is first.
unsafe impl<S: Class, A: Numbered> Object for TextureOf<S, A> {
    const TAG: Tag = Tag::new(b'T', A::NUMBER, S::NUMBER);
}

/// Makes an empty slot in place.
///
/// # Safety
/// `slot` is aligned, and valid for writes of a texture.
pub(crate) unsafe fn empty<S: Class, A: Numbered>(slot: *mut Texture<S, A>) {
    // SAFETY: a texture is made of numbers, and of vectors that begin with their length. Zeros are
    // valid values of all of them, and `clear` then gives those that an empty slot has.
    unsafe {
        slot.write_bytes(0, 1);
        (*slot).clear();
    }
}

/// Makes an empty slot in `memory` of at least `ASPERITY_TEXTURE_SIZE_*` bytes, as `capacity`
/// (`ASPERITY_CAPACITY_*`) asks for. The slot takes textures for the servo rate and the arithmetic
/// of a renderer.
///
/// # Safety
/// `memory` is null or `size` bytes that nothing else uses; `renderer` is null or an initialised
/// renderer; `texture` is null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_texture_init(
    memory: *mut c_void,
    size: usize,
    renderer: *const AsperityRenderer,
    capacity: u32,
    texture: *mut *mut AsperityTexture,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            by_arithmetic!(tag(renderer)?.arithmetic(), A => {
                let servo_rate_hz = shared::<RendererOf<A>, _>(renderer)?
                    .renderer
                    .config()
                    .servo_rate_hz;
                by_capacity!(capacity, S => {
                    let slot = room::<TextureOf<S, A>, _>(memory, size, S::SIZE, texture)?;
                    (&raw mut (*slot).tag).write(TextureOf::<S, A>::TAG);
                    (&raw mut (*slot).servo_rate_hz).write(servo_rate_hz);
                    empty(&raw mut (*slot).texture);
                    texture.write(slot.cast());
                    Ok(())
                }, else AsperityStatus::Argument)
            }, else AsperityStatus::NotInitialised)
        })
    }
}

/// Loads one asset (`.asp`). If the asset is refused, the slot keeps the texture it had. The bytes
/// are not needed afterwards.
///
/// # Safety
/// `texture` is null or an initialised slot that nobody else uses during the call; `asset`
/// is null or `len` readable bytes; `error` is null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_texture_load_asset(
    texture: *mut AsperityTexture,
    asset: *const u8,
    len: usize,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe { call(error, || load(texture, slice(asset, len)?)) }
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
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        call(error, || {
            load(texture, asset_at(slice(library, len)?, index)?)
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
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        call(error, || {
            let library = slice(library, len)?;
            load(texture, asset_called(library, name(texture_name)?)?)
        })
    }
}

/// Checks only what the runtime needs; the preview behind it may be damaged or absent.
///
/// # Safety
/// As `asperity_texture_load_asset`.
unsafe fn load(texture: *mut AsperityTexture, asset: &[u8]) -> Result<(), Fault> {
    // SAFETY: the caller's promises.
    unsafe {
        by_kind!(tag(texture)?, S, A => {
            let slot = exclusive::<TextureOf<S, A>, _>(texture)?;
            Ok(slot.texture.load_haptic(asset, slot.servo_rate_hz)?)
        })
    }
}

/// Reads wall, gains and friction of the texture that a slot holds; all 0 for an empty slot.
///
/// # Safety
/// `texture` is null or an initialised slot that nobody writes during the call; `coupling` is null
/// or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_texture_coupling(
    texture: *const AsperityTexture,
    coupling: *mut AsperityCoupling,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            by_kind!(tag(texture)?, S, A => {
                let found = &shared::<TextureOf<S, A>, _>(texture)?.texture;
                let value = AsperityCoupling::new(&found.coupling(), found.mu());
                Ok(sized::write(coupling, &value)?)
            })
        })
    }
}

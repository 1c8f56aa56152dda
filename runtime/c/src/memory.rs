//! Objects in the caller's memory, and the checks on a pointer to one.

use crate::{AsperityRenderer, AsperityState, AsperityStatus, AsperityTexture};
use core::ffi::c_void;

/// Alignment of the memory of every object, bytes.
pub const ASPERITY_ALIGNMENT: usize = 64;
/// Size of the memory of an `AsperityTexture`, bytes.
pub const ASPERITY_TEXTURE_SIZE: usize = 65536;
/// Size of the memory of an `AsperityRenderer`, bytes.
pub const ASPERITY_RENDERER_SIZE: usize = 1024;
/// Size of the memory of an `AsperityState`, bytes.
pub const ASPERITY_STATE_SIZE: usize = 2048;

// The sizes leave room for objects to grow without a new header.
const _: () = {
    assert!(size_of::<AsperityTexture>() <= ASPERITY_TEXTURE_SIZE);
    assert!(size_of::<AsperityRenderer>() <= ASPERITY_RENDERER_SIZE);
    assert!(size_of::<AsperityState>() <= ASPERITY_STATE_SIZE);
    assert!(align_of::<AsperityTexture>() <= ASPERITY_ALIGNMENT);
    assert!(align_of::<AsperityRenderer>() <= ASPERITY_ALIGNMENT);
    assert!(align_of::<AsperityState>() <= ASPERITY_ALIGNMENT);
};

/// An object that C holds by an opaque pointer. A tag tells its kind.
pub(crate) trait Object: Sized {
    /// Different for every kind of object.
    const TAG: u32;
    /// Bytes of memory that the header asks for.
    const SIZE: usize;

    /// Place of the tag.
    fn tag(this: *const Self) -> *const u32;
}

/// Writes an object into memory that C passes, and stores its pointer in `out`.
///
/// # Safety
/// `memory` is null or `size` bytes that nothing else uses; `out` is null or valid for
/// writes.
pub(crate) unsafe fn place<T: Object>(
    memory: *mut c_void,
    size: usize,
    out: *mut *mut T,
    value: impl FnOnce() -> T,
) -> Result<(), AsperityStatus> {
    if memory.is_null() || out.is_null() {
        return Err(AsperityStatus::NullPointer);
    }
    let misaligned = !memory.addr().is_multiple_of(ASPERITY_ALIGNMENT) || !out.is_aligned();
    if misaligned || size < T::SIZE {
        return Err(AsperityStatus::Memory);
    }
    let object = memory.cast::<T>();
    // SAFETY: not null, aligned, large enough by the assertions above; the caller promises
    // that the memory is its own to give.
    unsafe {
        object.write(value());
        out.write(object);
    }
    Ok(())
}

/// Checks that a pointer leads to an object of its kind.
///
/// # Safety
/// `object` is null or leads to at least `size_of::<T>()` readable bytes.
unsafe fn check<T: Object>(object: *const T) -> Result<(), AsperityStatus> {
    if object.is_null() {
        Err(AsperityStatus::NullPointer)
    } else if !object.is_aligned() {
        Err(AsperityStatus::Memory)
    // SAFETY: not null, aligned and readable by the caller's promise; any bits are a u32.
    } else if unsafe { T::tag(object).read() } != T::TAG {
        Err(AsperityStatus::NotInitialised)
    } else {
        Ok(())
    }
}

/// A shared reference to an object.
///
/// # Safety
/// As `check`; while the reference lives nobody writes to the object.
pub(crate) unsafe fn shared<'a, T: Object>(object: *const T) -> Result<&'a T, AsperityStatus> {
    // SAFETY: the caller's promise. A right tag means that `place` wrote the object.
    unsafe {
        check(object)?;
        Ok(&*object)
    }
}

/// An exclusive reference to an object.
///
/// # Safety
/// As `check`; while the reference lives nobody else reads or writes the object.
pub(crate) unsafe fn exclusive<'a, T: Object>(object: *mut T) -> Result<&'a mut T, AsperityStatus> {
    // SAFETY: the caller's promise. A right tag means that `place` wrote the object.
    unsafe {
        check(object)?;
        Ok(&mut *object)
    }
}

/// Reads a plain struct that C passes.
///
/// # Safety
/// `value` is null or valid for reads, and every bit pattern is a valid `T`.
pub(crate) unsafe fn read<T: Copy>(value: *const T) -> Result<T, AsperityStatus> {
    if value.is_null() {
        Err(AsperityStatus::NullPointer)
    } else if !value.is_aligned() {
        Err(AsperityStatus::Memory)
    } else {
        // SAFETY: not null, aligned, readable by the caller's promise.
        Ok(unsafe { value.read() })
    }
}

/// Writes a plain struct to a place that C passes.
///
/// # Safety
/// `place` is null or valid for writes.
pub(crate) unsafe fn write<T>(place: *mut T, value: T) -> Result<(), AsperityStatus> {
    if place.is_null() {
        Err(AsperityStatus::NullPointer)
    } else if !place.is_aligned() {
        Err(AsperityStatus::Memory)
    } else {
        // SAFETY: not null, aligned, writable by the caller's promise.
        unsafe { place.write(value) };
        Ok(())
    }
}
